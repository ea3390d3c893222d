// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/assignment.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::continuous {

/// When those agents that stay can be at their goals, each if it is alone.
struct GoalReach {
  std::vector<VertexId> goals;            ///< Of all of them, increasing.
  std::vector<AgentId> agents;            ///< Those that stay.
  std::vector<std::vector<Reach>> reach;  ///< By their number among these; costs are arrivals.
};

/// A search for shortest ways per agent. nullopt if a limit was met, or if two agents may end in
/// one place: polygons may lie beside their positions.
[[nodiscard]] std::optional<GoalReach> find_goal_reach(const Instance& instance,
                                                       LimitMonitor& limits);

/// Agents with goal sets, and others, that can reach fewer goals together than they are. Empty:
/// there are none, or a limit was met.
[[nodiscard]] std::vector<AgentId> find_crowd(const Instance& instance, LimitMonitor& limits);

}  // namespace quadrille::continuous
