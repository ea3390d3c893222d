// SPDX-License-Identifier: MIT
#include "quadrille/geometry/body.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "planar.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::geometry {
namespace {

// Twice the signed area of the triangle p, q, r. Coordinates up to 2^40 give at most 2^84.
int turn(const Point& p, const Point& q, const Point& r) {
  const Wide area = cross(q - p, r - p);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

Error invalid(std::string reason) {
  return Error{ErrorCode::invalid_instance, "polygon: " + std::move(reason), {}};
}

// 0 for the directions in [0, 180) degrees, 1 for the others.
int half_plane(const Point& from, const Point& to) {
  return to.y > from.y || (to.y == from.y && to.x > from.x) ? 0 : 1;
}

}  // namespace

Result<ConvexPolygon> ConvexPolygon::make(std::vector<Point> vertices) {
  const std::size_t n = vertices.size();
  if (n < 3) return invalid("fewer than three corners");
  if (n > kMaxVertices)
    return Error{ErrorCode::out_of_range,
                 "polygon: more than " + std::to_string(kMaxVertices) + " corners",
                 {}};
  for (const Point& vertex : vertices)
    if (!in_range(vertex))
      return Error{ErrorCode::out_of_range, "polygon: a corner is too far", {}};
  for (const Point& vertex : vertices)
    if (vertex.z != 0) return invalid("a corner has a height");

  const auto at = [&](std::size_t i) -> const Point& { return vertices[i % n]; };
  const int orientation = turn(at(0), at(1), at(2));
  int half_turns = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (at(i) == at(i + 1)) return invalid("a corner repeats");
    const int here = turn(at(i), at(i + 1), at(i + 2));
    if (here == 0) return invalid("three consecutive corners are on a line");
    if (here != orientation) return invalid("not convex");
    if (half_plane(at(i), at(i + 1)) != half_plane(at(i + 1), at(i + 2))) ++half_turns;
  }
  // Turning one way all the time, but more than once around: a star.
  if (half_turns != 2) return invalid("not convex");
  if (orientation < 0) std::reverse(vertices.begin() + 1, vertices.end());
  return ConvexPolygon(std::move(vertices));
}

Length enclosing_radius(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body)) return disc->radius;
  Wide square = 0;
  for (const Point& corner : std::get<ConvexPolygon>(body).vertices())
    square = std::max(square, Wide{corner.x.value()} * corner.x.value() +
                                  Wide{corner.y.value()} * corner.y.value());
  // At most 2^81: the root of the rounded number is off by less than a unit.
  auto radius = static_cast<std::int64_t>(std::sqrt(static_cast<long double>(square)));
  while (Wide{radius} * radius < square) ++radius;
  while (radius > 0 && Wide{radius - 1} * (radius - 1) >= square) --radius;
  return Length(radius);
}

}  // namespace quadrille::geometry
