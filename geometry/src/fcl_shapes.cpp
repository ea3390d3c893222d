// SPDX-License-Identifier: MIT
#include "fcl_shapes.hpp"

#include <fcl/geometry/shape/convex.h>

namespace quadrille::geometry {

std::shared_ptr<fcl::CollisionGeometryd> make_prism(std::span<const Point> corners, double scale,
                                                    double height) {
  const int n = static_cast<int>(corners.size());
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const double z : {-height / 2, height / 2})
    for (const Point& corner : corners)
      vertices->emplace_back(scale * static_cast<double>(corner.x),
                             scale * static_cast<double>(corner.y), z);
  // Each face: its number of corners, then their indices, counter-clockwise seen from outside.
  auto faces = std::make_shared<std::vector<int>>();
  faces->push_back(n);
  for (int i = n - 1; i >= 0; --i) faces->push_back(i);
  faces->push_back(n);
  for (int i = 0; i < n; ++i) faces->push_back(n + i);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    faces->insert(faces->end(), {4, i, next, n + next, n + i});
  }
  return std::make_shared<fcl::Convexd>(vertices, n + 2, faces);
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
