// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "space.hpp"

// Where the unsafe offsets probably end: closed forms in doubles, without any guarantee. The caller
// settles each end with the exact predicate, so an error here costs time and nothing else.
namespace quadrille::geometry {

/// Real offsets, in ticks; empty while lo > hi.
struct RealInterval {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  [[nodiscard]] bool empty() const { return lo > hi; }
  void include(double value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
};

inline double cross_length(Vec p, Vec q) { return std::abs(cross(p, q)); }
inline double cross_length(Vec3 p, Vec3 q) { return norm(cross(p, q)); }

/// The fractions in [0, 1] of a step at which |start + fraction * step| < radius.
template <class Vector>
RealInterval near_fractions(Vector start, Vector step, double radius) {
  RealInterval result;
  const double square = dot(step, step);
  if (square == 0) {
    if (dot(start, start) < radius * radius) result = {0, 1};
    return result;
  }
  // The miss distance from the cross product: the discriminant would cancel where discs graze.
  const double length = std::sqrt(square);
  const double miss = cross_length(start, step) / length;
  if (miss >= radius) return result;
  const double middle = -dot(start, step) / square;
  const double half = std::sqrt((radius - miss) * (radius + miss)) / length;
  if (middle + half < 0 || middle - half > 1) return result;
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

/// Extends `offsets` by those at which the position of b relative to a, from `apart` on, is within
/// `radius` of the origin while one of them is at an end of its motion.
template <class Vector>
void include_ends(Vector apart, Vector step_a, Vector step_b, double duration_a, double duration_b,
                  double radius, RealInterval& offsets) {
  for (const double p : {0.0, 1.0}) {
    const RealInterval q = near_fractions(apart - p * step_a, step_b, radius);
    if (q.empty()) continue;
    offsets.include(p * duration_a - q.lo * duration_b);
    offsets.include(p * duration_a - q.hi * duration_b);
  }
  for (const double q : {0.0, 1.0}) {
    const RealInterval p = near_fractions(apart + q * step_b, Vector{} - step_a, radius);
    if (p.empty()) continue;
    offsets.include(p.lo * duration_a - q * duration_b);
    offsets.include(p.hi * duration_a - q * duration_b);
  }
}

/// Extends `offsets` by those at which b's position relative to a's is within `radius` of `centre`.
void include_disc(const Motion& a, const Motion& b, Vec centre, double radius,
                  RealInterval& offsets);

/// Extends `offsets` by those at which b's position relative to a's is in the convex polygon, whose
/// corners are given counter-clockwise.
void include_polygon(const Motion& a, const Motion& b, std::span<const Vec> corners,
                     RealInterval& offsets);

}  // namespace quadrille::geometry
