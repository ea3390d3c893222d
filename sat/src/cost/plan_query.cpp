// SPDX-License-Identifier: MIT
#include "cost/plan_query.hpp"

#include <algorithm>
#include <limits>

namespace quadrille::sat {
namespace {

/// Elementary steps, about a second: each slice begins with a restart of the solver. Measured:
/// slices of 200'000 make proofs up to twice as long.
constexpr std::int64_t kSlice = 800'000;

}  // namespace

Verdict find_plan(const CostSearchContext& context, std::span<const Lit> assumptions,
                  std::optional<std::int64_t> conflicts) {
  LimitMonitor& limits = context.limits;
  const std::int64_t end = limits.conflicts() + conflicts.value_or(0);
  context.problem.on_solve(true);
  while (true) {
    SolveBudget budget;
    budget.effort = kSlice;
    const std::int64_t slice_end = context.engine.effort() + kSlice;
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
    if (!is_slice_over || (conflicts && limits.conflicts() >= end)) return verdict;
    context.yield_point.yield();
    if (limits.exhausted_now() || context.bounds.are_closed()) return verdict;
  }
}

}  // namespace quadrille::sat
