// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "paths/agent_distances.hpp"
#include "paths/obstacle_map.hpp"
#include "paths/safe_interval_search.hpp"

namespace quadrille::discrete {

/// What agents cost that obey all rules and have nobody in their way.
class LoneAgents {
 public:
  /// Searches throw LimitReached when `limits` are met; null: there are none.
  LoneAgents(std::size_t num_vertices, LimitMonitor* limits)
      : map_(num_vertices), search_(num_vertices, limits) {}

  /// Absent: it has no path, or none that keeps its deadline. O(V + E) and more where there are
  /// blockages.
  [[nodiscard]] std::optional<Timestep> find_cost(const AgentDistances& distances);

 private:
  ObstacleTable none_;
  ObstacleMap map_;
  SafeIntervalSearch search_;
  Path path_;
};

/// Of all agents of an instance.
struct LoneCosts {
  IdVector<AgentId, Timestep> costs;  ///< Up to the first agent without one.
  std::optional<AgentId> stuck;       ///< That agent.
};
/// Where there are no rules, the distances. `distances`: of the instance. Throws LimitReached.
[[nodiscard]] LoneCosts lone_costs(const Instance& instance, const GoalDistances& distances,
                                   LimitMonitor& limits);

}  // namespace quadrille::discrete
