// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// The polygon with these corners (x, y), in the input's units, rounded outwards: as
/// quantise_radius_up does with a radius, so that no body is smaller than it is given. Its corners
/// are whole length units less than one unit away from a given one in x and in y, and it contains
/// the given polygon; a number that differs from a whole one by a billionth is meant to be that.
/// Where none is between two units, the corners are those given; otherwise there may be more of
/// them. Errors: out_of_range for corners that are not finite or too far away, and as
/// ConvexPolygon::make for the corners to the nearest unit. Cubic in the number of corners.
[[nodiscard]] Result<ConvexPolygon> quantise_polygon_up(
    std::span<const std::pair<double, double>> corners, const Resolution& resolution);

}  // namespace quadrille::continuous

QUADRILLE_API_END
