// SPDX-License-Identifier: MIT
#include "cost/plan_query.hpp"

#include <algorithm>
#include <limits>

namespace quadrille::sat {

Verdict find_plan(const CostSearchContext& context, std::span<const Lit> assumptions,
                  std::optional<std::int64_t> conflicts) {
  LimitMonitor& limits = context.limits;
  const std::int64_t end = limits.conflicts() + conflicts.value_or(0);
  context.problem.on_solve(true);
  while (true) {
    SolveBudget budget;
    if (conflicts)
      budget.conflicts = static_cast<int>(
          std::clamp<std::int64_t>(end - limits.conflicts(), 1, std::numeric_limits<int>::max()));
    const Verdict verdict = context.engine.solve(assumptions, limits, budget);
    if (verdict != Verdict::sat || context.problem.accept_model()) return verdict;
  }
}

}  // namespace quadrille::sat
