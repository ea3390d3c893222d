// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/core/export.hpp"
#include "quadrille/core/quantity.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// Time, in whole ticks. A time *difference* may be negative.
using Ticks = Quantity<struct TicksUnit>;
/// Length, in whole length units.
using Length = Quantity<struct LengthUnit>;

/// What the exact arithmetic is laid out for: coordinates of a point lie in [-kMaxLength,
/// kMaxLength], and so do radii and the coordinates of a polygon's corners. With a unit of 10^-6
/// that is a million.
inline constexpr Length kMaxLength{std::int64_t{1} << 40};
/// The longest motion, rests included.
inline constexpr Ticks kMaxDuration{std::int64_t{1} << 40};

/// A point or a vector of space, in length units. All that lies in the plane has z = 0.
struct Point {
  Length x = 0;
  Length y = 0;
  Length z = 0;  ///< Height.

  friend constexpr bool operator==(const Point&, const Point&) = default;
};

/// Whether all coordinates are within kMaxLength.
[[nodiscard]] constexpr bool in_range(const Point& point) noexcept {
  return -kMaxLength <= point.x && point.x <= kMaxLength && -kMaxLength <= point.y &&
         point.y <= kMaxLength && -kMaxLength <= point.z && point.z <= kMaxLength;
}

}  // namespace quadrille::geometry

QUADRILLE_API_END
