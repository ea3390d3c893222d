// SPDX-License-Identifier: MIT
#include "quadrille/continuous/plan.hpp"

#include <algorithm>
#include <limits>

namespace quadrille::continuous {

Cost cost(const Plan& plan, Objective objective) {
  constexpr Cost most = std::numeric_limits<Cost>::max();
  Cost sum = 0, largest = 0;
  for (const Path& path : plan.paths) {
    const Cost own = cost(path);
    sum = own > 0 && sum > most - own ? most : sum + own;
    largest = std::max(largest, own);
  }
  return objective == Objective::sum_of_costs ? sum : largest;
}

}  // namespace quadrille::continuous
