// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/body.hpp"
#include "quadrille/geometry/motion.hpp"
#include "quadrille/geometry/tick_interval.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// The free space between two bodies in length units, as a certified pair of bounds:
/// at_least <= exact value <= at_most. Both are 0 when the bodies touch or collide, which `collide`
/// tells apart, and only at_most > 0 otherwise; they differ by at most 10^-13 of the largest length
/// involved.
struct Gap {
  double at_least = 0;
  double at_most = 0;
};

/// Every question about two bodies, `a` and `b`, that move or rest.
///
/// Touching is allowed: *collide* means that the interiors meet, for discs that the distance of the
/// centres is less than the sum of the radii. Every answer is exact for the numbers given, for
/// discs and polygons alike, except the bounds of `gap`: floating point only filters, and what it
/// leaves in doubt is decided in exact integer arithmetic.
///
/// Immutable, cheap to copy; all members may be called from several threads at once. They require
/// valid motions and points in range, and for pairs with a polygon that the motions are level: that
/// all their ends have the same height. Two discs are balls: at any heights it is the distance in
/// space that counts. Time is constant for discs and grows with the number of
/// corners for polygons, whose pairs also take longer to construct: keep one per pair of body
/// classes.
class BodyPair {
 public:
  /// Requires radii in [1, kMaxLength].
  BodyPair(const Body& a, const Body& b);

  /// The offsets d = t_b - t_a at which the bodies collide at some moment while both motions run:
  /// a's during [t_a, t_a + a.duration], b's during [t_b, t_b + b.duration], ends included. They
  /// form one run of integers; none if there is no such integer. With the arguments and the bodies
  /// swapped the result is mirrored.
  [[nodiscard]] std::optional<TickInterval> unsafe_offsets(const Motion& a, const Motion& b) const;

  /// Whether `offset` is in unsafe_offsets(a, b). Any offset is allowed.
  [[nodiscard]] bool collide(const Motion& a, const Motion& b, Ticks offset) const;

  /// When b's body, standing at `place`, is in the way of a's motion, as a stretch in ticks since
  /// the motion began; none if never. A body that stands there during [arrive, leave] collides with
  /// the moving one if and only if the stretch meets that. With the real times of contact forming
  /// the open interval (x, y): begin = floor(x), end = ceil(y). An overlap at the very start of the
  /// motion gives begin = -1, one at its very end end = duration + 1, because there the end of the
  /// motion itself belongs to the contact. Not empty.
  [[nodiscard]] std::optional<TickInterval> contact_window(const Motion& a,
                                                           const Place& place) const;

  /// Whether the interiors meet when a is at `place_a` and b at `place_b`.
  [[nodiscard]] bool overlap(const Place& place_a, const Place& place_b) const;

  /// The smallest gap over all moments at which both motions run, b starting `offset` ticks after
  /// a; none if there is no such moment.
  [[nodiscard]] std::optional<Gap> gap(const Motion& a, const Motion& b, Ticks offset) const;

  /// Whether the motions collide at some offset, real ones included: whether the areas that the two
  /// bodies sweep have a common interior point. Of a part of a motion (Motion::is_part) it may be
  /// said where only the whole motion collides.
  [[nodiscard]] bool can_meet(const Motion& a, const Motion& b) const;

  /// The same pair, b first.
  [[nodiscard]] BodyPair swapped() const;

 private:
  friend class SweptVolumes;
  class Shape;  // Null for two discs.

  // Whether it takes more than the plane to see the two motions. Requires that there are two discs
  // then.
  [[nodiscard]] bool is_in_space(const Motion& a, const Motion& b) const;
  // Without checking the motions.
  [[nodiscard]] bool collide_unchecked(const Motion& a, const Motion& b, Ticks offset) const;
  // What b's position relative to a's must keep `reach_` away from: a convex polygon or a point.
  [[nodiscard]] std::span<const Point> corners() const;
  [[nodiscard]] Length size() const;

  Length reach_ = 0;  // The sum of the radii; 0 for two polygons.
  std::shared_ptr<const Shape> shape_;
};

/// BodyPair(body_a, body_b).unsafe_offsets(a, b).
[[nodiscard]] inline std::optional<TickInterval> unsafe_offsets(const Body& body_a, const Motion& a,
                                                                const Body& body_b,
                                                                const Motion& b) {
  return BodyPair(body_a, body_b).unsafe_offsets(a, b);
}

/// BodyPair(body_a, body_b).overlap(place_a, place_b).
[[nodiscard]] inline bool bodies_overlap(const Body& body_a, const Place& place_a,
                                         const Body& body_b, const Place& place_b) {
  return BodyPair(body_a, body_b).overlap(place_a, place_b);
}

}  // namespace quadrille::geometry

QUADRILLE_API_END
