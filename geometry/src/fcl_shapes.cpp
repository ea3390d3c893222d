// SPDX-License-Identifier: MIT
#include "fcl_shapes.hpp"

#include <fcl/geometry/shape/convex.h>

namespace quadrille::geometry {

std::shared_ptr<fcl::CollisionGeometryd> make_prism(std::span<const Eigen::Vector2d> corners,
                                                    double height) {
  const int n = static_cast<int>(corners.size());
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const double z : {-height / 2, height / 2})
    for (const Eigen::Vector2d& corner : corners) vertices->emplace_back(corner.x(), corner.y(), z);
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

std::shared_ptr<fcl::CollisionGeometryd> make_prism(std::span<const Point> corners, double scale,
                                                    double height) {
  std::vector<Eigen::Vector2d> scaled;
  for (const Point& corner : corners)
    scaled.emplace_back(scale * static_cast<double>(corner.x.value()),
                        scale * static_cast<double>(corner.y.value()));
  return make_prism(scaled, height);
}

}  // namespace quadrille::geometry
