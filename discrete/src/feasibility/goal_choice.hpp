// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// One goal for each agent out of its set.
struct GoalChoice {
  Feasibility feasibility;  ///< Of the instance with all its goals.
  /// The instance with goals for which it has a plan. Absent if the answer is negative or not
  /// decided, or if a limit was met.
  std::optional<Instance> chosen;
};

/// Looks for goals with which there is a plan: those that cost least if nobody is in the way, and
/// then all others in their order for as long as that takes few steps. Exact in both
/// directions where the answer is decided: a plan ends with some choice. `limits` may be null.
[[nodiscard]] GoalChoice choose_goals(const Instance& instance, LimitMonitor* limits);

}  // namespace quadrille::discrete
