// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// The latest tick of a plan: readers refuse a later one, to `verify` it is a violation. At one
/// tick a nanosecond that is 36 years. Two such times, or one and a quantity of geometry/, can be
/// added without overflow.
inline constexpr Ticks kMaxTick{std::int64_t{1} << 60};

/// A stay at a vertex, from `arrive` to `depart`, both included; arrive == depart passes through.
struct Stop {
  VertexId vertex;
  Ticks arrive = 0;
  Ticks depart = 0;
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// Where one agent is: it moves from each stop to the next, from its departure to the next arrival.
/// Times are absolute: the first arrival is at the instance's `now`. The last stop is for ever,
/// unless the agent leaves; its `depart` equals its `arrive`.
using Path = std::vector<Stop>;

/// One path per agent.
struct Plan {
  IdVector<AgentId, Path> paths;
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// A time since the beginning of a path as a cost: that of a path that arrives then.
[[nodiscard]] constexpr Cost as_cost(Ticks ticks) noexcept { return ticks.value(); }
/// When a path of this cost arrives, since its beginning.
[[nodiscard]] constexpr Ticks as_ticks(Cost cost) noexcept { return Ticks(cost); }

/// How long after its beginning the path arrives at its last stop; 0 for an empty path.
[[nodiscard]] inline Cost cost(const Path& path) {
  return path.empty() ? 0 : as_cost(path.back().arrive - path.front().arrive);
}
/// Sum or maximum of the costs of the paths, none of which is negative. A sum that does not fit is
/// the largest Cost.
[[nodiscard]] Cost cost(const Plan& plan, Objective objective);

}  // namespace quadrille::continuous

QUADRILLE_API_END
