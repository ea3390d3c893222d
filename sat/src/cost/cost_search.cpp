// SPDX-License-Identifier: MIT
#include "quadrille/sat/cost_search.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "cost/plan_query.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/sat/proof_log.hpp"

namespace quadrille::sat {

namespace {

/// Raises that the same agents account for are one.
void add_raise(std::vector<Raise>& raises, Cost amount, std::vector<AgentId> agents) {
  if (!raises.empty() && raises.back().agents == agents)
    raises.back().amount += amount;
  else
    raises.push_back({RaiseKind::core, amount, std::move(agents), {}});
}

}  // namespace

SearchEnd search_upwards(CostSearchContext context) {
  Cost bound = std::max(context.problem.lower_bound(), context.bounds.lower());
  std::vector<Lit> assumptions;
  while (true) {
    context.bounds.raise(bound);
    context.yield_point.yield();
    assumptions.clear();
    if (context.limits.exhausted_now() || context.bounds.are_closed() ||
        !context.problem.assume_at_most(bound, context.limits, assumptions))
      return SearchEnd::stopped;
    const Verdict verdict = find_plan(context, assumptions);
    if (verdict == Verdict::unknown) return SearchEnd::stopped;
    if (verdict == Verdict::sat) return SearchEnd::found;
    const std::vector<Lit> core = context.engine.core();
    if (core.empty()) return SearchEnd::exhausted;
    const Cost next = context.problem.next_bound(bound, core);
    QUADRILLE_REQUIRE(next >= bound, "bounds only grow");
    if (context.engine.proof() != nullptr && next > bound)
      context.engine.proof()->claim_by_core(next, core);
    if (context.raises != nullptr && next > bound)
      add_raise(*context.raises, next - bound, context.problem.agents_of(core));
    bound = next;
  }
}

}  // namespace quadrille::sat
