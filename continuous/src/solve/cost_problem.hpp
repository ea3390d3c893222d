// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cover/core_table.hpp"
#include "quadrille/sat/core_auditor.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/engine.hpp"
#include "theory/model.hpp"
#include "theory/theory.hpp"

namespace quadrille::continuous {

/// All that a cost search asks at once: is there a plan like this?
struct Question {
  /// Each of these agents costs less than its level. Requires levels above the free costs.
  std::vector<Level> below = {};
  /// The most that each of the other agents costs (kAnyCost: anything). Empty: anything.
  IdVector<AgentId, Cost> ceilings = {};
  /// When to give up.
  sat::SolveBudget budget = {};

  /// Which clauses may be used.
  enum class Search {
    full,          ///< All that the theory finds.
    quick,         ///< Those of collisions; no agents are searched together. As `known`, and
                   ///< without ceilings, where the theory does not take part in the search.
    known_clauses  ///< Those that are there. On sat, there need not be a plan.
  };
  Search search = Search::full;
};

/// Asks the engine. What it learns stays true for later questions, relative to the incumbent: see
/// Model.
///
/// Levels and costs are those of *payers*: the agents, and after them the fees of the scene. A fee
/// costs nothing, or its amount, which is its only level.
class CostProblem {
 public:
  /// `theory_in_search`: the engine consults the theory while it searches; otherwise complete
  /// assignments are checked here, between solves. Long solves are cut into slices of effort;
  /// `yield_point`, unless null, is passed after each slice and each solve. `auditor`, unless null,
  /// proves each core again; it hears the engine's clauses, too. All arguments outlive the problem.
  CostProblem(Model& model, sat::Engine& engine, ContinuousTheory& theory, bool theory_in_search,
              sat::YieldPoint* yield_point = nullptr, sat::CoreAuditor* auditor = nullptr);

  /// Unknown: `limits` or the budget ended the search.
  [[nodiscard]] sat::Verdict solve(const Question& question, LimitMonitor& limits);
  /// The plan that the last solve with verdict sat found, unless it was of known clauses only.
  [[nodiscard]] const Plan& plan() const { return *theory_.accepted(); }
  /// After verdict unsat, some of the levels in `below`: one of them is reached in every plan that
  /// is cheaper than the incumbent and keeps to the ceilings. Empty: there is no such plan.
  [[nodiscard]] const std::vector<Level>& core() const noexcept { return core_; }
  /// From now on, remembers whose ceilings a core rests on.
  void keep_ceilings_of_core() { keeps_ceilings_ = true; }
  /// Of the last core: the agents whose ceilings were needed to refute it. Increasing.
  [[nodiscard]] const std::vector<AgentId>& ceilings_of_core() const noexcept {
    return ceilings_of_core_;
  }

  [[nodiscard]] IdRange<AgentId> payers() const { return IdRange<AgentId>(num_payers()); }
  [[nodiscard]] bool is_fee(AgentId payer) const { return payer.index() >= num_agents(); }
  [[nodiscard]] Cost free_cost(AgentId payer) const {
    return is_fee(payer) ? 0 : model_.free_cost(payer);
  }
  /// What the payer pays in a plan.
  [[nodiscard]] Cost cost_in(const Plan& plan, AgentId payer) const;
  /// What all of them do.
  [[nodiscard]] Cost cost_of(const Plan& plan) const {
    return model_.scene().cost(plan, Objective::sum_of_costs);
  }
  /// The least level above `cap`; nothing for a fee that is capped by no less than its amount.
  [[nodiscard]] std::optional<Level> level_above(AgentId payer, Cost cap) const;

  /// The smallest natural rung (see lazy::Vocabulary) above `cost`; none of a fee.
  [[nodiscard]] std::optional<Cost> next_threshold(AgentId agent, Cost cost) const;
  /// Tells the engine that one of the levels is reached in every plan that is cheaper than the
  /// incumbent, because it is in those that keep to the ceilings. An empty core is audited only.
  /// `resting_on`: the agents whose ceilings it rests on, if the engine's log has to know.
  void add_core(const std::vector<Level>& core, const IdVector<AgentId, Cost>& ceilings,
                const std::vector<AgentId>& resting_on);
  /// Tells the engine's log that no plan costs less than this, by the last core.
  void claim(Cost bound);

  /// A core that another search of the same instance has found: it holds in every plan that is
  /// cheaper than an incumbent which is known here, too. It is not audited.
  void take_core(const std::vector<Level>& core);

  /// The engine's elementary steps so far.
  [[nodiscard]] Effort effort() const { return engine_.effort(); }
  [[nodiscard]] Model& model() noexcept { return model_; }

 private:
  /// `assumed`: each costs less than its level; first those of the question's `below`.
  [[nodiscard]] sat::Verdict solve_assuming(const Question& question,
                                            const std::vector<Level>& assumed,
                                            LimitMonitor& limits);
  [[nodiscard]] sat::Verdict solve_in_slices(const std::vector<sat::Lit>& assumptions,
                                             LimitMonitor& limits, const sat::SolveBudget& budget);
  [[nodiscard]] bool accept_model();
  [[nodiscard]] bool accept_paths();
  /// Clauses for the fees that the model does not pay and its plan does. False: there are some.
  [[nodiscard]] bool accept_fees();
  [[nodiscard]] sat::Lit literal_of(const Level& level);
  [[nodiscard]] std::vector<sat::Lit> clause_of(const std::vector<Level>& core);
  [[nodiscard]] std::size_t num_agents() const { return model_.instance().num_agents(); }
  [[nodiscard]] std::size_t num_payers() const { return num_agents() + fees().size(); }
  [[nodiscard]] const std::vector<Fee>& fees() const { return model_.scene().fees(); }
  [[nodiscard]] const Fee& fee(AgentId payer) const { return fees()[payer.index() - num_agents()]; }

  Model& model_;
  sat::Engine& engine_;
  ContinuousTheory& theory_;
  const bool theory_in_search_;
  sat::YieldPoint* const yield_point_;
  sat::CoreAuditor* const auditor_;
  lazy::EngineWriter writer_;
  std::vector<Level> core_;
  bool keeps_ceilings_;
  std::vector<AgentId> ceilings_of_core_;
};

}  // namespace quadrille::continuous
