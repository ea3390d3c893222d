// SPDX-License-Identifier: MIT
#include "quadrille/geometry/turning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "exact/exact_integer.hpp"
#include "lattice_hull.hpp"
#include "planar.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::geometry {
namespace {

/// A vector that is no place: a corner turned, times the length of the direction. Below 2^62.
struct WideVector {
  std::int64_t x, y;
};
Wide cross(const WideVector& p, const WideVector& q) {
  return static_cast<Wide>(p.x) * q.y - static_cast<Wide>(p.y) * q.x;
}
Wide dot(const WideVector& p, const WideVector& q) {
  return static_cast<Wide>(p.x) * q.x + static_cast<Wide>(p.y) * q.y;
}
WideVector wide(const Point& p) { return {p.x.value(), p.y.value()}; }
WideVector wide(const Direction& d) { return {d.x, d.y}; }

/// The root of a number that is not negative, rounded down.
std::int64_t root(Wide square) {
  if (square <= 1) return static_cast<std::int64_t>(square);
  Wide low = static_cast<Wide>(std::sqrt(static_cast<long double>(square)));
  // Newton's steps from a guess that is good already.
  for (Wide next = (low + square / low) / 2; next < low || (next - low) > 1;
       next = (low + square / low) / 2)
    low = next;
  while (low * low > square) --low;
  while ((low + 1) * (low + 1) <= square) ++low;
  return static_cast<std::int64_t>(low);
}
std::int64_t root_up(Wide square) {
  const std::int64_t low = root(square);
  return static_cast<Wide>(low) * low < square ? low + 1 : low;
}

/// number / sqrt(square), rounded down, for a number below 2^62.
std::int64_t divided_by_root(std::int64_t number, std::int64_t square) {
  const Wide all = static_cast<Wide>(number) * number;
  const std::int64_t size = root(all / square);
  if (number >= 0) return size;
  return static_cast<Wide>(size) * size * square < all ? -size - 1 : -size;
}

WideVector turn(const Point& corner, const Direction& d) {
  const std::int64_t x = corner.x.value(), y = corner.y.value();
  return {x * d.x - y * d.y, x * d.y + y * d.x};
}

/// The lattice points around the turned corner.
void add_corner(const Point& corner, const Direction& d, std::vector<Point>& points) {
  const WideVector at = turn(corner, d);
  const std::int64_t square = d.x * d.x + d.y * d.y;
  const std::int64_t left = divided_by_root(at.x, square), right = -divided_by_root(-at.x, square);
  const std::int64_t low = divided_by_root(at.y, square), high = -divided_by_root(-at.y, square);
  for (const std::int64_t x : {left, right})
    for (const std::int64_t y : {low, high}) points.push_back({Length(x), Length(y)});
}

Result<Body> body_of(std::vector<Point> points) {
  std::vector<Point> hull =
      with_fewer_corners(convex_hull(std::move(points)), ConvexPolygon::kMaxVertices);
  if (hull.size() > ConvexPolygon::kMaxVertices) {
    Wide square = 0;
    for (const Point& p : hull) square = std::max(square, dot(wide(p), wide(p)));
    const Disc disc{Length(root_up(square))};
    if (disc.radius > kMaxLength)
      return Error{ErrorCode::out_of_range, "a turned body is too large", {}};
    return Body(disc);
  }
  auto polygon = ConvexPolygon::make(std::move(hull));
  if (!polygon) return polygon.error();
  return Body(std::move(polygon).value());
}

/// Whether the line through the two points, from which the origin is to the left, is as far from it
/// as the root of `square`.
bool is_beyond(const Point& p, const Point& q, Wide square) {
  const Wide area = cross(p, q);
  if (area <= 0) return false;
  const auto integer = [](Wide x) {
    exact::Integer whole = static_cast<std::int64_t>(x >> 62);
    whole <<= 62;
    whole += static_cast<std::int64_t>(x & ((Wide{1} << 62) - 1));
    return whole;
  };
  const WideVector along = wide(q - p);
  const exact::Integer left = integer(area);
  return left * left >= integer(square) * integer(dot(along, along));
}

/// Fixed point: 2^30 is one.
constexpr int kFraction = 30;
constexpr std::int64_t kOne = std::int64_t{1} << kFraction;
/// Cosines of 1/16, 1/8 and 1/4 of a turn: the longest pieces of an arc.
constexpr std::array<std::int64_t, 3> kPieces{992008094, 759250125, 0};
constexpr int kTries = 16;

/// The chain of points in whose polygon, with the origin and the two ends, is the arc of a corner
/// that turns counter-clockwise from one direction to the other, by half a turn at most: the arc is
/// halved until pieces are short, and the chain has the points where the tangents at the ends of a
/// piece meet.
class ArcCover {
 public:
  ArcCover(const Point& corner, const Direction& from, const Direction& to, std::int64_t piece)
      : begin_(turn(corner, from)),
        end_(turn(corner, to)),
        square_(dot(wide(corner), wide(corner))),
        radius_(root_up(square_)),
        piece_(piece) {}

