// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "quadrille/geometry/point.hpp"

namespace quadrille::geometry {

/// The corners of the convex hull of points of the plane, counter-clockwise, without those on its
/// sides. Two or fewer if all are on a line. Coordinates up to 2^42. n log n.
[[nodiscard]] std::vector<Point> convex_hull(std::vector<Point> points);

/// A convex polygon with at most `most` corners that contains the given one, whose corners are
/// counter-clockwise: again and again the edge that costs least area gives way to the point where
/// its neighbours meet, rounded outwards. More corners if there is no way. Requires at least three.
[[nodiscard]] std::vector<Point> with_fewer_corners(std::vector<Point> corners, std::size_t most);

}  // namespace quadrille::geometry
