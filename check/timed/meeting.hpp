// SPDX-License-Identifier: MIT
#pragma once

#include "timed/road.hpp"

namespace quadrille_check {

/// A disc or sphere that goes straight and at constant speed from one point to another, or stands.
struct Motion {
  Road::Point from{}, to{};
  Int begin = 0, end = 0;
  Int radius = 0;
};

/// Whether the interiors meet at a moment at which both motions last, ends included. Exact for
/// coordinates and radii up to 2^40 in size, times up to 2^61, moves that last up to 2^40.
[[nodiscard]] bool do_meet(const Motion& a, const Motion& b);

}  // namespace quadrille_check
