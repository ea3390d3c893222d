// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/continuous/plan.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// About half a second.
inline constexpr std::int64_t kUsualFeasibilityWork = 50'000'000;

/// Whether there is a plan at all, whatever it costs.
struct Feasibility {
  /// Proved: these agents cannot all reach their goals, even if there are no others. Empty: none
  /// such were found.
  std::vector<AgentId> blocked;
  /// Some plan of all agents, if one was found. It may cost a lot.
  std::optional<Plan> plan;
};

/// Looks for agents that block each other: every two, then every three of four, then all, if they
/// are few enough for a joint search; nothing if that says nothing (JointScope::none). Exact both
/// ways: if neither blocked agents nor a plan are found, the work was too much, the agents too
/// many, the rules more than a joint search knows, or the limits of the scene were met. `work`, as
/// in find_joint_plan, bounds the effort for the parts of each size.
[[nodiscard]] Feasibility check_feasibility(Scene& scene,
                                            std::int64_t work = kUsualFeasibilityWork);

/// The same of some agents, at most kMaxJointAgents, as if there were no others, by all rules.
struct GroupFeasibility {
  std::vector<AgentId> blocked;
  std::optional<std::vector<Path>> paths;  ///< By position among the agents.
};
[[nodiscard]] GroupFeasibility check_group(Scene& scene, const std::vector<AgentId>& agents,
                                           std::int64_t work);

}  // namespace quadrille::continuous
