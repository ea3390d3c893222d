// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous {

/// Of the agent where it stands. Requires that it has the shape of the vertex.
[[nodiscard]] inline const Body& body_at(const Roadmap& roadmap, const Agent& agent, VertexId v) {
  return agent.body_as(roadmap.shape(v));
}

/// All of the agent's, by shape.
[[nodiscard]] std::vector<Body> bodies_of(const Agent& agent);

/// Of the largest of them.
[[nodiscard]] Length reach_of(const Agent& agent);

/// What follows the name of an agent with shapes: one of the roadmap is missing, or one that it has
/// at a vertex is not inside of that of an edge there. All that is said of agents that move among
/// others that stand rests on the latter: who collides while it stands does so while it comes, too.
[[nodiscard]] std::optional<std::string> find_wrong_shape(const Roadmap& roadmap,
                                                          const Agent& agent);

}  // namespace quadrille::continuous
