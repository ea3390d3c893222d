// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "planar.hpp"

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

/// Extends `offsets` by those at which b's position relative to a's is within `radius` of `centre`.
void include_disc(const Motion& a, const Motion& b, Vec centre, double radius,
                  RealInterval& offsets);

/// Extends `offsets` by those at which b's position relative to a's is in the convex polygon, whose
/// corners are given counter-clockwise.
void include_polygon(const Motion& a, const Motion& b, std::span<const Vec> corners,
                     RealInterval& offsets);

}  // namespace quadrille::geometry
