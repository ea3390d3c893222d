// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/continuous/roadmap.hpp"

// Products of lengths, in square length units: exact, because coordinates and radii have 41 bits.
namespace quadrille::continuous {

__extension__ using Area = __int128;

[[nodiscard]] constexpr Area square(Length length) {
  return static_cast<Area>(length.value()) * length.value();
}

/// (a - c) . (b - c), which is at most 0 if c is in the disc (ball) over the diameter from a to b.
[[nodiscard]] constexpr Area dot(const Point& a, const Point& b, const Point& c) {
  return static_cast<Area>((a.x - c.x).value()) * (b.x - c.x).value() +
         static_cast<Area>((a.y - c.y).value()) * (b.y - c.y).value() +
         static_cast<Area>((a.z - c.z).value()) * (b.z - c.z).value();
}

[[nodiscard]] constexpr Area squared_distance(const Point& a, const Point& b) {
  return dot(a, a, b);
}

}  // namespace quadrille::continuous
