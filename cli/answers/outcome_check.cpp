// SPDX-License-Identifier: MIT
#include "answers/outcome_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace quadrille::cli {
namespace {

/// A status or a lower bound that cannot be right; empty without one.
std::string find_contradiction(const StatedOutcome& stated, Cost sum_of_costs, Cost makespan) {
  if (stated.status == Status::infeasible || stated.status == Status::unknown)
    return fmt::format("the file states that the instance is {}, but has a plan",
                       to_string(*stated.status));
  if (!stated.lower_bound) return "";
  const Cost bound = *stated.lower_bound;
  const Cost cost = stated.objective == Objective::makespan ? makespan : sum_of_costs;
  if (bound > cost)
    return fmt::format("the file states a lower bound of {}, but the plan costs {}", bound, cost);
  if ((stated.status == Status::optimal && bound < cost) ||
      (stated.status == Status::feasible && bound == cost))
    return fmt::format(
        "the file states that the plan is {}, but the lower bound is {} and the cost {}",
        stated.status == Status::optimal ? "optimal" : "no more than feasible", bound, cost);
  if (stated.gap_percent) {
    constexpr double kRounding = 1e-9;
    const double gap = gap_percent(cost, bound);
    if (!(std::abs(*stated.gap_percent - gap) <= kRounding * (1 + gap)))
      return fmt::format("the file states a gap of {} per cent, but it is {}", *stated.gap_percent,
                         gap);
  }
  return "";
}

}  // namespace

std::string find_false_claim(const Claim& claim, const Replay& replay) {
  const bool claims_plan = claim.status == Status::optimal || claim.status == Status::feasible;
  if (claims_plan != claim.has_plan)
    return fmt::format("the status is {}, but there is {} plan", to_string(claim.status),
                       claim.has_plan ? "a" : "no");
  if (!claim.has_plan) return "";
  if (replay.num_violations > 0)
    return fmt::format("the plan found breaks {} rule{}: {}", replay.num_violations,
                       replay.num_violations == 1 ? "" : "s", replay.first_violation);
  if (claim.cost != replay.cost)
    return fmt::format("the cost of the plan found is {}, but {} was claimed", replay.cost,
                       claim.cost.value_or(-1));
  const bool tight = claim.lower_bound == replay.cost;
  if (claim.lower_bound > replay.cost || tight != (claim.status == Status::optimal))
    return fmt::format("the status is {}, but the cost is {} and the lower bound {}",
                       to_string(claim.status), replay.cost, claim.lower_bound);
  return "";
}

std::vector<std::string> find_false_statements(const StatedOutcome& stated, Cost sum_of_costs,
                                               Cost makespan) {
  std::vector<std::string> found;
  const auto compare = [&found](const char* name, std::optional<Cost> cost, Cost actual) {
    if (cost && *cost != actual)
      found.push_back(fmt::format("the file states a {} of {}, but it is {}", name, *cost, actual));
  };
  compare("sum of costs", stated.sum_of_costs, sum_of_costs);
  compare("makespan", stated.makespan, makespan);
  std::string wrong = find_contradiction(stated, sum_of_costs, makespan);
  if (!wrong.empty()) found.push_back(std::move(wrong));
  return found;
}

}  // namespace quadrille::cli
