// SPDX-License-Identifier: MIT
#include "outcome_check.hpp"

#include <fmt/format.h>

#include <string>

namespace quadrille::cli {
namespace {

using discrete::SolveOutcome;
using discrete::VerifyReport;

/// What is wrong; empty if nothing is.
std::string find_false_claim(const VerifyReport& replay, Objective objective,
                             const SolveOutcome& outcome) {
  const bool claims_plan = outcome.status == Status::optimal || outcome.status == Status::feasible;
  if (claims_plan != outcome.plan.has_value())
    return fmt::format("the status is {}, but there is {} plan", to_string(outcome.status),
                       outcome.plan ? "a" : "no");
  if (!outcome.plan) return "";
  if (!replay.valid())
    return fmt::format("the plan found breaks {} rule{}", replay.violations.size(),
                       replay.violations.size() == 1 ? "" : "s");
  const Cost cost = objective == Objective::makespan ? replay.makespan : replay.sum_of_costs;
  if (outcome.cost != cost)
    return fmt::format("the cost of the plan found is {}, but {} was claimed", cost,
                       outcome.cost.value_or(-1));
  const bool tight = outcome.lower_bound == cost;
  if (outcome.lower_bound > cost || tight != (outcome.status == Status::optimal))
    return fmt::format("the status is {}, but the cost is {} and the lower bound {}",
                       to_string(outcome.status), cost, outcome.lower_bound);
  return "";
}

}  // namespace

VerifyReport check_outcome(const discrete::Instance& instance, Objective objective,
                           SolveOutcome& outcome) {
  VerifyReport replay;
  if (outcome.plan) replay = verify(instance, *outcome.plan);
  std::string claim;
  if (!outcome.internal_error) claim = find_false_claim(replay, objective, outcome);
  if (!claim.empty()) outcome.internal_error = Error{ErrorCode::internal, claim, {}};
  if (outcome.internal_error) {
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
    outcome.lower_bound = 0;
  }
  return replay;
}

}  // namespace quadrille::cli
