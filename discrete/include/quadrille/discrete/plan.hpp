// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// The vertex of one agent at the timesteps now, now + 1, ... of its plan; the agent stays at the
/// last one for ever. Never empty in a valid plan.
using Path = std::vector<VertexId>;

/// Timesteps from the beginning of the path to the last arrival at the last vertex: trailing
/// repetitions cost nothing. Requires a non-empty path.
[[nodiscard]] Cost arrival(const Path& path);
/// Where the path is `t` timesteps after its beginning, its last vertex from its end on. Requires a
/// non-empty path, and t >= 0.
[[nodiscard]] inline VertexId position(const Path& path, Timestep t) {
  const auto at = static_cast<std::size_t>(t);
  return at < path.size() ? path[at] : path.back();
}

/// One path per agent.
struct Plan {
  IdVector<AgentId, Path> paths;
  /// The timestep at which all paths begin: that of the instance, Instance::now.
  Timestep now = 0;

  /// Sum or maximum of the agents' arrivals, which count from `now`; 0 without agents.
  [[nodiscard]] Cost cost(Objective objective) const;
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// Timesteps in which an agent changes its vertex, of all agents.
[[nodiscard]] std::int64_t num_moves(const Plan& plan);

/// Drops trailing repetitions, so that every path ends with its arrival.
void trim(Plan& plan);

}  // namespace quadrille::discrete

QUADRILLE_API_END
