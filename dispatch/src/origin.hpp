// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "snapshot.hpp"

namespace quadrille::dispatch {

/// Courses that begin where robots are, however late these are.
struct NewOrigin {
  std::vector<Course> courses;
  std::vector<Ticks> clocks;
};

/// At the time `now` each robot is to be where it has been allowed to go; then it stands there,
/// also within a lane, until the earliest of these clocks has come to its own, and goes on as
/// before. That is a plan: its states are those of the old one, in which clocks are max(own,
/// earliest), and slacks are not negative (docs/dispatch.md). A robot that has not come as far as
/// it was allowed counts its clock so that it does by `now`. Requires clocks that are no later than
/// limits, and a `now` that is no earlier.
[[nodiscard]] NewOrigin move_origin(std::span<const Course> courses, std::span<const Ticks> clocks,
                                    std::span<const Ticks> limits, Ticks now);

}  // namespace quadrille::dispatch
