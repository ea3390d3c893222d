// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "joint/joint_groups.hpp"
#include "quadrille/continuous/plan.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// The groups of agents that have nothing to do with each other, if the joint search of each comes
/// first: a matter of sizes alone. Else empty. On such instances it mostly needs a few
/// milliseconds, however congested they are; what it needs grows exponentially with the agents of a
/// group, and with the room that they have.
[[nodiscard]] std::vector<JointGroup> small_groups(Scene& scene);

struct SmallReport {
  std::vector<AgentId> blocked;  ///< Not empty: there is no plan, because of these.
  Cost lower_bound = 0;          ///< No plan costs less.
  std::optional<Plan> plan;      ///< A valid one, optimal if it costs `lower_bound`.
};

/// Group by group, first whether there is a plan, then a cheapest one, both by joint search. `work`
/// bounds all of the latter, as in find_joint_plan.
[[nodiscard]] SmallReport search_small_groups(Scene& scene, const std::vector<JointGroup>& groups,
                                              Objective objective, std::int64_t work);

}  // namespace quadrille::continuous
