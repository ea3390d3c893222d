// SPDX-License-Identifier: MIT
#include "solve/incumbent.hpp"

#include <tuple>

namespace quadrille::discrete {

bool Incumbent::offer(const Plan& plan) {
  const Cost cost = plan.cost(objective_), sum = plan.cost(Objective::sum_of_costs);
  if (cost_ && std::tie(cost, sum) >= std::tie(*cost_, sum_)) return false;
  plan_ = plan;
  cost_ = cost;
  sum_ = sum;
  return true;
}

}  // namespace quadrille::discrete