  /// False if it did not work out.
  [[nodiscard]] bool add_to(std::vector<Point>& points) const {
    if (radius_ == 0) return true;  // the corner is where the body turns about
    for (int margin = 2; margin < 2 + kTries; ++margin) {
      const std::vector<Point> chain = chain_at(margin);
      if (!covers(chain)) continue;
      points.insert(points.end(), chain.begin(), chain.end());
      return true;
    }
    return false;
  }

 private:
  [[nodiscard]] static std::int64_t fixed(Wide number, Wide denominator) {
    return static_cast<std::int64_t>((number << kFraction) / denominator);
  }
  [[nodiscard]] static WideVector unit(const WideVector& v) {
    const std::int64_t size = std::max<std::int64_t>(root(dot(v, v)), 1);
    return {fixed(v.x, size), fixed(v.y, size)};
  }

  /// The ends of the pieces between two units, without the first one.
  void halve(const WideVector& u, const WideVector& v, int depth,
             std::vector<WideVector>& ends) const {
    if (depth < 6 && dot(u, v) < (static_cast<Wide>(piece_) << kFraction)) {
      // Of opposite ones the middle is to the left of the first.
      const bool is_wide = dot(u, v) < 0;
      const WideVector half =
          is_wide ? WideVector{v.y - u.y, u.x - v.x} : WideVector{u.x + v.x, u.y + v.y};
      const WideVector middle = unit(half);
      halve(u, middle, depth + 1, ends);
      halve(middle, v, depth + 1, ends);
      return;
    }
    ends.push_back(v);
  }

  /// From a little before the arc's begin to a little after its end, everywhere `margin` farther
  /// out.
  [[nodiscard]] std::vector<Point> chain_at(std::int64_t margin) const {
    const auto at = [&](Wide x, Wide y) {
      return Point{Length(static_cast<std::int64_t>(x >> kFraction)),
                   Length(static_cast<std::int64_t>(y >> kFraction))};
    };
    const auto end = [&](const WideVector& u, std::int64_t ahead) {
      const Wide far = radius_ + margin;
      return at(far * u.x - static_cast<Wide>(ahead) * u.y,
                far * u.y + static_cast<Wide>(ahead) * u.x);
    };
    std::vector<WideVector> ends{unit(begin_)};
    halve(ends.front(), unit(end_), 0, ends);
    std::vector<Point> chain{end(ends.front(), -2)};
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const WideVector &u = ends[k], &v = ends[k + 1];
      // The tangents meet at radius (u + v) / (1 + uv).
      const Wide share = kOne + (dot(u, v) >> kFraction);
      const std::int64_t far = fixed(radius_, share);
      const WideVector middle = unit({u.x + v.x, u.y + v.y});
      const auto apart = [&](std::int64_t a, std::int64_t b, std::int64_t m) {
        return static_cast<Wide>(far) * (a + b) + static_cast<Wide>(margin) * m;
      };
      chain.push_back(at(apart(u.x, v.x, middle.x), apart(u.y, v.y, middle.y)));
    }
    chain.push_back(end(ends.back(), 2));
    return chain;
  }

  /// From its first point to its last one it goes around the whole arc, and never comes nearer to
  /// the origin than the arc.
  [[nodiscard]] bool covers(const std::vector<Point>& chain) const {
    const WideVector first = wide(chain.front()), last = wide(chain.back());
    if (cross(first, begin_) < 0 || dot(first, begin_) <= 0) return false;
    if (cross(end_, last) < 0 || dot(end_, last) <= 0) return false;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      if (!is_beyond(chain[k], chain[k + 1], square_)) return false;
    return true;
  }

  const WideVector begin_, end_;
  const Wide square_;
  const std::int64_t radius_;  // its root, rounded up
  const std::int64_t piece_;
};

