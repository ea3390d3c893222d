// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "neighbourhoods/gathering.hpp"
#include "quadrille/core/random.hpp"
#include "reservations/soft_path_planner.hpp"
#include "reservations/soft_reservations.hpp"

namespace quadrille::discrete {

/// Makes plans of paths that collide (Li et al., "MAPF-LNS2: fast repairing for multi-agent path
/// finding via large neighbourhood search", AAAI 2022): takes out agents that meet, gives them new
/// paths one after the other, each with as few meetings as possible, and keeps these unless there
/// are more meetings than before; until there are none.
///
/// What it does depends on the drafts, the seed and the effort asked for, but not on how that is
/// cut into slices.
class PlanRepair {
 public:
  /// `instance` outlives the object.
  PlanRepair(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
             std::uint32_t seed);
  PlanRepair(const PlanRepair&) = delete;
  PlanRepair& operator=(const PlanRepair&) = delete;

  /// Drops what is under way and begins with these paths, one from start to goal for each agent.
  void restart_from(const Plan& draft);
  /// Repairs until no paths meet, `effort` more is spent, or a limit was met. True if no paths
  /// meet. The last neighbourhood may take somewhat more than the effort that is left.
  bool advance(std::int64_t effort, LimitMonitor& limits);
  /// All at once: nullopt if the effort does not suffice, or if a limit was met.
  [[nodiscard]] std::optional<Plan> repair(const Plan& draft, std::int64_t effort,
                                           LimitMonitor& limits);

  /// As far as it has got. Trimmed; a valid plan if and only if there are no meetings.
  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
  [[nodiscard]] std::int64_t num_meetings() const noexcept { return num_meetings_; }
  /// Elementary steps so far.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  void step(LimitMonitor& limits);
  [[nodiscard]] std::int64_t allowed(const Path& old_path) const;
  void choose(std::size_t size);
  void put_back(std::size_t num_new);
  void reserve(AgentId agent);
  void release(AgentId agent);
  void change_meetings(AgentId agent, std::int64_t change);

  const Instance& instance_;
  const std::shared_ptr<const GoalDistances> distances_;
  Random random_;
  SoftReservations reservations_;
  SoftPathPlanner planner_;
  Plan plan_;
  IdVector<AgentId, std::int64_t> meetings_;  // Of each agent.
  std::int64_t num_meetings_ = 0;             // Of all, each counted once.
  std::vector<AgentId> colliding_;            // Those with meetings.
  IdVector<AgentId, std::size_t> place_;      // In `colliding_`.
  Gathering gathering_;
  std::vector<AgentId> chosen_, met_;
  std::vector<Path> old_paths_;    // Of those chosen.
  std::int64_t num_failures_ = 0;  // Neighbourhoods that did not help; forgotten by and by.
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::discrete
