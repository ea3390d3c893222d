// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "contacts/contacts.hpp"
#include "paths/path_finder.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/settings.hpp"
#include "traffic/scene_store.hpp"

namespace quadrille::continuous {

/// What plans pay, besides what agents cost, in which nobody ends at the goal.
struct Fee {
  VertexId goal;
  Cost amount = 0;  ///< At least 1.
};
/// Whether somebody does.
[[nodiscard]] bool ends_at(const Plan& plan, VertexId goal);

/// What every part of a solve looks at: the instance, how far the goals are, what is in whose way,
/// and the limits. Nothing here knows of literals.
class Scene {
 public:
  /// Computes the distances to all goals and the bans around moving obstacles, the latter with as
  /// many contacts as there are edges and vertices for each of their steps, per class. If `limits`
  /// end that early, the scene is not complete and of no use. `store`, unless null, has adopted the
  /// instance: distances and contacts come from there, and stay there. All three outlive the scene.
  Scene(const Instance& instance, LimitMonitor& limits, SceneStore* store = nullptr,
        const Settings& settings = {});
  [[nodiscard]] bool is_complete() const { return is_complete_; }

  [[nodiscard]] const Instance& instance() const noexcept { return instance_; }
  [[nodiscard]] LimitMonitor& limits() noexcept { return limits_; }
  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  [[nodiscard]] Contacts& contacts() noexcept { return contacts_; }
  /// Of sums of costs; none at first.
  void set_fees(std::vector<Fee> fees) { fees_ = std::move(fees); }
  [[nodiscard]] const std::vector<Fee>& fees() const noexcept { return fees_; }
  /// Of a plan, with fees.
  [[nodiscard]] Cost cost(const Plan& plan, Objective objective) const;
  [[nodiscard]] PathTask task(AgentId i) { return {i, distances_[i.index()], detours_[i.index()]}; }
  /// What keeps agents of the class clear of the moving obstacles, and those that are under way
  /// from stopping, sorted.
  [[nodiscard]] const std::vector<Ban>& standing_bans(ClassId c) const {
    return standing_[c.index()];
  }
  [[nodiscard]] const std::vector<Ban>& standing_bans(AgentId i) const {
    return standing_bans(instance_.class_of(i));
  }
  /// Cost of the cheapest path of an agent that is alone with the moving obstacles; kAnyCost if
  /// these leave it none.
  [[nodiscard]] Cost free_cost(AgentId i) const {
    if (!free_costs_.empty()) return free_costs_[i.index()];
    const Agent& agent = instance_.agent(i);
    if (agent.goals.contains(agent.start)) return 0;
    return as_cost(agent.release + distances_[i.index()][agent.start]);
  }

 private:
  void keep_moving();
  /// False: the limits ended it.
  bool avoid_obstacles();

  const Instance& instance_;
  LimitMonitor& limits_;
  const Settings settings_;
  bool is_complete_ = false;
  std::vector<GoalDistances> distances_;
  std::vector<Detours> detours_;
  std::vector<std::vector<Ban>> standing_;  // by class
  std::vector<Cost> free_costs_;            // none: distances say it
  std::vector<Fee> fees_;
  Contacts contacts_;
};

}  // namespace quadrille::continuous
