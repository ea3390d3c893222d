// SPDX-License-Identifier: MIT
#include "cost/core_minimiser.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::sat {
namespace {

/// Of one try; longer ones seldom succeed.
constexpr SolveBudget kTryBudget{60, 1000};
/// The same where there are many tries.
constexpr SolveBudget kShortTryBudget{20, 200};
/// Conflicts of the minimiser may exceed those of the search by so many.
constexpr std::int64_t kFreeConflicts = 200;

}  // namespace

std::vector<Lit> CoreMinimiser::minimise(const std::vector<Lit>& core, std::int64_t searched,
                                         bool retry) {
  if (!options_.enabled || core.empty()) return core;
  std::vector<Lit> best = drop(core, searched);
  if (!retry) return best;
  const std::int64_t before = conflicts_;
  for (int k = 0; k < options_.retries && best.size() > 2 && !context_.limits.exhausted(); ++k) {
    std::vector<Lit> shuffled = core;
    random_.shuffle_front(shuffled, shuffled.size());
    std::vector<Lit> other = drop(std::move(shuffled), searched);
    if (other.size() < best.size()) best = std::move(other);
  }
  conflicts_ = before;
  return best;
}

std::vector<Lit> CoreMinimiser::drop(std::vector<Lit> core, std::int64_t searched) {
  for (std::size_t at = 0; at < core.size() && core.size() > 1;) {
    if (conflicts_ > searched + kFreeConflicts || context_.limits.exhausted()) break;
    std::vector<Lit> part = core;
    part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
    if (solve_part(part) != Verdict::unsat) {
      ++at;
      continue;
    }
    // Those before `at` are known to be needed by the last core; the new one may lack some.
    const std::vector<Lit> smaller = context_.engine.core();
    at = static_cast<std::size_t>(std::count_if(
        core.begin(), core.begin() + static_cast<std::ptrdiff_t>(at),
        [&](Lit lit) { return std::find(smaller.begin(), smaller.end(), lit) != smaller.end(); }));
    core = smaller;
  }
  return core;
}

Verdict CoreMinimiser::solve_part(const std::vector<Lit>& part) {
  context_.problem.on_solve(false);
  const std::int64_t before = context_.limits.conflicts();
  const Verdict verdict = context_.engine.solve(
      part, context_.limits, options_.retries > 0 ? kShortTryBudget : kTryBudget);
  conflicts_ += context_.limits.conflicts() - before;
  context_.yield_point.yield();
  return verdict;
}

}  // namespace quadrille::sat
