// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Who could end where, and what it costs at least.
struct Reach {
  std::size_t goal;
  Cost cost;
};

/// A cheapest assignment of goals to agents, and prices of the goals that prove that it is one.
struct Assignment {
  std::vector<std::size_t> goals;  ///< By agent.
  /// By goal, >= 0. No agent can end at `g` for less than `u - price[g]`, where u is the least
  /// cost + price of its goals; the sum of all u, less that of all prices, is what the assignment
  /// costs. So prices are what agents have to pay each other: with them everybody takes the goal
  /// that is cheapest for itself. 0 where nobody ends.
  std::vector<Cost> prices;
};

/// Hungarian method, by shortest augmenting paths with reduced costs (Jonker, Volgenant, "A
/// shortest augmenting path algorithm for dense and sparse linear assignment problems", Computing
/// 1987). `reach`: by agent, each goal once, all below `num_goals`; costs >= 0. nullopt if there is
/// no assignment, or if a limit was met. O(agents * (E log E)), E being all that can be reached.
[[nodiscard]] std::optional<Assignment> cheapest_assignment(
    const std::vector<std::vector<Reach>>& reach, std::size_t num_goals, LimitMonitor& limits);

/// Agents that together can reach fewer goals than they are, increasing; empty if all can have
/// different goals. Augmenting paths, found breadth first: O(agents * E).
[[nodiscard]] std::vector<AgentId> find_crowd(const std::vector<std::vector<Reach>>& reach,
                                              std::size_t num_goals);
/// Says so, with the numbers of the agents.
[[nodiscard]] std::string describe_crowd(const std::vector<AgentId>& agents);

/// By goal: whether a plan may leave it over. In each part of agents and goals that have to do with
/// each other, all goals are taken if there are as many agents.
[[nodiscard]] std::vector<bool> may_be_left_over(const std::vector<std::vector<Reach>>& reach,
                                                 std::size_t num_goals);

}  // namespace quadrille

QUADRILLE_API_END
