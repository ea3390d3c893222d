// SPDX-License-Identifier: MIT
#include "quadrille/continuous/plan.hpp"

#include <algorithm>

namespace quadrille::continuous {

Cost cost(const Plan& plan, Objective objective) {
  Cost total = 0;
  for (const Path& path : plan.paths)
    total = objective == Objective::sum_of_costs ? total + cost(path) : std::max(total, cost(path));
  return total;
}

}  // namespace quadrille::continuous
