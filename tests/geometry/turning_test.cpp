// SPDX-License-Identifier: MIT
#include "quadrille/geometry/turning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lattice_hull.hpp"
#include "quadrille/core/random.hpp"
#include "support/environment.hpp"

namespace quadrille::geometry {
namespace {

using Real = long double;
struct Spot {
  Real x, y;
};

Body polygon(std::vector<Point> corners) { return ConvexPolygon::make(std::move(corners)).value(); }
const std::vector<Point>& corners_of(const Body& body) {
  return std::get<ConvexPolygon>(body).vertices();
}

/// How far outside of the body the spot is; negative inside.
Real outside(const Body& body, const Spot& at) {
  if (const auto* disc = std::get_if<Disc>(&body))
    return std::hypot(at.x, at.y) - static_cast<Real>(disc->radius.value());
  Real most = -1e30L;
  const auto& corners = corners_of(body);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point &p = corners[k], &q = corners[(k + 1) % corners.size()];
    const Real ax = static_cast<Real>((q.x - p.x).value()),
               ay = static_cast<Real>((q.y - p.y).value());
    const Real bx = at.x - static_cast<Real>(p.x.value()),
               by = at.y - static_cast<Real>(p.y.value());
    most = std::max(most, (bx * ay - ax * by) / std::hypot(ax, ay));
  }
  return most;
}

Spot rotated(const Point& p, Real angle) {
  const Real x = static_cast<Real>(p.x.value()), y = static_cast<Real>(p.y.value());
  return {x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)};
}
Real angle_of(const Direction& d) {
  return std::atan2(static_cast<Real>(d.y), static_cast<Real>(d.x));
}

Real area_of(const std::vector<Spot>& spots) {
  Real twice = 0;
  for (std::size_t k = 0; k < spots.size(); ++k) {
    const Spot &p = spots[k], &q = spots[(k + 1) % spots.size()];
    twice += p.x * q.y - p.y * q.x;
  }
  return twice / 2;
}
Real area_of(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body))
    return std::numbers::pi_v<Real> * static_cast<Real>(disc->radius.value()) *
           static_cast<Real>(disc->radius.value());
  std::vector<Spot> spots;
  for (const Point& p : corners_of(body)) spots.push_back(rotated(p, 0));
  return area_of(spots);
}

/// Of a quarter of the cases a direction of axes or diagonals.
Direction draw_direction(Random& random) {
  const std::int64_t most = random.below(4) == 0 ? 1 : random.below(2) == 0 ? 20 : Direction::kMost;
  while (true) {
    const auto part = [&] {
      return static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(2 * most + 1))) -
             most;
    };
    const Direction d{part(), part()};
    if (d.x != 0 || d.y != 0) return d;
  }
}

Body draw_body(Random& random, std::int64_t size, std::size_t most_corners) {
  while (true) {
    std::vector<Point> points;
    const std::size_t n = 3 + random.below(most_corners - 2);
    for (std::size_t k = 0; k < n; ++k) {
      const auto part = [&] {
        return Length(
            static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(2 * size + 1))) -
            size);
      };
      points.push_back({part(), part()});
    }
    auto made = ConvexPolygon::make(convex_hull(points));
    if (made) return *std::move(made);
  }
}

/// The angle by which one turns to get from one to the other: the shorter way.
Real shorter_way(const Direction& from, const Direction& to) {
  Real angle = angle_of(to) - angle_of(from);
  const Real full = 2 * std::numbers::pi_v<Real>;
  while (angle <= -full / 2 + 1e-15L) angle += full;
  while (angle > full / 2 + 1e-15L) angle -= full;
  return angle;
}

TEST(Turned, IsExactForQuarterTurns) {
  const Body box = polygon({{3, 1}, {-2, 1}, {-2, -1}, {3, -1}});
  EXPECT_EQ(turned(box, {0, 1}).value(), polygon({{-1, -2}, {1, -2}, {1, 3}, {-1, 3}}));
  EXPECT_EQ(turned(box, {-7, 0}).value(), polygon({{-3, -1}, {2, -1}, {2, 1}, {-3, 1}}));
  EXPECT_EQ(turned(box, {0, -1}).value(), polygon({{-1, -3}, {1, -3}, {1, 2}, {-1, 2}}));
  const Body same = turned(box, {1, 0}).value();
  EXPECT_TRUE(contains(same, box) && contains(box, same));
  EXPECT_EQ(turned(Disc{5}, {3, 1}).value(), Body(Disc{5}));
}

