// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "quadrille/core/settings.hpp"
#include "quadrille/discrete/plan_improver.hpp"

namespace quadrille::discrete {

/// Begins the improvement of the first plan again, with other random choices, when that of the
/// incumbent has come to a dead end: on mazes plans of nearly the same cost differ in what
/// neighbourhoods can make of them, and a cheap one that was made of a draft may be worth less than
/// a dear one.
class SecondChance {
 public:
  /// `instance` and `settings` outlive the object. `first` is a valid plan of the instance.
  SecondChance(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
               Objective objective, std::shared_ptr<const Plan> first, std::uint32_t seed,
               const Settings& settings)
      : instance_(instance),
        distances_(std::move(distances)),
        objective_(objective),
        first_(std::move(first)),
        settings_(settings),
        seed_(seed) {}

  /// To be told of the incumbent: the effort for it so far, its cost, and how much of that is not
  /// proved necessary. Begins if less and less is gained.
  void watch(std::int64_t effort, Cost cost, Cost gap);
  [[nodiscard]] bool is_at_work() const noexcept { return improver_.has_value(); }
  /// Improves the plan at work. `cost`: of the incumbent. Ends when the effort is used up that it
  /// was given, or when it cannot become cheaper than the incumbent with it. Returns the plan if it
  /// is cheaper. Requires that one is at work.
  [[nodiscard]] std::optional<Plan> advance(std::int64_t effort, LimitMonitor& limits, Cost cost);
  /// Of all that were at work, in elementary steps.
  [[nodiscard]] std::int64_t effort() const noexcept {
    return past_effort_ + (improver_ ? improver_->effort() : 0);
  }

 private:
  [[nodiscard]] bool is_hopeless(Cost cost);

  const Instance& instance_;
  const std::shared_ptr<const GoalDistances> distances_;
  const Objective objective_;
  const std::shared_ptr<const Plan> first_;
  const Settings& settings_;
  std::uint32_t seed_;

  // Of the incumbent, when it was looked at last.
  std::int64_t watched_effort_ = 0;
  std::optional<Cost> watched_cost_;
  std::int64_t next_look_ = 2'000'000;  // effort for the incumbent and here

  std::int64_t past_effort_ = 0;  // of those that are over
  std::optional<PlanImprover> improver_;
  std::int64_t allowed_ = 0;  // effort for it
  // Of it, when its hopes were looked at last.
  std::int64_t seen_effort_ = 0;
  Cost seen_cost_ = 0;
};

}  // namespace quadrille::discrete
