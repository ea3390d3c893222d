// SPDX-License-Identifier: MIT
#include "solve/cost_problem.hpp"

#include <algorithm>
#include <limits>

#include "quadrille/core/contract.hpp"
#include "quadrille/sat/proof_log.hpp"

namespace quadrille::continuous {

using sat::Lit;
using sat::Verdict;

namespace {

/// Each slice begins with a restart of the solver.
constexpr Effort kSlice = Effort::microseconds(200'000);

}  // namespace

CostProblem::CostProblem(Model& model, sat::Engine& engine, ContinuousTheory& theory,
                         bool theory_in_search, sat::YieldPoint* yield_point,
                         sat::CoreAuditor* auditor)
    : model_(model),
      engine_(engine),
      theory_(theory),
      theory_in_search_(theory_in_search),
      yield_point_(yield_point),
      auditor_(auditor),
      writer_(engine),
      keeps_ceilings_(engine.proof() != nullptr) {
  // Made later, they would end the model that asks for them.
  for (const Fee& fee : fees()) static_cast<void>(model_.left_over(fee.goal, writer_));
}

Verdict CostProblem::solve(const Question& question, LimitMonitor& limits) {
  using Search = Question::Search;
  using Mode = ContinuousTheory::Question::Mode;
  const bool is_known_only = question.search == Search::known_clauses ||
                             (question.search == Search::quick && !theory_in_search_);
  ContinuousTheory::Question asked;
  asked.mode = theory_in_search_ && !is_known_only ? Mode::always : Mode::never;
  // What quick tests ask is often hopeless, and a search of a pair would find no answer; but where
  // one has, the levels of the two and of a third agent would rise tick by tick without it.
  if (question.search == Search::quick) asked.pairs = PairLemmas::Scope::proven;
  std::vector<Level> assumed = question.below;
  IdVector<AgentId, Cost> ceilings(num_payers(), kAnyCost);
  if (!question.ceilings.empty() && !is_known_only) ceilings = question.ceilings;
  for (const Level& level : question.below) ceilings[level.agent] = kAnyCost;
  for (const AgentId i : payers())
    if (ceilings[i] < kAnyCost)
      if (const auto level = level_above(i, ceilings[i])) assumed.push_back(*level);
  theory_.ask(asked);
  Verdict verdict = solve_assuming(question, assumed, limits);
  while (verdict == Verdict::sat && !is_known_only && !accept_model())
    verdict = solve_assuming(question, assumed, limits);
  return verdict;
}

Verdict CostProblem::solve_assuming(const Question& question, const std::vector<Level>& assumed,
                                    LimitMonitor& limits) {
  std::vector<Lit> literals;
  for (const Level& level : assumed) literals.push_back(~literal_of(level));
  const Verdict verdict = solve_in_slices(literals, limits, question.budget);
  if (yield_point_ != nullptr) yield_point_->yield();
  core_.clear();
  ceilings_of_core_.clear();
  if (verdict == Verdict::unsat) {
    const std::vector<Lit> failed = engine_.core();
    const auto has_failed = [&](std::size_t k) {
      return std::find(failed.begin(), failed.end(), literals[k]) != failed.end();
    };
    for (std::size_t k = 0; k < question.below.size(); ++k)
      if (has_failed(k)) core_.push_back(question.below[k]);
    if (keeps_ceilings_)
      for (std::size_t k = question.below.size(); k < assumed.size(); ++k)
        if (has_failed(k)) ceilings_of_core_.push_back(assumed[k].agent);
  }
  return verdict;
}

Verdict CostProblem::solve_in_slices(const std::vector<Lit>& assumptions, LimitMonitor& limits,
                                     const sat::SolveBudget& budget) {
  const std::int64_t end = limits.conflicts() + budget.conflicts.value_or(0);
  sat::SolveBudget slice = budget;
  // The decisions of a slice are not known: such solves are short and stay in one piece, as do
  // those with an effort of their own.
  const bool is_sliced = !budget.decisions && !budget.effort;
  while (true) {
    if (is_sliced) slice.effort = kSlice;
    if (is_sliced && budget.conflicts)
      slice.conflicts = static_cast<int>(
          std::clamp<std::int64_t>(end - limits.conflicts(), 1, std::numeric_limits<int>::max()));
    const Effort slice_end = engine_.effort() + kSlice;
    const Verdict verdict = engine_.solve(assumptions, limits, slice);
    const bool is_over = verdict != Verdict::unknown || !is_sliced ||
                         engine_.effort() < slice_end ||
                         (budget.conflicts && limits.conflicts() >= end);
    if (is_over) return verdict;
    if (yield_point_ != nullptr) yield_point_->yield();
    if (limits.exhausted_now()) return verdict;
  }
}

bool CostProblem::accept_model() { return accept_paths() && accept_fees(); }

bool CostProblem::accept_fees() {
  if (fees().empty()) return true;
  std::vector<VertexId> unpaid;
  for (const Fee& fee : fees())
    if (!engine_.model_value(model_.left_over(fee.goal, writer_)) && !ends_at(plan(), fee.goal))
      unpaid.push_back(fee.goal);
  // A clause ends the model.
  for (const VertexId goal : unpaid) model_.take(goal, writer_);
  return unpaid.empty();
}

bool CostProblem::accept_paths() {
  if (theory_in_search_) {
    QUADRILLE_REQUIRE(theory_.accepted().has_value(), "models are accepted by the theory");
    return true;
  }
  std::vector<Lit> assignment;
  for (const Lit lit : model_.literals())
    assignment.push_back(engine_.model_value(lit) ? lit : ~lit);
  return theory_.check_complete(assignment, writer_);
}

Cost CostProblem::cost_in(const Plan& plan, AgentId payer) const {
  if (!is_fee(payer)) return cost(plan.paths[payer]);
  return ends_at(plan, fee(payer).goal) ? 0 : fee(payer).amount;
}

std::optional<Level> CostProblem::level_above(AgentId payer, Cost cap) const {
  if (!is_fee(payer)) return Level{payer, cap + 1};
  if (cap >= fee(payer).amount) return std::nullopt;
  return Level{payer, fee(payer).amount};
}

Lit CostProblem::literal_of(const Level& level) {
  return is_fee(level.agent) ? model_.left_over(fee(level.agent).goal, writer_)
                             : model_.above(level.agent, level.cost - 1, writer_);
}

std::optional<Cost> CostProblem::next_threshold(AgentId agent, Cost cost) const {
  if (is_fee(agent)) return std::nullopt;
  const auto& known = model_.rungs(agent);
  const auto at = std::find_if(known.begin(), known.end(),
                               [&](const Model::Rung& t) { return t.cost > cost && t.is_natural; });
  if (at == known.end()) return std::nullopt;
  return at->cost;
}

void CostProblem::add_core(const std::vector<Level>& core, const IdVector<AgentId, Cost>& ceilings,
                           const std::vector<AgentId>& resting_on) {
  const std::vector<Lit> clause = clause_of(core);
  if (sat::ProofLog* const log = engine_.proof()) {
    std::vector<sat::ProofLog::Beyond> beyond;
    for (const AgentId i : resting_on) beyond.push_back({i, model_.above(i, ceilings[i], writer_)});
    log->conclude(clause, beyond);
  }
  if (auditor_ != nullptr) {
    std::vector<Lit> given;
    for (const AgentId i : payers())
      if (ceilings[i] < kAnyCost)
        if (const auto level = level_above(i, ceilings[i])) given.push_back(~literal_of(*level));
    auditor_->assume(std::move(given));
    if (clause.empty()) auditor_->audit(clause);
  }
  if (clause.empty()) return;
  engine_.add_clause({sat::why::Core{}, clause, {}, false});
}

void CostProblem::claim(Cost bound) {
  if (sat::ProofLog* const log = engine_.proof()) log->claim_by_core(bound, engine_.core());
}

void CostProblem::take_core(const std::vector<Level>& core) {
  engine_.add_clause({sat::why::Core{}, clause_of(core), {}, false});
}

std::vector<Lit> CostProblem::clause_of(const std::vector<Level>& core) {
  std::vector<Lit> clause;
  for (const Level& level : core) clause.push_back(literal_of(level));
  return clause;
}

}  // namespace quadrille::continuous
