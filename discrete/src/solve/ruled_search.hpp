// SPDX-License-Identifier: MIT
#pragma once

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
      : distances_(std::move(distances)),
        incumbent_(incumbent),
        plans_(instance, *distances_, objective, seed, limits) {}

  /// There is no plan yet, and the search for the bound can wait for one.
  [[nodiscard]] bool is_first_plan_due() const;
  /// One slice. Returns what it took, or what a slice is if that is more.
  Effort work();
  /// As many slices as are due after that effort of the search, a share of it. `after_slice` is
  /// called after each.
  void advance(Effort search_effort, const std::function<void()>& after_slice);

 private:
  const std::shared_ptr<const GoalDistances> distances_;
  Incumbent& incumbent_;
  RuledPlans plans_;
  Effort credit_, seen_effort_;
};

}  // namespace quadrille::discrete
