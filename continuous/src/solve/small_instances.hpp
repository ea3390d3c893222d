// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "paths/scene.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// Whether the joint search comes first: a matter of sizes alone, where it knows all rules. On such
/// instances it mostly needs a few milliseconds, however congested they are; what it needs grows
/// exponentially with the agents, and with the room that they have.
[[nodiscard]] bool is_small(const Instance& instance);

struct SmallReport {
  std::vector<AgentId> blocked;  ///< Not empty: there is no plan, because of these.
  Cost lower_bound = 0;          ///< No plan costs less.
  std::optional<Plan> plan;      ///< A valid one, optimal if it costs `lower_bound`.
};

/// First whether there is a plan, then a cheapest one, both by joint search. `work` bounds the
/// latter, as in find_joint_plan.
[[nodiscard]] SmallReport search_small_instance(Scene& scene, Objective objective,
                                                std::int64_t work);

}  // namespace quadrille::continuous
