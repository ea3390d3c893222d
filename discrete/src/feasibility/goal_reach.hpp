// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "quadrille/core/assignment.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// Which goals agents can reach, and in how many moves.
struct GoalReach {
  std::vector<VertexId> goals;             ///< All that somebody has, increasing.
  std::vector<std::vector<Reach>> agents;  ///< Of each its goals, nearest first.
};

/// One breadth-first search per agent: O(agents * (V + E)). nullopt if a limit was met.
[[nodiscard]] std::optional<GoalReach> find_goal_reach(const Instance& instance,
                                                       LimitMonitor& limits);

/// Prices that make agents take different goals by themselves, as far as all plans pay them: then
/// the least sum of costs and prices is nearer to what agents cost who choose different goals.
struct PricedGoals {
  std::shared_ptr<const GoalPrices> prices;
  std::shared_ptr<const GoalDistances> distances;  ///< With prices.
  Cost paid = 0;                                   ///< In every plan.
};

/// nullopt where prices change nothing, if nobody can reach different goals, or if a limit was met.
[[nodiscard]] std::optional<PricedGoals> price_goals(const Instance& instance,
                                                     LimitMonitor& limits);

}  // namespace quadrille::discrete
