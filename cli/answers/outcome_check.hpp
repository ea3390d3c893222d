// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/core/stated_outcome.hpp"

namespace quadrille::cli {

/// What a solver says, of either domain.
struct Claim {
  Status status = Status::unknown;
  bool has_plan = false;
  std::optional<Cost> cost;
  Cost lower_bound = 0;
};
/// What a replay of its plan says; without a plan it is not looked at.
struct Replay {
  std::size_t num_violations = 0;
  std::string first_violation;
  Cost cost = 0;
};
/// What is wrong with the claim; empty if nothing is.
[[nodiscard]] std::string find_false_claim(const Claim& claim, const Replay& replay);

/// What a file says about its plan and the replay of a plan without violations does not confirm:
/// costs, a status, a lower bound. A sentence for each; empty if all is well.
[[nodiscard]] std::vector<std::string> find_false_statements(const StatedOutcome& stated,
                                                             Cost sum_of_costs, Cost makespan);

/// Replays the plan of an outcome with the `verify` of its domain and holds its claims against the
/// replay, which is returned. A claim that fails turns the outcome into `unknown` with an internal
/// error, without plan, cost and lower bound.
template <class Instance, class Outcome>
auto check_outcome(const Instance& instance, Objective objective, Outcome& outcome) {
  decltype(verify(instance, *outcome.plan)) report;
  if (outcome.plan) report = verify(instance, *outcome.plan);
  if (!outcome.internal_error) {
    const std::string wrong = find_false_claim(
        {outcome.status, outcome.plan.has_value(), outcome.cost, outcome.lower_bound},
        {report.violations.size(), report.valid() ? "" : report.violations.front().message,
         objective == Objective::makespan ? report.makespan : report.sum_of_costs});
    if (!wrong.empty()) outcome.internal_error = Error{ErrorCode::internal, wrong, {}};
  }
  if (outcome.internal_error) {
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
    outcome.lower_bound = 0;
  }
  return report;
}

}  // namespace quadrille::cli
