// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/geometry/body.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// Where a body faces: along a vector with whole coordinates, and no angle, so that corners come
/// out alike on every platform. A body as it is given faces along x.
struct Direction {
  /// Of a coordinate: lengths of vectors are roots of numbers that are exact in 64 bits.
  static constexpr std::int64_t kMost = std::int64_t{1} << 20;

  std::int64_t x = 1;  ///< Not both 0, in [-kMost, kMost].
  std::int64_t y = 0;

  /// The one nearest to an angle in radians, 0 along x, a quarter turn along y; multiples of an
  /// eighth of a turn are exact. Requires a finite angle.
  [[nodiscard]] static Direction at(double angle);
  friend bool operator==(const Direction&, const Direction&) = default;
};

/// A body that contains the given one turned about the agent's position until it faces there. A
/// disc is itself. Each corner is rounded to the lattice points around where it is, so that the
/// polygon is less than 1.5 length units larger, and exact for multiples of a quarter turn; beyond
/// ConvexPolygon::kMaxVertices corners, edges give way to the meeting points of their neighbours.
/// Errors: out_of_range if a corner comes to lie beyond kMaxLength. Requires a valid direction.
/// n log n in the number of corners.
[[nodiscard]] Result<Body> turned(const Body& body, const Direction& facing);

/// A convex body that contains the given one while it turns from one direction to another by the
/// shorter way, and so `turned` at both; half a turn goes counter-clockwise. A disc is itself. The
/// arc of each corner is inside of a chain of tangents; for bodies of few corners that are not tiny
/// the area is less than two hundredths above that of the hull of what the body sweeps. Errors and
/// requirements as of `turned`.
[[nodiscard]] Result<Body> swept_by_turn(const Body& body, const Direction& from,
                                         const Direction& to);

/// Whether each point of `inner` is one of `outer`, both around the same position. Exact. Discs are
/// those of the plane. Time: the product of the numbers of corners.
[[nodiscard]] bool contains(const Body& outer, const Body& inner);

}  // namespace quadrille::geometry

QUADRILLE_API_END
