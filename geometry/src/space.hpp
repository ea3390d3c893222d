// SPDX-License-Identifier: MIT
#pragma once

#include "planar.hpp"

// What planar.hpp has, for motions that climb, or at different heights.
namespace quadrille::geometry {

struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;
};
inline Vec3 operator+(Vec3 p, Vec3 q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
inline Vec3 operator-(Vec3 p, Vec3 q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
inline Vec3 operator*(double factor, Vec3 p) { return {factor * p.x, factor * p.y, factor * p.z}; }
inline double dot(Vec3 p, Vec3 q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
inline Vec3 cross(Vec3 p, Vec3 q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
inline double norm(Vec3 p) { return std::sqrt(dot(p, p)); }
inline Vec3 to_vec3(const Point& p) {
  return {static_cast<double>(p.x.value()), static_cast<double>(p.y.value()),
          static_cast<double>(p.z.value())};
}
inline Length extent3(const Point& p) { return std::max(extent(p), abs(p.z)); }

/// The distance of the origin from the segment. Its rounding error is below 24 u times the largest
/// coordinate (u = 2^-53), however short the segment: with L <= sqrt(3) times that for the length
/// of `begin` and 2 L for that of the step, rounding the step moves an end by 2 u L; the projection
/// may fall on the wrong side of an end that is as near as 3 u L; the cross product is off by
/// (1 + sqrt(2)) u L times the length of the step, by which it is divided; and norms, root and
/// division add 6 u times the distance, which is at most L.
inline double distance(Vec3 begin, Vec3 end) {
  const Vec3 along = end - begin;
  const double square = dot(along, along);
  const double projection = -dot(begin, along);
  if (!(projection > 0)) return norm(begin);
  if (projection >= square) return norm(end);
  return norm(cross(begin, along)) / std::sqrt(square);
}

/// RelativePath in space.
struct SpacePath {
  Vec3 begin;
  Vec3 end;
  double error;
};

/// The error bound of distances between a relative path and the origin, compared with `reach`: each
/// coordinate of the path is off by at most 4 u times the sum of the sizes that go into it, see
/// error_bound, a point of space by 7 u, and computing the distance adds 24 u. 64 u leaves room for
/// the comparisons themselves.
inline double space_error_bound(const Motion& a, const Motion& b, Length reach) {
  const Length sum =
      extent3(b.from - a.from) + extent3(a.to - a.from) + extent3(b.to - b.from) + reach;
  return 32 * std::numeric_limits<double>::epsilon() * static_cast<double>(sum.value());
}

inline SpacePath space_path(const Motion& a, const Motion& b, Ticks offset, Window window,
                            Length reach) {
  const auto [begin, end] = relative_ends(a, b, offset, window, to_vec3);
  return {begin, end, space_error_bound(a, b, reach)};
}

}  // namespace quadrille::geometry
