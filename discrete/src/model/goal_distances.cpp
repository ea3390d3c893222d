// SPDX-License-Identifier: MIT
#include "quadrille/discrete/goal_distances.hpp"

namespace quadrille::discrete {
namespace {

/// Fills `rows`, one row of V entries per agent. False when a limit was met.
template <class T>
bool fill_rows(const Instance& instance, T no_way, LimitMonitor& limits, std::vector<T>& rows) {
  const Graph& graph = instance.graph();
  const std::size_t size = graph.num_vertices();
  if (!limits.has_room_for(instance.num_agents() * size * sizeof(T))) return false;
  rows.assign(instance.num_agents() * size, no_way);
  std::vector<VertexId> queue;
  queue.reserve(size);
  for (const AgentId agent : instance.agents()) {
    if (limits.exhausted_now()) return false;
    T* const row = rows.data() + agent.index() * size;
    queue.assign(1, instance.tasks()[agent].goal);
    row[queue.front().index()] = 0;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      if (head % 4096 == 4095 && limits.exhausted_now()) return false;
      const VertexId v = queue[head];
      const T next = static_cast<T>(row[v.index()] + 1);
      for (const VertexId w : graph.neighbours(v)) {
        if (row[w.index()] != no_way) continue;
        row[w.index()] = next;
        queue.push_back(w);
      }
    }
  }
  return true;
}

}  // namespace

std::shared_ptr<const GoalDistances> GoalDistances::make(const Instance& instance,
                                                         LimitMonitor& limits) {
  std::shared_ptr<GoalDistances> distances(new GoalDistances());
  distances->num_vertices_ = instance.graph().num_vertices();
  // A distance is smaller than the number of vertices, so that it never looks like kNoWay.
  const bool is_small = instance.graph().num_vertices() < kNoWay;
  const bool complete = is_small ? fill_rows(instance, kNoWay, limits, distances->small_)
                                 : fill_rows(instance, kUnreachable, limits, distances->large_);
  return complete ? distances : nullptr;
}

}  // namespace quadrille::discrete
