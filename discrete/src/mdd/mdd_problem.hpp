// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "mdd/collision_theory.hpp"
#include "mdd/eager_collisions.hpp"
#include "mdd/mdd_model.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/sat/cost_problem.hpp"
#include "quadrille/sat/totalizer.hpp"

namespace quadrille::discrete {

/// An MddModel whose plans are bounded by assumptions, for both objectives.
///
/// Each agent's guard limits its delay to its cap. With MddGrowth::full the cap is all that the
/// bound leaves to one agent, as published. With MddGrowth::on_demand caps start at 0 and only grow
/// when a core names them: a core in which every named cap is at what the bound allows refutes the
/// bound, because the unnamed ones do not matter. The core-guided search has caps of its own.
class MddProblem final : public sat::CostProblem {
 public:
  /// All outlive the problem; the model is attached to `engine`. `theory` and `eager` may be null.
  MddProblem(MddModel& model, sat::Engine& engine, CollisionTheory* theory, EagerCollisions* eager,
             MddGrowth growth);

  [[nodiscard]] Cost lower_bound() const override { return lower_bound_; }
  [[nodiscard]] bool assume_at_most(Cost bound, LimitMonitor& limits,
                                    std::vector<sat::Lit>& assumptions) override;
  [[nodiscard]] bool accept_model() override;
  [[nodiscard]] Cost next_bound(Cost refuted, std::span<const sat::Lit> core) override;

  [[nodiscard]] std::size_t num_agents() const override { return model_.instance().num_agents(); }
  [[nodiscard]] Cost free_cost(AgentId agent) const override { return model_.free_cost(agent); }
  [[nodiscard]] bool grow_to(AgentId agent, Cost cost, LimitMonitor& limits) override;
  [[nodiscard]] sat::Lit cost_above(AgentId agent, Cost cost) override;
  void on_solve(bool all_present) override;

  /// The plan of the last accepted model.
  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
  /// Models that were looked at from outside of the search, and how many of them had collisions.
  [[nodiscard]] std::int64_t num_checks() const noexcept { return num_checks_; }
  [[nodiscard]] std::int64_t num_rejected() const noexcept { return num_rejected_; }
  /// The largest delay that a plan of cost `bound` leaves to an agent.
  [[nodiscard]] Timestep allowed_delay(AgentId agent, Cost bound) const;

 private:
  MddModel& model_;
  sat::Engine& engine_;
  CollisionTheory* theory_;
  EagerCollisions* eager_;
  MddGrowth growth_;
  Cost lower_bound_ = 0;
  sat::Totalizer total_;
  IdVector<AgentId, Timestep> wanted_cap_;
  Plan plan_;
  std::int64_t num_checks_ = 0, num_rejected_ = 0;
};

}  // namespace quadrille::discrete
