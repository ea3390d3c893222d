// SPDX-License-Identifier: MIT
#include "quadrille/continuous/quantise_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "model/areas.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::continuous {
namespace {

/// In length units, not rounded unless it is meant to be whole.
struct Exact {
  long double x, y;
};

/// A coordinate: the whole numbers around it, which are the same if it is meant to be whole.
struct Between {
  Length least, most;
  long double exact;
};

Between look(double value, Length nearest, const Resolution& resolution) {
  const double back = in_input_units(nearest, resolution);
  const auto whole = static_cast<long double>(nearest.value());
  if (std::abs(value - back) <= 1e-9 * std::abs(value)) return {nearest, nearest, whole};
  const auto over = (static_cast<long double>(value) - back) / resolution.length;
  return {value < back ? nearest - 1 : nearest, value < back ? nearest : nearest + 1, whole + over};
}

/// Positive where `at` is to the left of the way from a to b.
long double side(const Point& a, const Point& b, const Exact& at) {
  const auto x = static_cast<long double>(a.x.value()), y = static_cast<long double>(a.y.value());
  return static_cast<long double>((b.x - a.x).value()) * (at.y - y) -
         static_cast<long double>((b.y - a.y).value()) * (at.x - x);
}

bool is_left(const Point& a, const Point& b, const Point& at) {
  return Area{(b.x - a.x).value()} * (at.y - a.y).value() >
         Area{(b.y - a.y).value()} * (at.x - a.x).value();
}

/// Counter-clockwise, without points on its edges.
std::vector<Point> hull_of(std::vector<Point> points) {
  const auto before = [](const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Point> hull;
  const auto walk = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto at = begin; at != end; ++at) {
      while (hull.size() >= first + 2 && !is_left(hull[hull.size() - 2], hull.back(), *at))
        hull.pop_back();
      hull.push_back(*at);
    }
    hull.pop_back();
  };
  walk(points.begin(), points.end());
  walk(points.rbegin(), points.rend());
  return hull;
}

/// Without corners that none of the given ones needs to be inside.
void drop_spare(std::vector<Point>& hull, const std::vector<Exact>& inside) {
  for (std::size_t k = 0; k < hull.size() && hull.size() > 3;) {
    const Point& before = hull[(k + hull.size() - 1) % hull.size()];
    const Point& after = hull[(k + 1) % hull.size()];
    const bool is_spare = std::all_of(inside.begin(), inside.end(), [&](const Exact& corner) {
      return side(before, after, corner) >= 0;
    });
    if (is_spare)
      hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  }
}

}  // namespace

Result<ConvexPolygon> quantise_polygon_up(std::span<const std::pair<double, double>> corners,
                                          const Resolution& resolution) {
  std::vector<Point> nearest, around;
  std::vector<Exact> given;
  for (const auto& [x, y] : corners) {
    const auto near_x = quantise_coordinate(x, resolution);
    const auto near_y = quantise_coordinate(y, resolution);
    if (!near_x || !near_y)
      return Error{ErrorCode::out_of_range,
                   "a corner is too far away for the resolution, or not finite",
                   {}};
    nearest.push_back({*near_x, *near_y});
    const Between in_x = look(x, *near_x, resolution), in_y = look(y, *near_y, resolution);
    given.push_back({in_x.exact, in_y.exact});
    for (const Length a : {in_x.least, in_x.most})
      for (const Length b : {in_y.least, in_y.most}) around.push_back({a, b});
  }
  auto polygon = ConvexPolygon::make(nearest);
  const bool is_whole =
      std::equal(nearest.begin(), nearest.end(), given.begin(), [](const Point& a, const Exact& b) {
        return static_cast<long double>(a.x.value()) == b.x &&
               static_cast<long double>(a.y.value()) == b.y;
      });
  if (!polygon || is_whole) return polygon;
  std::vector<Point> hull = hull_of(std::move(around));
  drop_spare(hull, given);
  return ConvexPolygon::make(std::move(hull));
}

}  // namespace quadrille::continuous
