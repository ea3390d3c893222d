// SPDX-License-Identifier: MIT
#include "cost/candidate_search.hpp"

#include <algorithm>
#include <array>

#include "cost/plan_query.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::sat {
namespace {

/// Of the offline solver between two yield points: less than a second.
constexpr std::int64_t kOfflineSlice = 8000;

}  // namespace

Outcome CandidateSearch::advance(Slice slice) {
  QUADRILLE_REQUIRE(slice.conflicts.has_value(), "the slice has an end");
  Bounds& bounds = context_.bounds;
  LimitMonitor& limits = context_.limits;
  std::int64_t left = context_.settings.above_offline_share * *slice.conflicts;
  while (left > 0 && !limits.exhausted_now()) {
    const auto best = bounds.upper();
    if (*best <= bounds.lower()) break;
    // The lower bound is at least the base, so that the incumbent, which costs more, is above it.
    const Lit not_cheaper = counter_.above(*best - 1);
    const std::array assumptions{~not_cheaper};
    const std::int64_t before = limits.conflicts();
    const std::int64_t conflicts = std::min(left, kOfflineSlice);
    const Verdict verdict = offline_.solve(assumptions, limits, {static_cast<int>(conflicts)});
    context_.yield_point.yield();
    if (verdict == Verdict::unsat) {
      if (offline_.refutes_everything()) return Outcome::exhausted;
      const std::array refuted{not_cheaper};
      context_.engine.add_clause({why::Core{}, refuted, {}, false});
      counter_.note_bound(*best);
      bounds.raise(*best);
      break;
    }
    if (verdict == Verdict::sat) {
      const Verdict answer =
          find_plan(context_, caps_of_candidate(), context_.settings.above_candidate_conflicts);
      if (answer == Verdict::unsat) {
        std::vector<Lit> core = context_.engine.core();
        if (core.empty()) return Outcome::exhausted;
        for (Lit& lit : core) lit = ~lit;
        context_.engine.add_clause({why::Core{}, core, {}, false});
      }
    }
    left -= limits.conflicts() - before + 1;
  }
  return limits.exhausted() ? Outcome::stopped : Outcome::working;
}

// The counter knows, for each agent, of costs so high that one of them alone is too much. So each
// agent has a cap in the model, and together with the fees they cost what was asked for.
std::vector<Lit> CandidateSearch::caps_of_candidate() {
  CostProblem& problem = context_.problem;
  std::vector<Lit> caps;
  for (const AgentId i : IdRange<AgentId>(problem.num_agents())) {
    Cost cost = problem.free_cost(i);
    while (offline_.candidate_has(problem.cost_above(i, cost))) ++cost;
    caps.push_back(~problem.cost_above(i, cost));
  }
  for (const CostProblem::Fee& fee : problem.fees())
    if (!offline_.candidate_has(fee.due)) caps.push_back(~fee.due);
  return caps;
}

}  // namespace quadrille::sat
