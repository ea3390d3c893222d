// SPDX-License-Identifier: MIT
#include "solve/incumbent.hpp"

#include <tuple>
#include <utility>

namespace quadrille::discrete {

bool Incumbent::offer(std::shared_ptr<const Plan> plan, std::string_view origin) {
  const Cost cost = plan->cost(objective_), sum = plan->cost(Objective::sum_of_costs);
  if (known_.cost && std::tie(cost, sum) >= std::tie(*known_.cost, sum_)) return false;
  if (known_.statistics.first_plan.empty()) known_.statistics.first_plan = origin;
  known_.take(std::move(plan), cost);
  sum_ = sum;
  return true;
}

}  // namespace quadrille::discrete
