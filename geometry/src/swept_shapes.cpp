// SPDX-License-Identifier: MIT
#include "swept_shapes.hpp"

#include <fcl/narrowphase/distance.h>

#include <exception>

#include "fcl_shapes.hpp"
#include "grown_shape.hpp"
#include "lattice_hull.hpp"

namespace quadrille::geometry {
namespace {

fcl::Vector3d vector_of(const Point& p) {
  const Vec3 v = to_vec3(p);
  return {v.x, v.y, v.z};
}

Length size_of(std::span<const Point> corners, Length reach) {
  Length size = 0;
  for (const Point& corner : corners) size = std::max(size, extent(corner));
  return size + reach;
}

}  // namespace

SweptLine::SweptLine(const Motion& motion, const Point& origin, double scale)
    : from(scale * vector_of(motion.from - origin)), to(scale * vector_of(motion.to - origin)) {
  const fcl::Vector3d along = to - from;
  capsule.lz = along.norm();
  if (capsule.lz > 0)
    frame.linear() = Eigen::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), along).matrix();
  frame.translation() = (from + to) / 2;
}

LineDistance distance(const SweptLine& a, const SweptLine& b) {
  const fcl::DistanceRequestd request(/*enable_nearest_points=*/true);
  fcl::DistanceResultd result;
  const double apart = fcl::distance(&a.capsule, a.frame, &b.capsule, b.frame, request, result);
  const fcl::Vector3d between = result.nearest_points[1] - result.nearest_points[0];
  return {apart, {between.x(), between.y(), between.z()}};
}

// FCL's closed form gives the distance of two points of the lines, the first at a share s of its
// line from a quotient whose denominator is |a|^2 |b|^2 sin^2 of the angle between them. With u =
// 2^-53 and S the extent, rounding moves s |a| by at most 12 u S / (sin^2 - 4 u), which adds at
// most 300 u S^2 to the square of the distance if sin^2 is at least 8 u; else the lines part by
// less than sqrt(8 u) S along all of their length, and any s will do. The distance is too large by
// at most sqrt(300 u) S < 2^-22 S therefore, and too small by a few u S, which the capsules' ends
// and the arithmetic cost.
double distance_error(const SweptLine& a, const SweptLine& b) {
  return 0x1p-21 * std::max(a.extent(), b.extent());
}

// In a length unit in which the hull is about 1 large: FCL's tolerances are absolute.
struct SweptHull::Shape {
  Shape(const Motion& motion, std::span<const Point> corners) {
    std::vector<Point> ends(corners.begin(), corners.end());
    for (const Point& corner : corners) ends.push_back(corner + (motion.to - motion.from));
    ends = convex_hull(std::move(ends));
    scale = 1 / static_cast<double>(size_of(ends, 0).value());
    prism = make_prism(ends, scale, 1);
  }

  double scale = 1;
  std::shared_ptr<fcl::CollisionGeometryd> prism;
};

SweptHull::SweptHull(const Motion& motion, std::span<const Point> corners, Length reach)
    : motion_(motion), corners_(corners), reach_(reach), size_(size_of(corners, reach)) {}
SweptHull::~SweptHull() = default;

// With n for the direction, the hull reaches as far as its farthest corner, which is one of the
// first place or of the last one; the line from its nearer end on. Each of the four scalar products
// is off by at most 3 u (u = 2^-53) times the coordinate that goes into it, the sums by 6 u times
// all of them, and n's length, by 4 u of 1, moves `reach` by as much of it: less than 16 u of the
// sum together, a quarter of error_bound. All points and their differences are integers below 2^53.
double SweptHull::clearance(const Motion& line, Vec direction) const {
  const double length = norm(direction);
  if (!(length > 0) || !std::isfinite(length)) return -std::numeric_limits<double>::infinity();
  const Vec n = (1 / length) * direction;
  double support = -std::numeric_limits<double>::infinity();
  for (const Point& corner : corners_) support = std::max(support, dot(n, to_vec(corner)));
  const double hull = support + std::max(0.0, dot(n, to_vec(motion_.to - motion_.from)));
  const double beyond =
      dot(n, to_vec(line.from - motion_.from)) + std::min(0.0, dot(n, to_vec(line.to - line.from)));
  return beyond - hull - static_cast<double>(reach_.value()) - error_bound(motion_, line, size_);
}

double SweptHull::tolerance() const {
  const Length size = extent(motion_.to - motion_.from) + size_;
  return 1e-6 * static_cast<double>(size.value());
}

Vec SweptHull::direction(const Motion& line) {
  if (shape_ == nullptr) shape_ = std::make_unique<const Shape>(motion_, corners_);
  // At half the height of the prism, in the plane in which both came.
  SweptLine other(line, motion_.from, shape_->scale);
  const fcl::DistanceRequestd request(/*enable_nearest_points=*/true);
  fcl::DistanceResultd result;
  try {
    // Thrown by FCL when libccd's iteration degenerates. Whatever it is: nothing is proved.
    if (!(fcl::distance(shape_->prism.get(), fcl::Transform3d::Identity(), &other.capsule,
                        other.frame, request, result) > 0))
      return {};
  } catch (const std::exception&) {
    return {};
  }
  const fcl::Vector3d between = result.nearest_points[1] - result.nearest_points[0];
  return {between.x(), between.y()};
}

}  // namespace quadrille::geometry
