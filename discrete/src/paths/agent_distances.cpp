// SPDX-License-Identifier: MIT
#include "paths/agent_distances.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

AgentDistances::AgentDistances(const Instance& instance, const GoalDistances& table, AgentId agent,
                               const GoalPrices* prices, const BlockedTimes* blocked)
    : graph_(&instance.graph()),
      table_(&table),
      task_(instance.agents()[agent]),
      to_goal_(table.row(agent)),
      prices_(prices),
      blocked_(blocked),
      layers_(instance.poses()),
      num_poses_(states().num_vertices()),
      has_poses_(layers_ != nullptr),
      start_state_(task_.start) {
  if (layers_) {
    const auto heading = static_cast<std::size_t>(task_.heading);
    start_state_ = VertexId(heading * graph_->num_vertices() + task_.start.index());
  }
  if (!task_.waypoints.empty()) make_layers(states());
  if (layers_) {
    std::vector<VertexId> ends;
    for (const VertexId goal : task_.goals.vertices())
      for_each_end(goal, [&](VertexId state) { ends.push_back(state); });
    own_to_goal_ = distances_to_nearest(*layers_, Goals(std::move(ends)));
  }
  length_ = free_cost_ = to_goal(start_state_);
  QUADRILLE_REQUIRE(length_ != kUnreachable || !instance.is_plain(), "a goal is reachable");
  if (states().is_directed()) find_largest_step();
  may_end_at_once_ = task_.leaves && is_goal(start_state_);
}

void AgentDistances::find_from_start() const {
  from_start_ = table_->pack(distances_from(*graph_, task_.start));
}

// A waypoint that is come to is visited: who has visited more may do all that others may.
void AgentDistances::make_layers(const Graph& poses) {
  const std::size_t size = poses.num_vertices(), last = task_.waypoints.size();
  const auto state = [&](std::size_t visited, VertexId pose) {
    const VertexId v = place(pose);
    while (visited < last && task_.waypoints[visited] == v) ++visited;
    return VertexId(visited * size + pose.index());
  };
  std::vector<Graph::Edge> arcs;
  for (std::size_t visited = 0; visited <= last; ++visited)
    for (const VertexId pose : IdRange<VertexId>(size)) {
      const VertexId from(visited * size + pose.index());
      if (state(visited, pose) != from) continue;  // Nobody is there.
      for (const VertexId next : poses.neighbours(pose))
        arcs.emplace_back(from, state(visited, next));
    }
  start_state_ = state(0, start_state_);
  layers_ = std::make_shared<const Graph>(Graph::make_directed(size * (last + 1), arcs).value());
}

// Of several walks over states that are the path, always the same one.
VertexId AgentDistances::state_at(const Path& path, Timestep t) const {
  if (!layers_) return position(path, t);
  struct Step {
    VertexId state;
    std::size_t before;
  };
  const auto end = static_cast<std::size_t>(arrival(path));
  std::vector<std::vector<Step>> steps{{{start_state_, 0}}};
  for (std::size_t at = 1; at <= end; ++at) {
    std::vector<Step> next;
    const auto add = [&](VertexId state, std::size_t before) {
      const bool is_known = std::any_of(next.begin(), next.end(),
                                        [&](const Step& known) { return known.state == state; });
      if (place(state) == path[at] && !is_known) next.push_back({state, before});
    };
    for (std::size_t k = 0; k < steps.back().size(); ++k) {
      add(steps.back()[k].state, k);
      for (const VertexId w : layers_->neighbours(steps.back()[k].state)) add(w, k);
    }
    steps.push_back(std::move(next));
  }
  std::size_t k = 0;
  while (k < steps[end].size() && !is_goal(steps[end][k].state)) ++k;
  QUADRILLE_REQUIRE(k < steps[end].size(), "the path is one of the agent");
  std::size_t at = end;
  for (; at > static_cast<std::size_t>(t); --at) k = steps[at][k].before;
  return steps[at][k].state;
}

void AgentDistances::find_largest_step() {
  for (const VertexId v : IdRange<VertexId>(states().num_vertices()))
    for (const VertexId w : states().neighbours(v))
      if (to_goal(v) != kUnreachable && to_goal(w) != kUnreachable)
        largest_step_ = std::max(largest_step_, 1 + to_goal(w) - to_goal(v));
}

}  // namespace quadrille::discrete
