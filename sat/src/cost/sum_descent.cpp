// SPDX-License-Identifier: MIT
#include "cost/sum_descent.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "cost/plan_query.hpp"

namespace quadrille::sat {

Outcome SumDescent::advance(Slice slice) {
  Bounds& bounds = context_.bounds;
  LimitMonitor& limits = context_.limits;
  const std::int64_t end = slice.conflicts ? limits.conflicts() + *slice.conflicts
                                           : std::numeric_limits<std::int64_t>::max();
  while (limits.conflicts() < end && !limits.exhausted_now()) {
    Cost target = std::min(bounds.lower() + step_, counter_.largest());
    if (const auto best = bounds.upper()) target = std::min(target, *best - 1);
    if (target < bounds.lower()) break;
    const std::array assumptions{~counter_.above(target)};
    const Verdict verdict = find_plan(context_, assumptions, end - limits.conflicts());
    if (verdict == Verdict::unsat) {
      if (context_.engine.core().empty()) return Outcome::exhausted;
      counter_.note_bound(target + 1);
      bounds.raise(target + 1);
    }
    if (verdict == Verdict::unknown) {
      step_ *= 2;
      break;
    }
  }
  return limits.exhausted() ? Outcome::stopped : Outcome::working;
}

}  // namespace quadrille::sat
