// SPDX-License-Identifier: MIT
#include "pair_shape.hpp"

#include "grown_shape.hpp"

namespace quadrille::geometry {
namespace {

Length size_of(const std::vector<Point>& corners, Length reach) {
  Length size = 0;
  for (const Point& corner : corners) size = std::max(size, extent(corner));
  return size + reach;
}

}  // namespace

BodyPair::Shape::Shape(const Body& a, const Body& b, Length reach)
    : a_(a),
      b_(b),
      reach_(reach),
      corners_(grown_corners(a, b)),
      size_(size_of(corners_, reach)),
      advancement_(a, b, corners_, reach) {
  for (const Point& corner : corners_) vecs_.push_back(to_vec(corner));
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec side = to_vec(corners_[(i + 1) % corners_.size()] - corners_[i]);
    normals_.push_back((1 / norm(side)) * Vec{side.y, -side.x});
    inner_ = std::min(inner_, dot(normals_[i], vecs_[i]));
    outer_ = std::max(outer_, norm(vecs_[i]));
  }
  // Each is off by less than 8 u of the coordinates (u = 2^-53).
  const double error = std::ldexp(static_cast<double>(size_.value()), -48);
  inner_ -= error;
  outer_ += error;
}

double BodyPair::Shape::outside(const RelativePath& path) const {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vecs_.size(); ++i)
    most = std::max(most, std::min(dot(normals_[i], path.begin - vecs_[i]),
                                   dot(normals_[i], path.end - vecs_[i])));
  return most;
}

bool BodyPair::Shape::meets(const RelativePath& path) const {
  return depth(path) > path.error ||
         (reach_ > 0 && distance(path) < static_cast<double>(reach_.value()) - path.error);
}

bool BodyPair::Shape::contains(Vec position, double error) const {
  // Rounding is less than 32 u of the polygon's coordinates, as in the constructor.
  return meets({position, position, error + std::ldexp(static_cast<double>(size_.value()), -48)});
}

bool BodyPair::Shape::meet_at_ends(const Motion& a, const Motion& b) const {
  const Parallelogram places = relative_places(a, b);
  const double error = error_bound(a, b, size_);
  for (std::size_t i = 0; i < 4; ++i)
    if (meets({to_vec(places.corners[i]), to_vec(places.corners[(i + 1) % 4]), error})) return true;
  return false;
}

bool BodyPair::Shape::keeps_apart(Vec direction, const RelativePath& path) const {
  const double length = norm(direction);
  if (!(length > path.error)) return false;
  const Vec n = (1 / length) * direction;
  double support = -std::numeric_limits<double>::infinity();
  for (const Vec corner : vecs_) support = std::max(support, dot(n, corner - path.begin));
  return std::min(0.0, dot(n, path.end - path.begin)) - support >=
         static_cast<double>(reach_.value()) + path.error;
}

// The nearest points of a convex polygon and a way that does not meet it: an end of the way and a
// point of a side, see outside(), or a corner and a point of the way.
bool BodyPair::Shape::is_apart(const RelativePath& path) const {
  if (outside(path) >= static_cast<double>(reach_.value()) + path.error) return true;
  const Vec along = path.end - path.begin;
  const double square = dot(along, along);
  double least = std::numeric_limits<double>::infinity();
  Vec between;
  for (const Vec corner : vecs_) {
    const Vec to_corner = corner - path.begin;
    const double share = square > 0 ? std::clamp(dot(to_corner, along) / square, 0.0, 1.0) : 0;
    const Vec from_corner = share * along - to_corner;
    const double apart = dot(from_corner, from_corner);
    if (apart < least) least = apart, between = from_corner;
  }
  if (reach_ > 0) return keeps_apart(between, path);
  // Where a corner touches the way, `between` is all rounding.
  return keeps_apart({-along.y, along.x}, path) || keeps_apart({along.y, -along.x}, path);
}

double BodyPair::Shape::depth(const RelativePath& path) const {
  // The part of the path on the inner side of every side, then the depth in the middle of it. The
  // middle need not be the deepest point, so this is a lower bound.
  double from = 0;
  double to = 1;
  for (std::size_t i = 0; i < vecs_.size(); ++i) {
    const double begin = dot(normals_[i], path.begin - vecs_[i]);
    const double end = dot(normals_[i], path.end - vecs_[i]);
    if (begin > 0 && end > 0) return -1;
    if (begin > 0) from = std::max(from, begin / (begin - end));
    if (end > 0) to = std::min(to, begin / (begin - end));
  }
  if (from > to) return -1;
  const Vec middle = path.begin + ((from + to) / 2) * (path.end - path.begin);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vecs_.size(); ++i)
    least = std::min(least, -dot(normals_[i], middle - vecs_[i]));
  return least;
}

double BodyPair::Shape::distance(const RelativePath& path) const {
  if (depth(path) >= 0) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vecs_.size(); ++i) {
    const Vec next = vecs_[(i + 1) % vecs_.size()];
    least = std::min({least, geometry::distance(vecs_[i], path.begin, path.end),
                      geometry::distance(path.begin, vecs_[i], next),
                      geometry::distance(path.end, vecs_[i], next)});
  }
  return least;
}

// Where the path stays away, doubles find a direction that proves it nearly always; FCL is asked
// for another one before exact arithmetic is.
int BodyPair::Shape::filter(const RelativePath& path) const {
  if (meets(path)) return 1;
  return is_apart(path) || advancement_.proves_apart(path) ? -1 : 0;
}

// The grown polygon is the union of the polygon, a disc around each corner, and a rectangle on each
// side; the offsets of each part are easy.
RealInterval BodyPair::Shape::likely_offsets(const Motion& a, const Motion& b) const {
  RealInterval offsets;
  include_polygon(a, b, vecs_, offsets);
  if (reach_ == 0) return offsets;
  const double reach = static_cast<double>(reach_.value());
  for (std::size_t i = 0; i < vecs_.size(); ++i) {
    const Vec next = vecs_[(i + 1) % vecs_.size()];
    const Vec out = reach * normals_[i];
    include_disc(a, b, vecs_[i], reach, offsets);
    include_polygon(a, b, std::vector<Vec>{vecs_[i], vecs_[i] + out, next + out, next}, offsets);
  }
  return offsets;
}

}  // namespace quadrille::geometry
