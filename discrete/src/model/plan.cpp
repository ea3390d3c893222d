// SPDX-License-Identifier: MIT
#include "quadrille/discrete/plan.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

Cost arrival(const Path& path) {
  QUADRILLE_REQUIRE(!path.empty(), "a path has a first vertex");
  std::size_t last = path.size() - 1;
  while (last > 0 && path[last - 1] == path.back()) --last;
  return static_cast<Cost>(last);
}

Cost Plan::cost(Objective objective) const {
  Cost sum = 0, largest = 0;
  for (const Path& path : paths) {
    const Cost cost = arrival(path);
    sum += cost;
    largest = std::max(largest, cost);
  }
  return objective == Objective::sum_of_costs ? sum : largest;
}

void trim(Plan& plan) {
  for (Path& path : plan.paths) path.resize(static_cast<std::size_t>(arrival(path)) + 1);
}

}  // namespace quadrille::discrete
