// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Seconds that a search goes on after a limit was met, to sum up what no plan can cost less than.
inline constexpr double kGraceSeconds = 0.1;

/// What the agents cost when each is alone, together: no plan costs less. `free_cost(i)`: of one.
/// `seconds`: when these are over, the agents that are left count nothing, which is a bound, too.
template <class FreeCost>
[[nodiscard]] Cost free_bound(IdRange<AgentId> agents, Objective objective,
                              const FreeCost& free_cost,
                              std::optional<double> seconds = std::nullopt) {
  Cost bound = 0;
  const double begin = seconds ? wall_seconds() : 0;
  for (const AgentId i : agents) {
    const Cost cost = free_cost(i);
    bound = objective == Objective::sum_of_costs ? bound + cost : std::max(bound, cost);
    if (seconds && wall_seconds() > begin + *seconds) break;
  }
  return bound;
}

}  // namespace quadrille

QUADRILLE_API_END
