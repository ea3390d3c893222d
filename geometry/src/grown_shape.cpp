// SPDX-License-Identifier: MIT
#include "grown_shape.hpp"

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

std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& p, const Point& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Point> hull;
  const auto add = [&](const Point& point, std::size_t kept) {
    while (hull.size() > kept &&
           cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Point& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

}  // namespace quadrille::geometry
