// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// Agents that have to do with each other, directly or not.
struct JointGroup {
  std::vector<AgentId> agents;
  /// Vertices to which an edge leads that one of them can take on the way to its goal, and such
  /// edges.
  std::size_t num_vertices = 0, num_edges = 0;
};

/// Divides the agents into groups, so that no move or stay of one group ever comes near to one of
/// another: plans of the groups, whatever they are, are a plan of all. Ordered by their first
/// agents. Each agent walks over its part of the roadmap once, then all that is near each edge is
/// looked at, for each pair of classes. Throws LimitReached.
[[nodiscard]] std::vector<JointGroup> independent_groups(Scene& scene);
/// Whether all starts are in one weakly connected component of the roadmap, as mostly: then it is
/// not worth while to look for groups, unless the instance is small. O(V + E).
[[nodiscard]] bool are_in_one_component(const Instance& instance);

}  // namespace quadrille::continuous
