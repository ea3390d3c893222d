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

std::int64_t num_moves(const Plan& plan) {
  std::int64_t number = 0;
  for (const Path& path : plan.paths)
    for (std::size_t t = 1; t < path.size(); ++t) number += path[t] == path[t - 1] ? 0 : 1;
  return number;
}

void trim(Plan& plan) {
  for (Path& path : plan.paths) path.resize(static_cast<std::size_t>(arrival(path)) + 1);
}

}  // namespace quadrille::discrete
