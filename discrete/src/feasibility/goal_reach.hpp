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

/// Prices that make agents take different goals by themselves: the least costs and prices of all
/// agents, less all prices, come to what a cheapest assignment costs. Every plan costs the agents'
/// costs and prices, and the prices of the goals that are left over, less all prices.
struct PricedGoals {
  std::shared_ptr<const GoalPrices> prices;
  std::shared_ptr<const GoalDistances> distances;  ///< With prices.
  std::vector<VertexId> left_over;                 ///< With a price, where plans need not use them.
  Cost paid = 0;                                   ///< All prices.
};

/// nullopt where prices change nothing, if nobody can reach different goals, or if a limit was met.
[[nodiscard]] std::optional<PricedGoals> price_goals(const Instance& instance,
                                                     LimitMonitor& limits);

}  // namespace quadrille::discrete
