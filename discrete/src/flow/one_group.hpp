// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// What is known of the least makespan of agents of which each may end at any of the same goals.
struct GroupMakespan {
  Timestep lower = 0;  ///< No plan takes less time.
  std::optional<std::vector<Path>>
      paths;  ///< Those that take no longer, in the order of the agents.
};

/// Decides for one number of timesteps after the other, from the largest distance to a goal on,
/// whether as many units as there are agents flow from their starts to the goals in the
/// time-expanded graph, with one unit in a vertex at a time (Yu and LaValle, "Multi-agent path
/// planning and network flow", WAFR 2013). Who is who does not matter, so two units that change
/// places can stay where they are instead. Units that flow in t timesteps do so in t + 1, and stay
/// a timestep longer. Ends without paths at a limit, or after `most_steps` edges that were looked
/// at. Requires a plain instance in which these agents have the same goals, and a plan.
/// O((agents + makespan) E makespan).
[[nodiscard]] GroupMakespan least_makespan(const Instance& instance,
                                           const std::vector<AgentId>& agents,
                                           std::int64_t most_steps, LimitMonitor& limits);

/// The agents of each set of goals that several have.
[[nodiscard]] std::vector<std::vector<AgentId>> groups_that_share(const Instance& instance);

}  // namespace quadrille::discrete
