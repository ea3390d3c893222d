// SPDX-License-Identifier: MIT
#include "grown_shape.hpp"

#include <utility>

#include "lattice_hull.hpp"
#include "planar.hpp"

namespace quadrille::geometry {
namespace {

std::vector<Point> corners_of(const Body& body) {
  if (const auto* polygon = std::get_if<ConvexPolygon>(&body)) return polygon->vertices();
  return {Point{}};
}

}  // namespace

// The bodies overlap when u in a and w in b are at the same place: position_a + u = position_b + w,
// so b's position relative to a's is u - w. These differences form a convex polygon.
std::vector<Point> grown_corners(const Body& a, const Body& b) {
  std::vector<Point> points;
  for (const Point& u : corners_of(a))
    for (const Point& w : corners_of(b)) points.push_back(u - w);
  return convex_hull(std::move(points));
}

}  // namespace quadrille::geometry