TEST(Turned, ContainsTheBodyAndLittleMore) {
  Random random(11);
  for (std::size_t round = 0; round < support::scaled(10'000); ++round) {
    const std::int64_t size = std::int64_t{1} << (1 + random.below(38));
    const Body body = draw_body(random, size, 8);
    const Direction d = draw_direction(random);
    const Body result = turned(body, d).value();
    for (const Point& corner : corners_of(body))
      ASSERT_LE(outside(result, rotated(corner, angle_of(d))), 1e-7L) << round;
    // What is larger is so by less than a diagonal of the lattice.
    Body turned_back = turned(result, {d.x, -d.y}).value();
    for (const Point& corner : corners_of(result))
      ASSERT_LE(outside(body, rotated(corner, -angle_of(d))), 1.5L) << round;
  }
}

TEST(SweptByTurn, ContainsTheBodyAllTheWay) {
  Random random(12);
  for (std::size_t round = 0; round < support::scaled(1'000); ++round) {
    const std::int64_t size = std::int64_t{1} << (1 + random.below(38));
    const Body body = draw_body(random, size, round % 10 == 0 ? 30 : 6);
    const Direction from = draw_direction(random), to = draw_direction(random);
    const Body swept = swept_by_turn(body, from, to).value();
    ASSERT_TRUE(contains(swept, turned(body, from).value())) << round;
    ASSERT_TRUE(contains(swept, turned(body, to).value())) << round;
    const Real all = shorter_way(from, to);
    constexpr int kAngles = 300;
    for (int k = 0; k <= kAngles; ++k)
      for (const Point& corner : corners_of(body))
        ASSERT_LE(outside(swept, rotated(corner, angle_of(from) + all * k / kAngles)),
                  1e-18L * static_cast<Real>(size) + 1e-7L)
            << round << " " << k;
  }
}

TEST(SweptByTurn, IsHardlyLargerThanWhatIsSwept) {
  Random random(13);
  for (std::size_t round = 0; round < support::scaled(200); ++round) {
    const Body body = draw_body(random, 100'000, 5);
    const Direction from = draw_direction(random), to = draw_direction(random);
    const Real all = shorter_way(from, to);
    std::vector<Point> swept;
    constexpr int kAngles = 2'000;
    for (int k = 0; k <= kAngles; ++k)
      for (const Point& corner : corners_of(body)) {
        const Spot at = rotated(corner, angle_of(from) + all * k / kAngles);
        swept.push_back({Length(std::llround(at.x)), Length(std::llround(at.y))});
      }
    std::vector<Spot> least;
    for (const Point& p : convex_hull(std::move(swept))) least.push_back(rotated(p, 0));
    EXPECT_LE(area_of(swept_by_turn(body, from, to).value()), 1.02L * area_of(least) + 4'000'000)
        << round;
  }
}

TEST(SweptByTurn, OfManyCornersHasFewerOrIsADisc) {
  std::vector<Point> many;
  for (std::int64_t k = 0; k < 64; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / 64;
    many.push_back(
        {Length(std::llround(1e6 * std::cos(angle))), Length(std::llround(1e6 * std::sin(angle)))});
  }
  const Body round = polygon(many);
  for (const Direction& d : {Direction{1, 0}, Direction{3, 1}, Direction{-5, 7}}) {
    const Body result = turned(round, d).value();
    EXPECT_LE(area_of(result), 1.001L * area_of(round));
    const Body swept = swept_by_turn(round, {1, 0}, d).value();
    EXPECT_TRUE(contains(swept, result));
    EXPECT_LE(area_of(swept), 1.01L * area_of(round));
  }
}

TEST(SweptByTurn, RefusesWhatComesTooFar) {
  const Length far = kMaxLength;
  const Body corner = polygon({{far, far}, {0, 1}, {0, 0}});
  EXPECT_EQ(turned(corner, {1, 1}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(swept_by_turn(corner, {1, 0}, {0, 1}).error().code, ErrorCode::out_of_range);
  EXPECT_TRUE(turned(corner, {0, 1}).has_value());
}

TEST(Contains, IsDecidedExactly) {
  const Body box = polygon({{-4, -3}, {4, -3}, {4, 3}, {-4, 3}});
  EXPECT_TRUE(contains(box, box));
  EXPECT_TRUE(contains(box, Disc{3}));
  EXPECT_FALSE(contains(box, Disc{4}));
  EXPECT_TRUE(contains(Disc{5}, box));
  EXPECT_FALSE(contains(Disc{4}, box));
  EXPECT_TRUE(contains(Disc{5}, Disc{5}));
  EXPECT_FALSE(contains(Disc{5}, Disc{6}));
  EXPECT_FALSE(contains(box, polygon({{-4, -3}, {4, -3}, {5, 3}})));
  EXPECT_TRUE(contains(box, polygon({{-4, -3}, {4, -3}, {4, 3}})));
  // 3-4-5: the slanted side is 12 from the origin, up to nothing at all.
  EXPECT_TRUE(contains(polygon({{20, 0}, {0, 15}, {-20, 0}, {0, -15}}), Disc{12}));
  EXPECT_FALSE(contains(polygon({{20, 0}, {0, 15}, {-20, 0}, {0, -15}}), Disc{13}));
  const Length far = kMaxLength;
  EXPECT_FALSE(
      contains(polygon({{far, far}, {-far, far}, {-far, 1 - far}, {far, -far}}), Disc{far}));
  EXPECT_TRUE(contains(polygon({{far, far}, {-far, far}, {-far, -far}, {far, -far}}), Disc{far}));
  EXPECT_FALSE(contains(polygon({{9, 1}, {5, 5}, {1, 1}}), Disc{1}));  // the origin is outside
}

TEST(Direction, AnglesThatAreRoundAreExact) {
  using std::numbers::pi;
  EXPECT_EQ(Direction::at(0), (Direction{1, 0}));
  EXPECT_EQ(Direction::at(pi / 2), (Direction{0, 1}));
  EXPECT_EQ(Direction::at(-pi), (Direction{-1, 0}));
  EXPECT_EQ(Direction::at(3 * pi / 4), (Direction{-1, 1}));
  EXPECT_NEAR(static_cast<double>(angle_of(Direction::at(1.234))), 1.234, 1e-6);
}

}  // namespace
}  // namespace quadrille::geometry
