// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/shape/capsule.h>

#include <memory>
#include <optional>
#include <span>

#include "space.hpp"

// What bodies sweep as FCL has it, seen from some origin.
namespace quadrille::geometry {

/// The line of a motion: a capsule without a radius.
struct SweptLine {
  /// `scale`: of lengths.
  SweptLine(const Motion& motion, const Point& origin, double scale = 1);

  [[nodiscard]] double extent() const {
    return std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
  }

  fcl::Vector3d from, to;
  fcl::Capsuled capsule{0, 0};
  fcl::Transform3d frame = fcl::Transform3d::Identity();
};

/// The nearest points of two lines, as FCL has them.
struct LineDistance {
  double distance;
  Vec3 between;  ///< From a's point to b's; zero or without meaning where they are in touch.
};
[[nodiscard]] LineDistance distance(const SweptLine& a, const SweptLine& b);

/// How much too large FCL's distance of two lines can be, or too small.
[[nodiscard]] double distance_error(const SweptLine& a, const SweptLine& b);

/// What a convex polygon sweeps in the plane on a straight way without turning: the convex hull of
/// its first and its last place, seen from the way's begin. For one thread.
class SweptHull {
 public:
  /// `corners`: counter-clockwise, relative to the position; both arguments outlive this. A motion
  /// that gets nearer than `reach` counts.
  SweptHull(const Motion& motion, std::span<const Point> corners, Length reach);
  ~SweptHull();
  SweptHull(const SweptHull&) = delete;
  SweptHull& operator=(const SweptHull&) = delete;

  /// How far beyond the reach the straight lines normal to a direction keep `line` away from the
  /// hull: at most as far as it is, by rounding too. Not positive if they do not, or if the
  /// direction is zero. Linear in the number of corners.
  [[nodiscard]] double clearance(const Motion& line, Vec direction) const;
  /// The direction between the points that FCL finds nearest, and zero if it finds none.
  [[nodiscard]] Vec direction(const Motion& line);

  /// Where less than this is missing, FCL's tolerance is too large for it to find more.
  [[nodiscard]] double tolerance() const;

 private:
  struct Shape;

  const Motion& motion_;
  const std::span<const Point> corners_;
  Length reach_, size_;
  std::unique_ptr<const Shape> shape_;  // made when it is needed
};

}  // namespace quadrille::geometry
