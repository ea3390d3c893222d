// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/geometry/body.hpp"

namespace quadrille::geometry {

/// The corners, counter-clockwise, of the polygon that b's position relative to a's must avoid when
/// discs count as points: a grown by the mirrored b.
/// The origin alone for two discs.
std::vector<Point> grown_corners(const Body& a, const Body& b);

}  // namespace quadrille::geometry
