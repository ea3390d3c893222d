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

/// Some offset at which the bodies meet; none if there is no such integer. Slow: as many calls of
/// `meet` as the durations have bits.
std::optional<Ticks> find_meeting(const Motion& a, const Motion& b, std::span<const Point> shape,
                                  Length reach);

/// Whether some point of the sides of `places` is less than `reach` away from a side of `shape`.
bool sides_within(const Parallelogram& places, std::span<const Point> shape, Length reach);

}  // namespace quadrille::geometry::exact
