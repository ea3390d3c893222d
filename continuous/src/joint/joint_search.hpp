// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "joint/joint_space.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// What a timeless joint search of an instance is worth, see JointRules.
enum class JointScope {
  exact,    ///< It knows all rules.
  relaxed,  ///< Without the others: what it cannot do cannot be done, but its plans may break them.
  none,     ///< Some agents leave at their goals: what it finds says nothing.
};
[[nodiscard]] JointScope joint_scope(const Instance& instance);

/// What a joint search found out.
struct JointReport {
  enum class End {
    found,      ///< `paths` are a plan; of least cost, if that was looked for.
    exhausted,  ///< There is no plan; none below `below`, if that was given.
    stopped,    ///< By the work or the limits.
  };
  End end = End::stopped;
  std::vector<Path> paths;  ///< By position among the agents.
  Cost lower_bound = 0;     ///< No plan costs less, whatever `end` is. Of cheapest plans only.
};

/// Whether some agents, at most kMaxJointAgents, can reach their goals if there are no others; a
/// plan if they can, which may cost a lot. Exact: moments are not sampled but kept in zones, so
/// that neither the resolution nor the durations matter. Of all rules it makes a table that is as
/// large as the roadmap, for each agent. `work` counts down, whatever the clock says, by some 10^8
/// in a second; the search ends when it is below 0.
[[nodiscard]] JointReport find_joint_plan(Scene& scene, const std::vector<AgentId>& agents,
                                          JointRules rules, std::int64_t& work);

/// A plan of least cost for the agents if there are no others, by all rules. `below`: only plans
/// that cost less are looked for.
[[nodiscard]] JointReport find_cheapest_joint_plan(Scene& scene, const std::vector<AgentId>& agents,
                                                   Objective objective, std::optional<Cost> below,
                                                   std::int64_t& work);

}  // namespace quadrille::continuous
