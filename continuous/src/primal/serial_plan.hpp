// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/plan.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// A plan that comes of moves made one after the other, each while all others stand: found by
/// settling the agents on the roads on which nobody who stands is in the way. The order of moves
/// that are in each other's way is kept, and each begins as early as that allows. nullopt says
/// nothing about the instance. Stops early when the limits of the scene are met.
[[nodiscard]] std::optional<Plan> settle_agents(Scene& scene);

/// Likewise, found by a search among all arrangements of the agents, with an effort that bounds it.
[[nodiscard]] std::optional<Plan> search_serial_plan(Scene& scene, std::int64_t effort);

}  // namespace quadrille::continuous
