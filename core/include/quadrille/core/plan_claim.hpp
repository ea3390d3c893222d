// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille {

/// The error (invalid_plan) for a plan that a user claims to be valid, if `verify` found violations
/// in it. `what`: what it is called, such as "initial plan".
template <class VerifyReport>
[[nodiscard]] std::optional<Error> refuse_invalid(const VerifyReport& report,
                                                  const std::string& what) {
  if (report.valid()) return std::nullopt;
  return Error{
      ErrorCode::invalid_plan,
      "the " + what + " is not a plan of this instance: " + report.violations.front().message,
      {}};
}

/// The error (out_of_range) for a lower bound that a user claims to know, if a valid plan costs
/// `cost`, in timesteps or ticks, and that is less.
[[nodiscard]] inline std::optional<Error> refuse_bound(const std::optional<Cost>& known,
                                                       Cost cost) {
  if (!known || cost >= *known) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "the known lower bound is wrong: it is " + std::to_string(*known) +
                   ", and a plan costs " + std::to_string(cost),
               {}};
}

/// Holds the outcome of a solver of either domain, which has a plan, against what `verify` of that
/// domain says of the plan: it has to be valid, to cost no less than the proven bound, and just
/// that if it is called optimal. Sets the cost, or an internal error, which is that of
/// `refuse_bound` if so.
template <class VerifyReport, class SolveOutcome>
void hold_to_replay(const VerifyReport& report, Objective objective,
                    const std::optional<Cost>& known_bound, SolveOutcome& outcome) {
  const Cost cost = objective == Objective::sum_of_costs ? report.sum_of_costs : report.makespan;
  if (report.valid())
    if (auto error = refuse_bound(known_bound, cost)) {
      outcome.internal_error = std::move(error);
      return;
    }
  std::optional<std::string> wrong;
  if (!report.valid())
    wrong = "the plan is not valid: " + report.violations.front().message;
  else if (cost < outcome.lower_bound ||
           (outcome.status == Status::optimal && cost != outcome.lower_bound))
    wrong = "the plan costs " + std::to_string(cost) + " and the proven bound is " +
            std::to_string(outcome.lower_bound);
  if (wrong)
    outcome.internal_error = Error{ErrorCode::internal, *wrong, {}};
  else
    outcome.cost = cost;
}

}  // namespace quadrille
