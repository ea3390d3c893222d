// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::fleet {

/// How long a robot takes from one vertex to the other: what the edge between them says that is
/// open to it, or else what its speed says, also if there is no edge, as where it has been closed
/// meanwhile. nullopt if that is less than half a tick, as in one place, or too long.
[[nodiscard]] inline std::optional<continuous::Ticks> lane_duration(
    const continuous::Roadmap& roads, const continuous::Agent& agent, VertexId from, VertexId to) {
  for (const continuous::EdgeId e : roads.out_edges(from)) {
    const continuous::Edge& edge = roads.edge(e);
    if (edge.to == to && edge.open_to.contains(agent.group))
      return continuous::travel_time(roads, edge, agent.speed);
  }
  if (roads.position(from) == roads.position(to)) return std::nullopt;
  return continuous::travel_time(roads.position(from), roads.position(to), agent.speed);
}

}  // namespace quadrille::fleet
