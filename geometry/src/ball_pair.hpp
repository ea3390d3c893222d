// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "hints.hpp"
#include "quadrille/geometry/body_pair.hpp"

// What BodyPair answers about two balls whose motions are not level (see is_level). `reach` is the
// sum of the radii.
namespace quadrille::geometry::balls {

/// Whether the balls meet within `window`. Exact.
bool meet(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach);

/// Whether the motions collide at some offset, real ones included. Exact.
bool can_meet(const Motion& a, const Motion& b, Length reach);

/// Whether bounding boxes alone say that they cannot.
bool boxes_apart(const Motion& a, const Motion& b, Length reach);

/// The offsets at which the balls probably meet; without guarantee.
RealInterval likely_offsets(const Motion& a, const Motion& b, Length reach);

/// Some offset at which the balls meet; none if there is no such integer. Exact and slow.
std::optional<Ticks> find_meeting(const Motion& a, const Motion& b, Length reach);

/// The gap within `window`. Requires that the balls do not meet there.
Gap gap(const Motion& a, const Motion& b, Ticks offset, Window window, Length reach);

}  // namespace quadrille::geometry::balls
