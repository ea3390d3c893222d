// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lazy/lazy_model.hpp"
#include "lazy/lazy_theory.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/sat/cost_problem.hpp"
#include "quadrille/sat/totalizer.hpp"

namespace quadrille::discrete {

/// The lazy path model as the cost searches see it. The theory has accepted every model that is
/// found: there is nothing left to exclude.
class LazyProblem final : public sat::CostProblem {
 public:
  /// All outlive the problem. `engine` consults `theory`.
  LazyProblem(LazyModel& model, sat::Engine& engine, LazyTheory& theory, Objective objective);

  [[nodiscard]] Cost lower_bound() const override { return lower_bound_; }
  [[nodiscard]] bool assume_at_most(Cost bound, LimitMonitor& limits,
                                    std::vector<sat::Lit>& assumptions) override;
  [[nodiscard]] bool accept_model() override;
  [[nodiscard]] Cost next_bound(Cost refuted, std::span<const sat::Lit> core) override;

  [[nodiscard]] std::size_t num_agents() const override { return model_.instance().num_agents(); }
  [[nodiscard]] Cost free_cost(AgentId agent) const override {
    return model_.distances(agent).free_cost();
  }
  /// Nothing: paths have no clauses here.
  [[nodiscard]] bool grow_to(AgentId, Cost, LimitMonitor&) override { return true; }
  [[nodiscard]] sat::Lit cost_above(AgentId agent, Cost cost) override;
  /// Prices of goals that nobody takes.
  [[nodiscard]] std::span<const Fee> fees() const override { return fees_; }
  void on_solve(bool all_present) override;
  [[nodiscard]] std::vector<AgentId> agents_of(std::span<const sat::Lit> core) const override;

  /// The plan of the last accepted model.
  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }

 private:
  /// What the input of that number, an agent or else a fee, comes to beyond its least.
  [[nodiscard]] sat::Lit delay(std::size_t input, int k);
  [[nodiscard]] bool is_taken(VertexId goal) const;

  LazyModel& model_;
  sat::Engine& engine_;
  LazyTheory& theory_;
  const Objective objective_;
  lazy::EngineWriter writer_;
  Cost lower_bound_ = 0;
  std::vector<Fee> fees_;  // of LazyModel::may_be_left_over, in their order
  sat::Totalizer total_delay_;
  Plan plan_;
};

}  // namespace quadrille::discrete
