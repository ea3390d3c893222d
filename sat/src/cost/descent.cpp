// SPDX-License-Identifier: MIT
#include "cost/descent.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"

namespace quadrille::sat {
namespace {

/// Measured on open maps: plans at the optimum are found as fast as plans well above it. A bound
/// that is too low costs a turn or, at best, raises the lower bound.
constexpr Cost kFirstStep = 8;
/// Of one neighbourhood. Measured: 100 and 1000 are slower.
constexpr std::int64_t kTryConflicts = 200;
/// Of the engine, for one candidate; those near the lower bound are refuted by three on average.
constexpr std::int64_t kCandidateConflicts = 1000;
/// Conflicts of the offline solver for each of the engine, which take an eighth of the time each.
constexpr std::int64_t kOfflineShare = 16;
/// So many neighbourhoods without a cheaper plan end their turn; fewer if candidates come next.
constexpr int kPatience = 64, kShortPatience = 32;

/// A totalizer of n inputs that counts up to k has about n k^2 / 2 clauses, and nothing interrupts
/// it while it grows.
Cost largest_excess(std::size_t num_inputs) {
  constexpr Cost kMaxSize = 2'000'000;
  Cost k = kFirstStep;
  while (static_cast<Cost>(num_inputs) * (k + 1) * (k + 1) <= kMaxSize) ++k;
  return k;
}

}  // namespace

Descent::Descent(Engine& engine, OfflineSolver& offline, AgentCostProblem& problem,
                 PlanStore& plans, LimitMonitor& limits, Cost base, std::size_t num_inputs,
                 Totalizer::Input excess, Cost max_gap)
    : engine_(engine),
      offline_(offline),
      problem_(problem),
      plans_(plans),
      limits_(limits),
      base_(base),
      max_gap_(max_gap),
      max_excess_(largest_excess(num_inputs)),
      excess_(engine, num_inputs, std::move(excess)),
      num_free_(problem.num_agents() / 5 + 1),
      max_step_(kFirstStep) {}

Verdict Descent::look(std::span<const Lit> assumptions, std::int64_t conflicts) {
  const std::int64_t end = limits_.conflicts() + conflicts;
  problem_.on_solve(true);
  Verdict verdict;
  do {
    const std::int64_t rest =
        std::clamp<std::int64_t>(end - limits_.conflicts(), 1, std::numeric_limits<int>::max());
    verdict = engine_.solve(assumptions, limits_, {static_cast<int>(rest), {}});
  } while (verdict == Verdict::sat && !problem_.accept_model());
  if (verdict == Verdict::sat) plans_.take_accepted();
  return verdict;
}

Cost Descent::advance(Cost lower_bound, std::int64_t conflicts) {
  const std::int64_t end = limits_.conflicts() + conflicts;
  lower_bound = try_neighbourhoods(lower_bound, end);
  const auto best = plans_.best_cost();
  return best && *best - lower_bound <= max_gap_ && *best - base_ <= max_excess_
             ? try_candidates(lower_bound, kOfflineShare * conflicts)
             : try_all(lower_bound, end);
}

Lit Descent::cost_above(AgentId agent, Cost cost) {
  const auto lit = problem_.cost_above(agent, cost, limits_);
  QUADRILLE_REQUIRE(lit.has_value(), "see CoreGuidedOptions::plans");
  return *lit;
}

Lit Descent::plan_above(Cost cost) {
  const Lit lit = excess_.at_least(static_cast<int>(cost - base_) + 1);
  QUADRILLE_REQUIRE(lit.valid(), "an agent's cost has no end");
  return lit;
}

Cost Descent::try_neighbourhoods(Cost lower_bound, std::int64_t end) {
  std::vector<AgentId> agents;
  for (const AgentId i : IdRange<AgentId>(problem_.num_agents())) agents.push_back(i);
  int failures = 0;
  while (limits_.conflicts() < end && !limits_.exhausted_now()) {
    const auto best = plans_.best_cost();
    const bool is_close = best && *best - lower_bound <= max_gap_;
    if (failures >= (is_close ? kShortPatience : kPatience)) break;
    if (!best || *best <= lower_bound || *best - base_ > max_excess_) break;
    random_.shuffle_front(agents, agents.size());
    std::vector<Lit> assumptions;
    for (std::size_t at = num_free_; at < agents.size(); ++at) {
      assumptions.push_back(~cost_above(agents[at], plans_.best_cost_of(agents[at])));
    }
    // Last: with the others in front, most agents have their caps before it says anything.
    assumptions.push_back(~plan_above(*best - 1));
    const Verdict verdict = look(assumptions, std::min(kTryConflicts, end - limits_.conflicts()));
    failures = verdict == Verdict::sat ? 0 : failures + 1;
    if (verdict == Verdict::unsat) {
      if (assumptions.size() == 1) return *best;  // all agents were free
      num_free_ = std::min(agents.size(), num_free_ + num_free_ / 20 + 1);
    } else if (verdict == Verdict::unknown) {
      num_free_ = std::max<std::size_t>(1, num_free_ - num_free_ / 14);
    }
  }
  return lower_bound;
}

Cost Descent::try_all(Cost lower_bound, std::int64_t end) {
  while (limits_.conflicts() < end && !limits_.exhausted_now()) {
    Cost target = std::min(lower_bound + max_step_, base_ + max_excess_);
    if (const auto best = plans_.best_cost()) target = std::min(target, *best - 1);
    if (target < lower_bound) break;
    const std::array assumptions{~plan_above(target)};
    const Verdict verdict = look(assumptions, end - limits_.conflicts());
    if (verdict == Verdict::unsat) lower_bound = target + 1;
    if (verdict == Verdict::unknown) {
      max_step_ *= 2;
      break;
    }
  }
  return lower_bound;
}

// The lower bound is at least the base, so that the best plan, which is dearer, is above it.
Cost Descent::try_candidates(Cost lower_bound, std::int64_t conflicts) {
  while (conflicts > 0 && !limits_.exhausted_now()) {
    const auto best = plans_.best_cost();
    if (*best <= lower_bound) break;
    const Lit not_cheaper = plan_above(*best - 1);
    const std::array assumptions{~not_cheaper};
    const std::int64_t before = limits_.conflicts();
    const auto budget = std::min<std::int64_t>(conflicts, std::numeric_limits<int>::max());
    const Verdict verdict = offline_.solve(assumptions, limits_, {static_cast<int>(budget), {}});
    if (verdict == Verdict::unsat) {
      const std::array refuted{not_cheaper};
      engine_.add_clause({LemmaKind::core, refuted, {}, false});
      return *best;
    }
    if (verdict == Verdict::sat &&
        look(caps_of_candidate(), kCandidateConflicts) == Verdict::unsat) {
      std::vector<Lit> core = engine_.core();
      for (Lit& lit : core) lit = ~lit;
      engine_.add_clause({LemmaKind::core, core, {}, false});
    }
    conflicts -= limits_.conflicts() - before + 1;
  }
  return lower_bound;
}

// The counter knows, for each agent, of costs so high that one of them alone is too much. So each
// agent has a cap in the model, and together they cost what was asked for.
std::vector<Lit> Descent::caps_of_candidate() {
  std::vector<Lit> caps;
  for (const AgentId i : IdRange<AgentId>(problem_.num_agents())) {
    Cost cost = problem_.free_cost(i);
    while (offline_.candidate_has(cost_above(i, cost))) ++cost;
    caps.push_back(~cost_above(i, cost));
  }
  return caps;
}

}  // namespace quadrille::sat
