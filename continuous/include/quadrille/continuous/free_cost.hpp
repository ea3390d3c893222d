// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// What the agent's task costs if nobody else is there, and no obstacle: the time from `now` to its
/// release and the least duration of a path to its goal, 0 for an agent that begins there. nullopt
/// if the goal cannot be reached. O(edges log vertices).
[[nodiscard]] std::optional<Ticks> free_cost(const Instance& instance, AgentId agent);

}  // namespace quadrille::continuous

QUADRILLE_API_END
