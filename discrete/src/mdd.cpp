// SPDX-License-Identifier: MIT
#include "mdd.hpp"

#include <algorithm>

namespace quadrille::discrete {

Mdd::Mdd(const Graph& graph, const Task& task)
    : task_(task),
      to_goal_(distances_from(graph, task.goal)),
      rank_(graph.num_vertices(), SIZE_MAX) {
  QUADRILLE_REQUIRE(to_goal_[task.start] != kUnreachable, "the goal is reachable");
  const auto from_start = distances_from(graph, task.start);
  std::vector<std::pair<Timestep, VertexId>> order;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    if (from_start[v] != kUnreachable)
      order.emplace_back(from_start[v] + to_goal_[v] - distance(), v);
  std::sort(order.begin(), order.end());
  for (const auto& [detour, v] : order) {
    rank_[v] = by_detour_.size();
    by_detour_.push_back(v);
    detours_.push_back(detour);
  }
}

std::size_t Mdd::layer_size(Timestep slack) const {
  return static_cast<std::size_t>(std::upper_bound(detours_.begin(), detours_.end(), slack) -
                                  detours_.begin());
}

}  // namespace quadrille::discrete
