// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/contacts.hpp"
#include "paths/path_finder.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::continuous {

/// What every part of a solve looks at: the instance, how far the goals are, what is in whose way,
/// and the limits. Nothing here knows of literals.
class Scene {
 public:
  /// Computes the distances to all goals; both arguments outlive the scene. If `limits` end that
  /// early, the scene is not complete and of no use.
  Scene(const Instance& instance, LimitMonitor& limits);
  [[nodiscard]] bool is_complete() const { return distances_.size() == instance_.num_agents(); }

  [[nodiscard]] const Instance& instance() const noexcept { return instance_; }
  [[nodiscard]] LimitMonitor& limits() noexcept { return limits_; }
  [[nodiscard]] Contacts& contacts() noexcept { return contacts_; }
  [[nodiscard]] PathTask task(AgentId i) { return {i, distances_[i.index()], detours_[i.index()]}; }
  /// Cost of the cheapest path of an agent that is alone.
  [[nodiscard]] Cost free_cost(AgentId i) const {
    return as_cost(distances_[i.index()][instance_.agent(i).start]);
  }

 private:
  const Instance& instance_;
  LimitMonitor& limits_;
  std::vector<GoalDistances> distances_;
  std::vector<Detours> detours_;
  Contacts contacts_;
};

}  // namespace quadrille::continuous
