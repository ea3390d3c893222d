// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "quadrille/core/effort.hpp"
#include "ruled/ruled_plans.hpp"
#include "solve/incumbent.hpp"

namespace quadrille::discrete {

/// Under rules: looks for a first plan, then improves the incumbent, before and beside the search
/// for the bound. In the place of PlanSearch.
class RuledSearch {
 public:
  /// `instance`, `incumbent` and `limits` outlive it.
  RuledSearch(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
              Objective objective, std::uint32_t seed, Incumbent& incumbent, LimitMonitor& limits)
      : instance_(instance),
        distances_(std::move(distances)),
        incumbent_(incumbent),
        limits_(limits),
        objective_(objective),
        seed_(seed),
        plans_(instance, *distances_, objective, seed, limits) {}

  /// There is no plan yet, and the search for the bound can wait for one.
  [[nodiscard]] bool is_first_plan_due() const;
  /// One slice. Returns what it took, or what a slice is if that is more.
  Effort work();
  /// As many slices as are due after that effort of the search, a share of it. `after_slice` is
  /// called after each.
  void advance(Effort search_effort, const std::function<void()>& after_slice);

 private:
  [[nodiscard]] bool may_add_turns() const { return instance_.poses() && !has_added_turns_; }
  /// Where agents turn, and nothing else is asked of them: of a plan in which they need not.
  /// Returns what its improvement took.
  Effort add_turns();

  const Instance& instance_;
  const std::shared_ptr<const GoalDistances> distances_;
  Incumbent& incumbent_;
  LimitMonitor& limits_;
  const Objective objective_;
  const std::uint32_t seed_;
  bool has_added_turns_ = false;
  RuledPlans plans_;
  Effort credit_, seen_effort_;
};

}  // namespace quadrille::discrete
