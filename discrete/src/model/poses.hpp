// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "quadrille/core/heading.hpp"
#include "quadrille/discrete/graph.hpp"

namespace quadrille::discrete {

/// The pose, by vertices, of robots that have come to their goal for good.
inline constexpr std::size_t kParked = kHeadings.size();

/// What Instance::poses says. Requires a grid and at least one timestep for a quarter turn. O(turn
/// * (V + E)).
[[nodiscard]] std::shared_ptr<const Graph> make_poses(const Graph& grid, Timestep turn);

}  // namespace quadrille::discrete
