// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// A move along an edge, or a stay at a vertex. The one at the goal, unless the agent leaves, ends
/// with kForever.
struct Step {
  bool is_move = false;
  EdgeId edge;      // moves
  VertexId vertex;  // stays
  Ticks begin = 0, end = 0;
};

/// The path as steps that follow each other; stays without length are left out.
void list_steps(const Instance& instance, AgentId agent, const TimedPath& path,
                std::vector<Step>& steps);

/// Two steps of different agents that collide.
struct Encounter {
  AgentId first, second;
  Step a, b;  // of `first`, of `second`
};

/// The first collision of two agents, by the time at which its later step begins.
[[nodiscard]] std::optional<Encounter> first_encounter(Scene& scene, AgentId i,
                                                       const std::vector<Step>& steps_i, AgentId j,
                                                       const std::vector<Step>& steps_j);

}  // namespace quadrille::continuous
