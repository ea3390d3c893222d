// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "planar.hpp"

// The predicates in exact integer arithmetic: slow, and asked only when floating point is in doubt.
//
// `shape` is the convex polygon, counter-clockwise, that must not contain b's position relative to
// a's once it is grown by `reach`; a single point for two discs. Bodies meet when the relative
// position is less than `reach` away from it, or, with reach == 0, inside it.
namespace quadrille::geometry::exact {

/// Whether the bodies meet within `window`.
bool meet(const Motion& a, const Motion& b, Ticks offset, Window window,
          std::span<const Point> shape, Length reach);

/// Whether the smallest distance within `window` is exactly `reach`. Requires !meet(...).
bool touch(const Motion& a, const Motion& b, Ticks offset, Window window,
           std::span<const Point> shape, Length reach);

/// Requires that the bodies meet at neither of two offsets, `offset` and `offset` + 1, at both of
/// which the motions have time in common. Returns the sign of (how far apart they are at the first)
/// - (at the second), in a measure that is a convex function of the offset.
int compare_next(const Motion& a, const Motion& b, Ticks offset, std::span<const Point> shape,
                 Length reach);

/// Whether some point of the sides of `places` is less than `reach` away from a side of `shape`.
bool sides_within(const Parallelogram& places, std::span<const Point> shape, Length reach);

}  // namespace quadrille::geometry::exact
