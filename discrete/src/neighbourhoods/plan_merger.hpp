// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "reservations/reservations.hpp"

namespace quadrille::discrete {

/// Takes the better parts of two plans.
///
/// Agents whose path is the same in both need no choice. Of the others, i and j belong together if
/// i's path in one plan collides with j's in the other. What belongs together, directly or not,
/// takes its paths from one plan; so two paths that could collide are always of the same plan,
/// which is valid, and each part is free to take the plan in which it is cheaper.
class PlanMerger {
 public:
  /// `instance` outlives the object.
  explicit PlanMerger(const Instance& instance)
      : instance_(instance),
        reservations_(instance.graph().num_vertices()),
        parent_(instance.num_agents()) {}

  /// A plan that is no dearer than either. Requires trimmed, valid plans of the instance. Of parts
  /// that are as dear in both `plan` has its paths. O(the paths that differ, and their meetings).
  [[nodiscard]] Plan merge(Plan plan, const Plan& other, Objective objective);

 private:
  [[nodiscard]] AgentId root(AgentId agent);
  void join_with_met(AgentId agent, const Path& path);

  const Instance& instance_;
  Reservations reservations_;  // empty between uses
  IdVector<AgentId, AgentId> parent_;
};

}  // namespace quadrille::discrete
