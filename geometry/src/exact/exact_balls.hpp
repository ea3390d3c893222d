// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "planar.hpp"

// The predicates about two balls in exact integer arithmetic, asked when floating point is in
// doubt. Balls meet when their centres are less than `reach` apart.
namespace quadrille::geometry::exact {

/// Whether the balls meet within `window`.
bool balls_meet(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach);

/// Whether the smallest distance of the centres within `window` is exactly `reach`.
bool balls_touch(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach);

/// Some offset at which the balls meet; none if there is no such integer.
std::optional<Ticks> find_balls_meeting(const Motion& a, const Motion& b, Length reach);

/// Whether some point of the parallelogram, given by its corners in order, is less than `reach`
/// away from the origin.
bool ball_reaches(const Parallelogram& places, Length reach);

}  // namespace quadrille::geometry::exact
