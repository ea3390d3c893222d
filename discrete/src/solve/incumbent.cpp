// SPDX-License-Identifier: MIT
#include "solve/incumbent.hpp"

#include <memory>
#include <tuple>

namespace quadrille::discrete {

bool Incumbent::offer(const Plan& plan) {
  const Cost cost = plan.cost(objective_), sum = plan.cost(Objective::sum_of_costs);
  if (known_.cost && std::tie(cost, sum) >= std::tie(*known_.cost, sum_)) return false;
  known_.take(std::make_shared<const Plan>(plan), cost);
  sum_ = sum;
  return true;
}

}  // namespace quadrille::discrete
