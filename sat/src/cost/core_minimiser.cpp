// SPDX-License-Identifier: MIT
#include "cost/core_minimiser.hpp"

#include <algorithm>
#include <iterator>

namespace quadrille::sat {

bool CoreMinimiser::may_spend(const Spent& spent, const Spent& other, std::int64_t searched) const {
  const Effort effort = context_.engine.effort() - spent.effort - other.effort;
  const Settings& settings = context_.settings;
  return spent.conflicts <= searched + settings.core_free_conflicts &&
         spent.effort <= effort + Effort::microseconds(settings.core_free_effort) &&
         !context_.limits.exhausted();
}

std::vector<Lit> CoreMinimiser::minimise(std::vector<Lit> core, std::int64_t searched) {
  for (std::size_t at = 0; at < core.size() && core.size() > 1;) {
    if (!may_spend(minimising_, raising_, searched)) break;
    std::vector<Lit> part = core;
    part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
    if (solve_part(part, minimising_) != Verdict::unsat) {
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

Cost CoreMinimiser::raise(Relaxation& relaxation, std::vector<Lit>& core, Cost max_lift,
                          std::int64_t searched) {
  Cost lift = 1, refused = max_lift + 1;
  while (lift + 1 < refused && may_spend(raising_, minimising_, searched)) {
    const Cost next = std::min(2 * lift, (lift + refused) / 2);
    const auto raised = relaxation.raised(core, next);
    if (!raised) break;
    std::vector<Lit> part;
    std::copy_if(raised->begin(), raised->end(), std::back_inserter(part),
                 [](Lit lit) { return lit.valid(); });
    const Spent before = raising_;
    if (part.empty() || solve_part(part, raising_) != Verdict::unsat) {
      refused = next;
      continue;
    }
    raising_ = before;  // it was worth it
    lift = next;
    const std::vector<Lit> needed = context_.engine.core();
    std::vector<Lit> smaller;
    for (std::size_t at = 0; at < core.size(); ++at)
      if (std::find(needed.begin(), needed.end(), (*raised)[at]) != needed.end())
        smaller.push_back(core[at]);
    core = smaller;
  }
  return lift;
}

Verdict CoreMinimiser::solve_part(const std::vector<Lit>& part, Spent& spent) {
  context_.problem.on_solve(false);
  const Spent before{context_.limits.conflicts(), context_.engine.effort()};
  const Settings& settings = context_.settings;
  const SolveBudget budget{static_cast<int>(settings.core_try_conflicts),
                           static_cast<int>(settings.core_try_decisions)};
  const Verdict verdict = context_.engine.solve(part, context_.limits, budget);
  spent.conflicts += context_.limits.conflicts() - before.conflicts;
  spent.effort += context_.engine.effort() - before.effort;
  context_.yield_point.yield();
  return verdict;
}

}  // namespace quadrille::sat
