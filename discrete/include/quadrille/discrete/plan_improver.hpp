// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// Makes a plan cheaper by large-neighbourhood search (Li et al., "Anytime multi-agent path finding
/// via large neighborhood search", IJCAI 2021): takes a few agents out of the plan, gives them new
/// paths one after the other, and keeps the result unless it is costlier. Which agents are taken
/// out together, and how many, is learned from what paid. One thread. It proves nothing about
/// costs. It can be run in slices of a given *effort*, as PrimalSearch: what it does depends on
/// instance, plan, seed and the efforts asked for, never on clocks.
///
/// The objective decides first. For the makespan the sum of costs breaks ties.
class PlanImprover {
 public:
  /// Requires that `plan` is a valid plan of `instance`, and `distances` its distances. With prices
  /// of goals in them, for the sum of costs only, each agent takes the goal that is cheapest for
  /// all rather than the nearest one that is free; costs are those without prices all the same.
  PlanImprover(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
               Objective objective, const Plan& plan, std::uint32_t seed);
  ~PlanImprover();
  PlanImprover(PlanImprover&&) noexcept;
  PlanImprover& operator=(PlanImprover&&) noexcept;

  /// One neighbourhood. True if the plan is cheaper now (or as dear, with a smaller sum of costs).
  /// When a limit is met on the way the plan stays as it was.
  bool step(LimitMonitor& limits);
  /// Steps until `effort` more is spent, a limit is met, or the plan costs `target` or less. True
  /// if the plan is cheaper than before.
  bool improve(std::int64_t effort, LimitMonitor& limits, Cost target = 0);

  /// Goes on from another plan, a cheaper one that was found elsewhere for instance. Requires a
  /// valid plan of the same instance. What was learned is kept.
  void restart_from(const Plan& plan);

  [[nodiscard]] const Plan& plan() const noexcept;     ///< Trimmed, always valid.
  [[nodiscard]] Cost cost() const noexcept;            ///< Of the objective.
  [[nodiscard]] std::int64_t effort() const noexcept;  ///< Spent so far.
  /// Every agent takes a shortest path: no plan is better, and steps do nothing.
  [[nodiscard]] bool is_ideal() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
