// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous {

/// What an obstacle does at some moment: it is at a stop, or on its way from there to the next one.
struct ObstacleLeg {
  std::size_t stop = 0;
  bool is_moving = false;
};

/// nullopt if it is nowhere then: not yet, or no more. At a stop as soon as it arrives and as long
/// as it has not departed. Requires a path. O(stops).
[[nodiscard]] std::optional<ObstacleLeg> leg_at(const MovingObstacle& obstacle, Ticks tick);

/// Whether the interiors of the obstacle and of a body at a place meet at that moment.
[[nodiscard]] bool is_in_the_way(const MovingObstacle& obstacle, Ticks tick, const Body& body,
                                 const geometry::Place& place);

}  // namespace quadrille::continuous
