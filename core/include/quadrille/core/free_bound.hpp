// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Seconds that a search goes on after a limit was met, to sum up what no plan can cost less than.
inline constexpr double kGraceSeconds = 0.1;

/// Whether there is time to sum up, though a limit was met: as long as it is the limit of conflicts
/// alone, and else for kGraceSeconds.
class Grace {
 public:
  /// Both outlive the object.
  Grace(const Limits& limits, LimitMonitor& monitor) : limits_(limits), monitor_(monitor) {}

  [[nodiscard]] bool is_over() { return is_cut() && wall_seconds() > begin_ + kGraceSeconds; }

 private:
  [[nodiscard]] bool is_cut() {
    return monitor_.reason() != StopReason::conflicts ||
           (limits_.interrupt != nullptr && *limits_.interrupt) ||
           (limits_.wall_s && monitor_.elapsed_wall() >= *limits_.wall_s) ||
           (limits_.cpu_s && monitor_.elapsed_cpu() >= *limits_.cpu_s);
  }

  const Limits& limits_;
  LimitMonitor& monitor_;
  const double begin_ = wall_seconds();
};

/// What the agents cost when each is alone, together: no plan costs less. `free_cost(i)`: of one.
/// `grace`, unless null: when it is over, the agents that are left count nothing, which is a bound,
/// too.
template <class FreeCost>
[[nodiscard]] Cost free_bound(IdRange<AgentId> agents, Objective objective,
                              const FreeCost& free_cost, Grace* grace = nullptr) {
  Cost bound = 0;
  for (const AgentId i : agents) {
    const Cost cost = free_cost(i);
    bound = objective == Objective::sum_of_costs ? bound + cost : std::max(bound, cost);
    if (grace != nullptr && grace->is_over()) break;
  }
  return bound;
}

}  // namespace quadrille

QUADRILLE_API_END
