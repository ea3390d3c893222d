// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous {

/// The vertices that the agent passes on every way from its start to its goal, both included, in
/// the order in which it comes to them. Requires that the goal can be reached. O(V E) at worst.
[[nodiscard]] std::vector<VertexId> inevitable_vertices(const Instance& instance, AgentId agent);

/// The vertices that all of the agents have to pass, in the order in which the first one comes to
/// them. Requires an agent.
[[nodiscard]] std::vector<VertexId> find_bottleneck(const Instance& instance,
                                                    const std::vector<AgentId>& agents);

/// The bottleneck of agents that block each other, for people: "both have to pass vertices 2, 3 and
/// 4, in opposite directions". Empty if it is.
[[nodiscard]] std::string describe_bottleneck(const Instance& instance,
                                              const std::vector<AgentId>& agents,
                                              const std::vector<VertexId>& bottleneck);

}  // namespace quadrille::continuous
