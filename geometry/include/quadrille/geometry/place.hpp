// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// Where a body may stand: at from + (to - from) * behind / whole, exactly, which need not have
/// whole coordinates. A point converts to one.
struct Place {
  Point from;
  Point to;
  Ticks behind = 0;  ///< 0 <= behind <= whole.
  Ticks whole = 1;   ///< 1 <= whole <= kMaxDuration.

  constexpr Place() = default;
  constexpr Place(const Point& point) : from(point), to(point) {}  // NOLINT: a point is a place
  constexpr Place(Length x, Length y, Length z = 0) : Place(Point{x, y, z}) {}
  constexpr Place(const Point& of_from, const Point& of_to, Ticks of_behind, Ticks of_whole)
      : from(of_from), to(of_to), behind(of_behind), whole(of_whole) {}

  friend constexpr bool operator==(const Place&, const Place&) = default;
};

}  // namespace quadrille::geometry

QUADRILLE_API_END
