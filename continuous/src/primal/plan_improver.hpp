// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/core/random.hpp"
#include "traffic/steps.hpp"
#include "traffic/traffic.hpp"

namespace quadrille::continuous {

/// Makes a plan cheaper by large neighbourhood search (Li et al. 2021, IJCAI): some agents give up
/// their paths and take cheapest ones around all others, one after the other. For the sum of costs.
/// Proves nothing. Deterministic.
class PlanImprover {
 public:
  /// `plan` is a valid plan of the scene's instance.
  PlanImprover(Scene& scene, Plan plan);

  /// Goes on for about `effort`. True if the plan is cheaper now. Stops early when the limits of
  /// the scene are met.
  bool improve(Effort effort);
  /// It has not been without gain for as long as all before took, and some more; and if little is
  /// left above the free costs, the last turn has gained a good part of that.
  [[nodiscard]] bool pays() const;
  /// Goes on from another plan, a cheaper one that was found elsewhere for instance.
  void restart_from(Plan plan);

  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
  [[nodiscard]] Cost cost() const noexcept { return cost_; }
  /// So far. Measured: 25 to 60 ns for an edge that is looked at, a ban that is made, two steps
  /// that are compared.
  [[nodiscard]] Effort effort() const noexcept {
    return (num_compared_ + traffic_->effort() + finder_.effort()) * Effort::nanoseconds(25);
  }
  /// Every agent takes a cheapest path: nothing can be gained.
  [[nodiscard]] bool is_done() const;

 private:
  struct AgentState {
    TimedPath path;
    std::vector<Step> steps;
    Traffic::Handle place = 0;  // in the traffic
    bool is_under_way = false;  // it has one
  };
  /// What the plan costs above the free costs.
  [[nodiscard]] Cost excess() const;
  void load_paths();
  /// Steps of its path, and the path into the traffic.
  void put(AgentId i, AgentState& agent);
  void take_out(AgentState& agent);
  [[nodiscard]] Cost delay(AgentId i) const {
    return as_cost(agents_[i].path.arrival) - scene_.free_cost(i);
  }
  [[nodiscard]] std::vector<AgentId> choose();
  /// In proportion to delays; anybody, if nobody is late.
  [[nodiscard]] AgentId choose_delayed();
  /// They get new paths, if these cost less, or as much in sum.
  /// True if they cost less.
  bool replan(const std::vector<AgentId>& chosen);
  [[nodiscard]] std::size_t draw(std::size_t count) {
    return static_cast<std::size_t>(random_.below(count));
  }

  Scene& scene_;
  Plan plan_;
  Cost cost_;
  PathFinder finder_;
  std::unique_ptr<Traffic> traffic_;
  IdVector<AgentId, std::vector<Step>> free_steps_;  // Of cheapest paths of agents that are alone.
  bool is_loaded_ = false;                           // The paths are those of the plan.
  IdVector<AgentId, AgentState> agents_;
  Random random_{1};
  Cost turn_gain_ = 0;             // Of the last turn.
  Effort last_gain_;               // The effort until then.
  std::int64_t num_compared_ = 0;  // Steps.
};

}  // namespace quadrille::continuous
