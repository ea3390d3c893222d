// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "quadrille/geometry/body.hpp"
#include "quadrille/geometry/motion.hpp"
#include "support/random.hpp"

namespace quadrille::geometry {

/// Two bodies and a motion of each.
struct Case {
  Body body_a;
  Motion a;
  Body body_b;
  Motion b;
};

/// As C++, to be pasted into a test.
std::ostream& operator<<(std::ostream& out, const Case& c);

/// Uniform in first .. last, which may be negative.
Length draw(support::Random& random, Length first, Length last);
Ticks draw_ticks(support::Random& random, Ticks first, Ticks last);

/// Durations and coordinates up to about forty, so that every offset can be tried.
Case small_discs(support::Random& random);
Case small_bodies(support::Random& random);

/// One of the hard families, at some scale up to the largest numbers allowed: tangent and one unit
/// to either side of it, equal velocities, slow relative motion, collinear followers, tiny
/// durations, an overlap at the start, rests, and motions with nothing special, with different
/// radii and speeds.
Case hard_discs(support::Random& random);
/// The same for two bodies of which at least one is a polygon.
Case hard_bodies(support::Random& random);

/// Two balls that move in space, at small numbers and at hard ones: cases as above in a plane that
/// is turned, so that what touches still does, one of them lifted off it, and ones with heights of
/// their own.
Case small_balls(support::Random& random);
Case hard_balls(support::Random& random);
/// A case in the plane through the origin that three integer vectors of length 3, normal to each
/// other, turn: all lengths times 3. `which`, of 0 .. 5, says how.
Case turned(const Case& c, std::size_t which);

/// A convex polygon around the origin whose corners are at most about `size` away.
ConvexPolygon random_polygon(support::Random& random, Length size);

/// The integer point nearest to the line through the origin and `step` on its left, beside the
/// first half of it or the second: their cross product is 1. Requires coprime positive coordinates.
Point left_of(const Point& step);

}  // namespace quadrille::geometry
