// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/solver_cases.hpp"

// For tests of searches that are ended from outside.

namespace quadrille::discrete::support {

/// Within this time a search has to return after its limit was met. Counted in CPU time: what the
/// clock says depends on what else the machine does.
inline constexpr double kSoon = 2.0;

/// Every agent on a walk across a room: much too hard to finish within the limits below.
inline Instance hard_instance() {
  Random random(2);
  return random_grid(random, {20, 20, 0, 360, 360});
}

inline TunedOptions with_limits(TunedOptions options, const Limits& limits) {
  options.limits = limits;
  return options;
}

inline std::vector<TunedOptions> systems_for_both_objectives() {
  std::vector<TunedOptions> systems = all_systems(Objective::sum_of_costs);
  const std::vector<TunedOptions> more = all_systems(Objective::makespan);
  systems.insert(systems.end(), more.begin(), more.end());
  // The first plan of the hard instance has the least makespan, which would be the end.
  for (TunedOptions& options : systems)
    if (options.objective == Objective::makespan) options.first_plan = false;
  return systems;
}

struct Stopped {
  SolveOutcome outcome;
  double cpu_s = 0;
};

inline Stopped run(const Instance& instance, const TunedOptions& options) {
  const double begin = cpu_seconds();
  SolveOutcome outcome = solve(instance, options).value();
  const double taken = cpu_seconds() - begin;  // without the check
  EXPECT_EQ(find_inconsistency(instance, options, outcome), "")
      << instance_text(instance) << options_text(options);
  return {std::move(outcome), taken};
}

inline bool is_proof(Status status) {
  return status == Status::optimal || status == Status::infeasible;
}

}  // namespace quadrille::discrete::support
