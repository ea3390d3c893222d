// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Core>
#include <memory>
#include <span>

#include "planar.hpp"

namespace quadrille::geometry {

/// A prism over the convex polygon with these corners, counter-clockwise; its height is `height`,
/// half of it below the plane z = 0.
std::shared_ptr<fcl::CollisionGeometryd> make_prism(std::span<const Eigen::Vector2d> corners,
                                                    double height);
/// The same with corners times `scale`.
std::shared_ptr<fcl::CollisionGeometryd> make_prism(std::span<const Point> corners, double scale,
                                                    double height);

}  // namespace quadrille::geometry
