// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "paths/steps.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::continuous {

/// Bans that keep agents of class `a` clear of what an agent of class `b` does.
[[nodiscard]] std::vector<Ban> bans_around(Scene& scene, ClassId a, ClassId b,
                                           const std::vector<Step>& steps);

/// Makes a plan cheaper by large neighbourhood search (Li et al. 2021, IJCAI): some agents give up
/// their paths and take cheapest ones around all others, one after the other. For the sum of costs.
/// Proves nothing. Deterministic.
class PlanImprover {
 public:
  explicit PlanImprover(Scene& scene);

  /// Improves `plan`, which is valid, for about so much effort, in visits of the path search. Stops
  /// early when the limits of the scene are met.
  void improve(Plan& plan, std::int64_t effort);

 private:
  struct AgentState {
    TimedPath path;
    std::vector<Step> steps;
    std::vector<std::vector<Ban>> bans;  // around it, by class of the others
    std::size_t slot = 0;                // in all tables
  };
  void start(const Plan& plan);
  /// Fills the tables with the bans around all current paths.
  void load();
  /// Steps and bans of its path.
  void list_bans(AgentId i, AgentState& agent);
  void add_slot(AgentState& agent);
  void enable(std::size_t slot, bool on);
  [[nodiscard]] Cost delay(AgentId i) const {
    return as_cost(agents_[i].path.arrival) - scene_.free_cost(i);
  }
  [[nodiscard]] std::vector<AgentId> choose();
  [[nodiscard]] AgentId choose_delayed();
  /// They get new paths, if these cost less, or as much in sum.
  void replan(const std::vector<AgentId>& chosen);
  [[nodiscard]] std::size_t draw(std::size_t count) {
    return static_cast<std::size_t>(random_.below(count));
  }

  Scene& scene_;
  PathFinder finder_;
  std::vector<BanTable> tables_;  // by class
  BanTable nothing_;
  std::size_t num_slots_ = 0;
  IdVector<AgentId, AgentState> agents_;
  Random random_{1};
};

}  // namespace quadrille::continuous
