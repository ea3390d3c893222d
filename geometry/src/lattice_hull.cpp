// SPDX-License-Identifier: MIT
#include "lattice_hull.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <tuple>

#include "planar.hpp"

namespace quadrille::geometry {
namespace {

/// Twice the area of the triangle, positive if it turns to the left.
Wide area(const Point& p, const Point& q, const Point& r) { return cross(q - p, r - p); }

/// Rounded down.
std::int64_t quotient(Wide numerator, Wide denominator) {
  Wide result = numerator / denominator;
  if (numerator % denominator != 0 && (numerator < 0) != (denominator < 0)) --result;
  return static_cast<std::int64_t>(result);
}

/// Of the edge from `b` to `c`, whose neighbours come from `a` and go to `d`: a lattice point near
/// where these meet that is on none of their inner sides. nullopt if they do not meet, or far away.
std::optional<Point> beyond_edge(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point along = b - a, other = d - c;
  const Wide denominator = cross(along, other);
  if (denominator <= 0) return std::nullopt;
  // a + along * share is on the line through c and d.
  const Wide numerator = cross(c - a, other);
  // Twice as far as the edge before is long: else the product would be too large for what it gains.
  if (numerator <= 0 || numerator > 3 * denominator) return std::nullopt;
  const auto at = [&](Length from, Length step) {
    return from + Length(quotient(numerator * step.value(), denominator));
  };
  const Point low{at(a.x, along.x), at(a.y, along.y)};
  for (const std::int64_t dx : {0, 1, -1, 2, -2})
    for (const std::int64_t dy : {0, 1, -1, 2, -2}) {
      const Point p{low.x + Length(dx), low.y + Length(dy)};
      if (area(a, b, p) <= 0 && area(c, d, p) <= 0 && in_range(p)) return p;
    }
  return std::nullopt;
}

}  // namespace

std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& p, const Point& q) { return std::tie(p.x, p.y) < std::tie(q.x, q.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Point> hull;
  const auto add = [&](const Point& p, std::size_t least) {
    while (hull.size() > least && area(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Point& p : points) add(p, 1);
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

std::vector<Point> with_fewer_corners(std::vector<Point> corners, std::size_t most) {
  while (corners.size() > most) {
    const std::size_t n = corners.size();
    std::optional<Point> best;
    Wide least = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Point &b = corners[(k + 1) % n], &c = corners[(k + 2) % n];
      const auto beyond = beyond_edge(corners[k], b, c, corners[(k + 3) % n]);
      if (!beyond) continue;
      const Wide added = -area(b, c, *beyond);
      if (best && added >= least) continue;
      best = beyond;
      least = added;
    }
    if (!best) break;
    corners.push_back(*best);
    corners = convex_hull(std::move(corners));
    if (corners.size() >= n) break;
  }
  return corners;
}

}  // namespace quadrille::geometry
