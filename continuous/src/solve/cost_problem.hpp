// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/engine.hpp"
#include "theory/model.hpp"
#include "theory/theory.hpp"

namespace quadrille::continuous {

/// Writes to an engine between solves.
class EngineWriter final : public FormulaWriter {
 public:
  explicit EngineWriter(sat::Engine& engine) : engine_(engine) {}
  [[nodiscard]] sat::Lit new_lit() override { return engine_.new_lit(); }
  void add(const sat::Lemma& lemma) override { engine_.add_clause(lemma); }

 private:
  sat::Engine& engine_;
};

/// What the cost searches ask: whether there is a plan in which nobody costs more than its share.
class CostProblem {
 public:
  /// `theory_in_search`: the engine consults the theory while it searches; otherwise complete
  /// assignments are checked here, between solves. All arguments outlive the problem.
  CostProblem(Model& model, sat::Engine& engine, ContinuousTheory& theory, bool theory_in_search);

  /// Looks for a plan in which each agent costs at most `caps[agent]`. Requires caps of at least
  /// the free costs.
  [[nodiscard]] sat::Verdict solve(const IdVector<AgentId, Cost>& caps, LimitMonitor& limits);
  /// Looks for any plan, or one whose costs sum up to at most `total`.
  [[nodiscard]] sat::Verdict solve_within(std::optional<Cost> total, LimitMonitor& limits,
                                          const sat::SolveBudget& budget);
  /// The plan that the last solve with verdict sat found.
  [[nodiscard]] const Plan& plan() const { return *theory_.accepted(); }

  /// A cost that an agent does not stay below.
  struct Level {
    AgentId agent;
    Cost cost = 0;
    friend auto operator<=>(const Level&, const Level&) = default;
  };
  /// After verdict unsat: in every plan one of these levels is reached. Empty: there is no plan.
  [[nodiscard]] std::vector<Level> core() const { return core_; }

  /// As solve, but looks only at the clauses that are known: is it clear already that one of these
  /// levels is reached in every plan? On unsat `core` is some of them.
  [[nodiscard]] sat::Verdict refute(const std::vector<Level>& below, LimitMonitor& limits,
                                    const sat::SolveBudget& budget = {});

  /// As refute, but the theory may look for new clauses during the search, and only plans count in
  /// which agents that are not in `below` cost at most their ceilings (kForever: anything).
  [[nodiscard]] sat::Verdict try_refute(const std::vector<Level>& below,
                                        const IdVector<AgentId, Cost>& ceilings,
                                        LimitMonitor& limits, const sat::SolveBudget& budget);

  /// The smallest natural threshold (see Model) above `cost`.
  [[nodiscard]] std::optional<Cost> next_threshold(AgentId agent, Cost cost) const;
  /// Tells the engine that one of the levels is reached in every plan.
  void add_core(const std::vector<Level>& core);

  [[nodiscard]] Model& model() noexcept { return model_; }

 private:
  [[nodiscard]] sat::Verdict solve_assuming(const std::vector<Level>& below, sat::Lit also,
                                            LimitMonitor& limits, const sat::SolveBudget& budget);
  [[nodiscard]] sat::Verdict solve_with_theory(const std::vector<Level>& below, sat::Lit also,
                                               LimitMonitor& limits,
                                               const sat::SolveBudget& budget);
  [[nodiscard]] bool accept_model();

  Model& model_;
  sat::Engine& engine_;
  ContinuousTheory& theory_;
  const bool theory_in_search_;
  EngineWriter writer_;
  std::vector<Level> core_;
};

}  // namespace quadrille::continuous
