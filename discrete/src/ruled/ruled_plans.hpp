// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/blocked_times.hpp"
#include "paths/agent_distances.hpp"
#include "paths/obstacle_map.hpp"
#include "paths/safe_interval_search.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// Plans of instances with rules, and cheaper ones: agents get a cheapest path each, one after the
/// other, around the paths of all who have one and the starts of all who have none (safe interval
/// path planning, Phillips and Likhachev 2011, ICRA; prioritised: Erdmann and Lozano-Pérez 1987).
/// Who finds none comes first in the next attempt. Then some agents that are late and those in
/// their way give up their paths, and get others in another order (large neighbourhoods, Li et al.
/// 2021, IJCAI). Incomplete: says nothing of whether there is a plan. Deterministic: counts steps.
class RuledPlans {
 public:
  /// Searches throw LimitReached when `limits` are met. All arguments outlive this.
  RuledPlans(const Instance& instance, const GoalDistances& distances, Objective objective,
             std::uint32_t seed, LimitMonitor& limits);

  /// Looks for a plan for so many steps, or for as long as one attempt lasts. True when there is
  /// one.
  bool find(std::int64_t steps);
  /// Goes on from a valid plan.
  void restart_from(const Plan& plan);
  /// Makes it cheaper, for so many steps or some more. True if it is. Requires a plan.
  bool improve(std::int64_t steps);

  /// Attempts to find a plan so far.
  [[nodiscard]] std::int64_t num_attempts() const noexcept { return num_attempts_; }
  [[nodiscard]] bool has_plan() const noexcept { return cost_.has_value(); }
  /// Require one.
  [[nodiscard]] Plan plan() const;
  [[nodiscard]] Cost cost() const { return cost_->cost; }
  /// States that were expanded and obstacles that were loaded, of all so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return search_.effort() + loaded_ / 4; }

 private:
  /// By the objective, and the sum of costs.
  struct Price {
    Cost cost, sum;
    friend auto operator<=>(const Price&, const Price&) = default;
  };
  [[nodiscard]] Price price() const;
  /// False if the agent has no path around all others.
  bool give_path(AgentId agent);
  /// The same for some who have none, one after the other.
  bool give_paths(const std::vector<AgentId>& agents);
  /// Around what is loaded for it.
  bool find_path(AgentId agent);
  /// From now on the other's path is active, or what is known of it.
  void avoid(AgentId other);
  [[nodiscard]] std::vector<AgentId> choose_neighbourhood();

  const Instance& instance_;
  const Objective objective_;
  const BlockedTimes blocked_;
  IdVector<AgentId, AgentDistances> distances_;
  Random random_;
  SafeIntervalSearch search_;
  ObstacleMap map_;
  ObstacleTable table_;
  std::vector<ObstacleId> active_;
  std::vector<AgentId> order_;     // of the next attempt
  IdVector<AgentId, Path> paths_;  // empty: none
  std::optional<Price> cost_;      // of the paths, if all have one
  std::int64_t loaded_ = 0, num_attempts_ = 0;
};

}  // namespace quadrille::discrete
