// SPDX-License-Identifier: MIT
#include "paths/agent_distances.hpp"

namespace quadrille::discrete {

AgentDistances::AgentDistances(const Graph& graph, const Task& task, GoalDistances::Row to_goal)
    : graph_(&graph), task_(task), to_goal_(to_goal) {
  QUADRILLE_REQUIRE(free_cost() != kUnreachable, "the goal is reachable");
}

Timestep AgentDistances::from_start(VertexId v) const {
  if (!from_start_) from_start_ = distances_from(*graph_, task_.start);
  return (*from_start_)[v];
}

}  // namespace quadrille::discrete