/// Of area than the disc; 355/113 is a little more than pi.
bool is_smaller(const Body& body, const Disc& disc) {
  const auto* polygon = std::get_if<ConvexPolygon>(&body);
  if (polygon == nullptr) return std::get<Disc>(body).radius < disc.radius;
  const std::vector<Point>& corners = polygon->vertices();
  Wide twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    twice += cross(corners[k], corners[(k + 1) % corners.size()]);
  return 113 * twice < 2 * 355 * product(disc.radius, disc.radius);
}

bool is_valid(const Direction& d) {
  return std::abs(d.x) <= Direction::kMost && std::abs(d.y) <= Direction::kMost &&
         (d.x != 0 || d.y != 0);
}

bool is_same_way(const Direction& d, const Direction& e) {
  return cross(wide(d), wide(e)) == 0 && dot(wide(d), wide(e)) > 0;
}

}  // namespace

Direction Direction::at(double angle) {
  QUADRILLE_REQUIRE(std::isfinite(angle), "a direction");
  const auto part = [](double share) {
    return static_cast<std::int64_t>(std::llround(share * static_cast<double>(kMost)));
  };
  const std::int64_t ahead = part(std::cos(angle)), left = part(std::sin(angle));
  const std::int64_t common = std::gcd(ahead, left);
  return {ahead / common, left / common};
}

Result<Body> turned(const Body& body, const Direction& facing) {
  QUADRILLE_REQUIRE(is_valid(facing), "a direction");
  const auto* polygon = std::get_if<ConvexPolygon>(&body);
  if (polygon == nullptr) return body;
  std::vector<Point> points;
  for (const Point& corner : polygon->vertices()) add_corner(corner, facing, points);
  return body_of(std::move(points));
}

Result<Body> swept_by_turn(const Body& body, const Direction& from, const Direction& to) {
  QUADRILLE_REQUIRE(is_valid(from) && is_valid(to), "two directions");
  const auto* polygon = std::get_if<ConvexPolygon>(&body);
  if (polygon == nullptr || is_same_way(from, to)) return turned(body, from);
  const bool is_clockwise = cross(wide(from), wide(to)) < 0;
  const Direction &first = is_clockwise ? to : from, &last = is_clockwise ? from : to;
  std::vector<Point> ends;
  for (const Point& corner : polygon->vertices())
    for (const Direction& d : {from, to}) add_corner(corner, d, ends);
  // The lattice points around a corner may be farther than the corner.
  const Disc all{enclosing_radius(body) + 2};
  for (const std::int64_t& piece : kPieces) {
    std::vector<Point> points = ends;
    const bool is_covered = std::all_of(
        polygon->vertices().begin(), polygon->vertices().end(),
        [&](const Point& corner) { return ArcCover(corner, first, last, piece).add_to(points); });
    if (!is_covered) break;
    std::vector<Point> hull = convex_hull(std::move(points));
    // Rather longer pieces than edges that give way.
    if (hull.size() > ConvexPolygon::kMaxVertices && &piece != &kPieces.back()) continue;
    auto swept = body_of(std::move(hull));
    if (!swept || is_smaller(*swept, all)) return swept;
    break;
  }
  if (all.radius > kMaxLength)
    return Error{ErrorCode::out_of_range, "a turned body is too large", {}};
  return Body(all);
}

bool contains(const Body& outer, const Body& inner) {
  const auto *disc = std::get_if<Disc>(&outer), *inner_disc = std::get_if<Disc>(&inner);
  const auto each_side = [&](const auto& holds) {
    const std::vector<Point>& corners = std::get<ConvexPolygon>(outer).vertices();
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (!holds(corners[k], corners[(k + 1) % corners.size()])) return false;
    return true;
  };
  if (inner_disc != nullptr) {
    if (disc != nullptr) return disc->radius >= inner_disc->radius;
    return each_side([&](const Point& p, const Point& q) {
      return is_beyond(p, q, product(inner_disc->radius, inner_disc->radius));
    });
  }
  const std::vector<Point>& corners = std::get<ConvexPolygon>(inner).vertices();
  return std::all_of(corners.begin(), corners.end(), [&](const Point& corner) {
    if (disc != nullptr)
      return dot(wide(corner), wide(corner)) <= product(disc->radius, disc->radius);
    return each_side([&](const Point& p, const Point& q) { return cross(q - p, corner - p) >= 0; });
  });
}

}  // namespace quadrille::geometry
