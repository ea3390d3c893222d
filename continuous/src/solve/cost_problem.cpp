// SPDX-License-Identifier: MIT
#include "solve/cost_problem.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

using sat::Lit;
using sat::Verdict;

CostProblem::CostProblem(Model& model, sat::Engine& engine, ContinuousTheory& theory,
                         bool theory_in_search)
    : model_(model),
      engine_(engine),
      theory_(theory),
      theory_in_search_(theory_in_search),
      writer_(engine) {}

Verdict CostProblem::solve_assuming(const std::vector<Level>& below, Lit also, LimitMonitor& limits,
                                    const sat::SolveBudget& budget) {
  std::vector<Lit> assumptions;
  for (const Level& level : below)
    assumptions.push_back(~model_.above(level.agent, level.cost - 1, writer_));
  if (also.valid()) assumptions.push_back(also);
  const Verdict verdict = engine_.solve(assumptions, limits, budget);
  core_.clear();
  if (verdict == Verdict::unsat) {
    const std::vector<Lit> failed = engine_.core();
    for (std::size_t k = 0; k < below.size(); ++k)
      if (std::find(failed.begin(), failed.end(), assumptions[k]) != failed.end())
        core_.push_back(below[k]);
  }
  return verdict;
}

Verdict CostProblem::solve(const IdVector<AgentId, Cost>& caps, LimitMonitor& limits) {
  std::vector<Level> below;
  for (const AgentId i : model_.instance().agent_ids()) below.push_back({i, caps[i] + 1});
  theory_.set_budget(kForever, Lit());
  return solve_with_theory(below, Lit(), limits, {});
}

Verdict CostProblem::solve_within(std::optional<Cost> total, LimitMonitor& limits,
                                  const sat::SolveBudget& budget) {
  theory_.set_budget(kForever, Lit());
  if (!total) return solve_with_theory({}, Lit(), limits, budget);
  // What the others cost at least is not there to be spent.
  Cost rest = *total;
  std::vector<Level> below;
  for (const AgentId i : model_.instance().agent_ids()) rest -= model_.free_cost(i);
  if (rest < 0) return Verdict::unsat;
  for (const AgentId i : model_.instance().agent_ids())
    below.push_back({i, model_.free_cost(i) + rest + 1});
  const Lit above = model_.total_above(*total, writer_);
  theory_.set_budget(*total, above);
  return solve_with_theory(below, ~above, limits, budget);
}

Verdict CostProblem::solve_with_theory(const std::vector<Level>& below, Lit also,
                                       LimitMonitor& limits, const sat::SolveBudget& budget) {
  theory_.set_mode(theory_in_search_ ? ContinuousTheory::Mode::always
                                     : ContinuousTheory::Mode::never);
  theory_.forget_accepted();
  Verdict verdict = solve_assuming(below, also, limits, budget);
  while (verdict == Verdict::sat && !accept_model())
    verdict = solve_assuming(below, also, limits, budget);
  return verdict;
}

bool CostProblem::accept_model() {
  if (theory_in_search_) {
    QUADRILLE_REQUIRE(theory_.accepted().has_value(), "models are accepted by the theory");
    return true;
  }
  std::vector<Lit> assignment;
  for (const Lit lit : model_.literals())
    assignment.push_back(engine_.model_value(lit) ? lit : ~lit);
  return theory_.check_complete(assignment, writer_);
}

Verdict CostProblem::refute(const std::vector<Level>& below, LimitMonitor& limits,
                            const sat::SolveBudget& budget) {
  theory_.set_mode(ContinuousTheory::Mode::never);
  return solve_assuming(below, Lit(), limits, budget);
}

Verdict CostProblem::try_refute(const std::vector<Level>& below,
                                const IdVector<AgentId, Cost>& ceilings, LimitMonitor& limits,
                                const sat::SolveBudget& budget) {
  if (!theory_in_search_) return refute(below, limits, budget);
  std::vector<Level> all = below;
  IdVector<AgentId, bool> is_in(ceilings.size(), false);
  for (const Level& level : below) is_in[level.agent] = true;
  for (const AgentId i : model_.instance().agent_ids())
    if (!is_in[i] && ceilings[i] < kForever) all.push_back({i, ceilings[i] + 1});
  theory_.set_budget(kForever, Lit());
  // What these tests ask is often hopeless, and a search of a pair would find no answer.
  theory_.set_pair_lemmas(false);
  const Verdict verdict = solve_with_theory(all, Lit(), limits, budget);
  theory_.set_pair_lemmas(true);
  std::erase_if(core_, [&](const Level& level) { return !is_in[level.agent]; });
  return verdict;
}

std::optional<Cost> CostProblem::next_threshold(AgentId agent, Cost cost) const {
  const auto& known = model_.thresholds(agent);
  const auto at = std::find_if(known.begin(), known.end(), [&](const Model::Threshold& t) {
    return t.cost > cost && t.is_natural;
  });
  if (at == known.end()) return std::nullopt;
  return at->cost;
}

void CostProblem::add_core(const std::vector<Level>& core) {
  std::vector<Lit> clause;
  for (const Level& level : core)
    clause.push_back(model_.above(level.agent, level.cost - 1, writer_));
  engine_.add_clause({sat::LemmaKind::core, clause, {}, false});
}

}  // namespace quadrille::continuous
