// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/plan.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// Looks for some plan, fast: one agent after the other takes a cheapest path around those before
/// it, in several orders. The first plan found; nullopt says nothing about the instance. Stops
/// early when the limits of the scene are met.
[[nodiscard]] std::optional<Plan> find_first_plan(Scene& scene);

/// Likewise, from paths of some agents that do not collide; empty for the others. Who has one gives
/// it up only if the others find none otherwise.
[[nodiscard]] std::optional<Plan> complete_plan(Scene& scene,
                                                const IdVector<AgentId, Path>& wanted);

}  // namespace quadrille::continuous
