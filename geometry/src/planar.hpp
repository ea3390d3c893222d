// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "quadrille/geometry/motion.hpp"

// What the parts of this folder share: vectors in doubles, the time that two motions have in
// common, and the error bound of the floating-point filter. All this is for motions of one height,
// and vectors leave that out; space.hpp is for others.
namespace quadrille::geometry {

/// Wide enough for products of two differences of points in range: 2 * 2^43 * 2^43.
__extension__ using Wide = __int128;

struct Vec {
  double x = 0;
  double y = 0;
};
inline Vec operator+(Vec p, Vec q) { return {p.x + q.x, p.y + q.y}; }
inline Vec operator-(Vec p, Vec q) { return {p.x - q.x, p.y - q.y}; }
inline Vec operator*(double factor, Vec p) { return {factor * p.x, factor * p.y}; }
inline double dot(Vec p, Vec q) { return p.x * q.x + p.y * q.y; }
inline double cross(Vec p, Vec q) { return p.x * q.y - p.y * q.x; }
inline double norm(Vec p) { return std::sqrt(dot(p, p)); }

inline Point operator+(const Point& p, const Point& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
inline Point operator-(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
inline Vec to_vec(const Point& p) {
  return {static_cast<double>(p.x.value()), static_cast<double>(p.y.value())};
}
/// An area, in square length units.
inline Wide product(Length p, Length q) { return static_cast<Wide>(p.value()) * q.value(); }
inline Wide cross(const Point& p, const Point& q) { return product(p.x, q.y) - product(p.y, q.x); }
inline Length extent(const Point& p) { return std::max(abs(p.x), abs(p.y)); }

/// The distance of `p` from the segment. Its rounding error is below 16 u times the largest
/// coordinate (u = 2^-53), however short the segment: each product in the cross product is off by u
/// times |p - begin| |end - begin|, which the division turns into u |p - begin|; and when the
/// projection falls on the wrong side of an end for the same reason, the end is as near as that.
inline double distance(Vec p, Vec begin, Vec end) {
  const Vec along = end - begin;
  const Vec to_p = p - begin;
  const double square = dot(along, along);
  const double projection = dot(to_p, along);
  if (!(projection > 0)) return norm(to_p);
  if (projection >= square) return norm(p - end);
  return std::abs(cross(to_p, along)) / std::sqrt(square);
}

/// Whether one body stays at the height of the other.
inline bool is_level(const Motion& a, const Motion& b) {
  return a.from.z == a.to.z && a.from.z == b.from.z && a.from.z == b.to.z;
}

/// Times since a's start, in ticks: begin <= end.
struct Window {
  Ticks begin = 0;
  Ticks end = 0;
};

/// When both motions run, b starting `offset` ticks after a.
inline std::optional<Window> common_window(const Motion& a, const Motion& b, Ticks offset) {
  if (offset > a.duration || offset < -b.duration) return std::nullopt;
  return Window{std::max(Ticks{0}, offset), std::min(a.duration, offset + b.duration)};
}

/// Two motions as seen from a: where b's reference point is relative to a's.
struct RelativePath {
  Vec begin;     ///< At the begin of the window.
  Vec end;       ///< At its end; a straight line lies between.
  double error;  ///< How far a distance computed from these may be from the exact one.
};

/// The error bound of distances between a relative path and a shape whose coordinates are at most
/// `size`: each coordinate of the path is a sum of three exact integers, two of them multiplied by
/// a rounded fraction in [0, 1], so it is off by at most 4 u times the sum of their sizes; the
/// distance of two points of the plane then by 12 u, and computing it adds 16 u of coordinates that
/// are no larger. 64 u leaves room for the comparisons themselves.
inline double error_bound(const Motion& a, const Motion& b, Length size) {
  const Length sum = extent(b.from - a.from) + extent(a.to - a.from) + extent(b.to - b.from) + size;
  return 32 * std::numeric_limits<double>::epsilon() * static_cast<double>(sum.value());
}

/// The share of its way that lies behind a body at tick s.
inline double share_at(const Motion& motion, Ticks s) {
  return static_cast<double>(motion.done(s).value()) / static_cast<double>(motion.whole().value());
}

/// What happens within two motions, in doubles: where b is as seen from a when both begin, and how
/// far each goes until it ends.
template <class Vector>
struct Sweep {
  Vector apart, step_a, step_b;
};
template <class ToVector>
auto sweep(const Motion& a, const Motion& b, const ToVector& to_vector) {
  const auto way_a = to_vector(a.to - a.from), way_b = to_vector(b.to - b.from);
  const double first_a = share_at(a, 0), first_b = share_at(b, 0);
  return Sweep<std::decay_t<decltype(way_a)>>{
      to_vector(b.from - a.from) + first_b * way_b - first_a * way_a,
      (share_at(a, a.duration) - first_a) * way_a, (share_at(b, b.duration) - first_b) * way_b};
}

/// Where b is as seen from a, when the window begins and when it ends; `to_vector` makes doubles of
/// points.
template <class ToVector>
auto relative_ends(const Motion& a, const Motion& b, Ticks offset, Window window,
                   const ToVector& to_vector) {
  const auto apart = to_vector(b.from - a.from);
  const auto step_a = to_vector(a.to - a.from);
  const auto step_b = to_vector(b.to - b.from);
  const auto at = [&](Ticks time) {
    return apart + share_at(b, time - offset) * step_b - share_at(a, time) * step_a;
  };
  return std::pair(at(window.begin), at(window.end));
}

inline RelativePath relative_path(const Motion& a, const Motion& b, Ticks offset, Window window,
                                  Length size) {
  const auto [begin, end] = relative_ends(a, b, offset, window, to_vec);
  return {begin, end, error_bound(a, b, size)};
}

/// The places that b's reference point can take relative to a's at any offset: a parallelogram, in
/// this order around it, or what is left of one. Of parts: those of the whole motions.
struct Parallelogram {
  Point corners[4];
};
inline Parallelogram relative_places(const Motion& a, const Motion& b) {
  return {{b.from - a.from, b.to - a.from, b.to - a.to, b.from - a.to}};
}

}  // namespace quadrille::geometry
