// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// What each agent costs at least in a plan, by agent: as much as it costs alone, and not less than
/// until all others who cannot go around its goal have passed there; with nobody else in their way.
/// One search per agent, and one per two agents near the goal of the other; soundness 11.18.
[[nodiscard]] std::vector<Cost> cost_floors(Scene& scene);

}  // namespace quadrille::continuous
