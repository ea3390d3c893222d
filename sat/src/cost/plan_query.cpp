// SPDX-License-Identifier: MIT
#include "cost/plan_query.hpp"

#include <algorithm>
#include <limits>

namespace quadrille::sat {

Verdict find_plan(const CostSearchContext& context, std::span<const Lit> assumptions,
                  std::optional<std::int64_t> conflicts) {
  LimitMonitor& limits = context.limits;
  // Each slice begins with a restart: of a long question there are few.
  Effort slice = Effort::microseconds(context.settings.question_slice);
  const std::int64_t end = limits.conflicts() + conflicts.value_or(0);
  context.problem.on_solve(true);
  while (true) {
    SolveBudget budget;
    budget.effort = slice;
    const Effort slice_end = context.engine.effort() + slice;
    if (conflicts)
      budget.conflicts = static_cast<int>(
          std::clamp<std::int64_t>(end - limits.conflicts(), 1, std::numeric_limits<int>::max()));
    const Verdict verdict = context.engine.solve(assumptions, limits, budget);
    if (verdict == Verdict::unsat) return verdict;
    if (verdict == Verdict::sat) {
      if (!context.problem.accept_model()) continue;
      context.bounds.offer_accepted();
      return verdict;
    }
    const bool is_slice_over = context.engine.effort() >= slice_end;
    slice = 2 * slice;
    if (!is_slice_over || (conflicts && limits.conflicts() >= end)) return verdict;
    context.yield_point.yield();
    if (limits.exhausted_now() || context.bounds.are_closed()) return verdict;
  }
}

}  // namespace quadrille::sat
