// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "model/component.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/pebbles/board.hpp"

namespace quadrille::discrete {

/// The paths of agents whose shifts are made at their earliest times. `starts`, `agents`: by the
/// agents of the shifts; `vertices`: by their vertices. False, and nothing is written, if a limit
/// of memory is met. O(shifts + size of the paths).
[[nodiscard]] bool write_paths(std::span<const pebbles::Shift> shifts,
                               std::span<const Local> starts, std::span<const AgentId> agents,
                               std::span<const VertexId> vertices, Plan& plan,
                               LimitMonitor& limits);

/// The same visits in the same order at each vertex, but for loops, as early as that allows: of no
/// larger sum of costs. nullopt if a limit of memory is met. Requires a valid plan. O(its size).
[[nodiscard]] std::optional<Plan> tightened(const Instance& instance, const Plan& plan,
                                            LimitMonitor& limits);

}  // namespace quadrille::discrete
