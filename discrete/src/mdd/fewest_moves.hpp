// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mdd/mdd_problem.hpp"

namespace quadrille::discrete {

/// The plans of an MddProblem that cost at most some cost, which some plan does, by how many moves
/// they have. The cost of a plan is its number of moves here (docs/soundness/rules.md, section 15).
///
/// With h(v) the distance from v to the agent's goal, a move from v to w is 1 + h(w) - h(v) *more*
/// than need be, and the moves of a path are h(start) and what all of them are more. So what is
/// counted is only what leads away from goals, or not nearer. Where the graph has two parts, as
/// grids have, that is even, and counted in twos.
class FewestMoves final : public sat::CostProblem {
 public:
  /// All outlive it. `cost`: by the objective of the problem, at least its lower bound.
  FewestMoves(MddModel& model, MddProblem& problem, sat::Engine& engine, Cost cost);

  [[nodiscard]] std::size_t num_agents() const override { return problem_.num_agents(); }
  [[nodiscard]] Cost free_cost(AgentId agent) const override {
    return model_.mdd(agent).distance();
  }
  /// Only for searches upwards: plans have no bounds for single agents.
  [[nodiscard]] bool grow_to(AgentId, Cost, LimitMonitor&) override { return false; }
  [[nodiscard]] sat::Lit cost_above(AgentId, Cost) override { return {}; }

  [[nodiscard]] Cost lower_bound() const override { return least_; }
  [[nodiscard]] bool assume_at_most(Cost bound, LimitMonitor& limits,
                                    std::vector<sat::Lit>& assumptions) override;
  [[nodiscard]] Cost next_bound(Cost refuted, std::span<const sat::Lit> core) override;
  void on_solve(bool all_present) override { problem_.on_solve(all_present); }
  [[nodiscard]] bool accept_model() override { return problem_.accept_model(); }

 private:
  /// "The agent's move that begins at `t` is `amount` units or more than need be", amount >= 1.
  /// Invalid for more than a move can be.
  [[nodiscard]] sat::Lit more(std::size_t input, int amount);
  /// The moves of the agent's layers that are new.
  void extend(AgentId agent);

  MddModel& model_;
  MddProblem& problem_;
  sat::Engine& engine_;
  const Cost cost_;
  Cost least_ = 0;
  Timestep unit_ = 1, most_ = 2;  // what moves are more, and at most, in units
  IdVector<AgentId, std::size_t> first_input_;
  IdVector<AgentId, Timestep> seen_cap_;
  std::vector<std::vector<sat::Lit>> more_;  // [input][amount - 1]
  std::optional<sat::Totalizer> total_;
  sat::Lit too_many_;  // of the last bound
};

}  // namespace quadrille::discrete
