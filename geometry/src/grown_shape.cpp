// SPDX-License-Identifier: MIT
#include "grown_shape.hpp"

#include <algorithm>

#include "planar.hpp"

namespace quadrille::geometry {
namespace {

std::vector<Point> corners_of(const Body& body) {
  if (const auto* polygon = std::get_if<ConvexPolygon>(&body)) return polygon->vertices();
  return {Point{}};
}

/// The same corners in the same order, from the lowest of the leftmost ones on.
void begin_at_left(std::vector<Point>& corners) {
  const auto before = [](const Point& p, const Point& q) {
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  };
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), before),
              corners.end());
}

}  // namespace

// The bodies overlap when u in a and w in b are at the same place: position_a + u = position_b + w,
// so b's position relative to a's is u - w. These differences form a convex polygon, whose sides
// are those of a and of the mirrored b, in the order of their directions.
std::vector<Point> grown_corners(const Body& a, const Body& b) {
  std::vector<Point> p = corners_of(a), q = corners_of(b);
  for (Point& corner : q) corner = Point{} - corner;
  begin_at_left(p);
  begin_at_left(q);
  const auto side = [](const std::vector<Point>& corners, std::size_t k) {
    return corners[(k + 1) % corners.size()] - corners[k % corners.size()];
  };
  const std::size_t sides_p = p.size() > 1 ? p.size() : 0, sides_q = q.size() > 1 ? q.size() : 0;
  std::vector<Point> grown;
  for (std::size_t i = 0, j = 0; grown.empty() || i < sides_p || j < sides_q;) {
    grown.push_back(p[i % p.size()] + q[j % q.size()]);
    if (i == sides_p && j == sides_q) break;  // two points
    const Wide turn = i == sides_p   ? Wide{-1}
                      : j == sides_q ? Wide{1}
                                     : cross(side(p, i), side(q, j));
    if (turn >= 0) ++i;
    if (turn <= 0) ++j;
  }
  return grown;
}

}  // namespace quadrille::geometry
