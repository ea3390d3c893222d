// SPDX-License-Identifier: MIT
#include "swept_shapes.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <variant>

#include "geometry/cases.hpp"
#include "grown_shape.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "quadrille/geometry/swept_volumes.hpp"
#include "support/environment.hpp"

namespace quadrille::geometry {
namespace {

Length radius_of(const Body& body) {
  const auto* disc = std::get_if<Disc>(&body);
  return disc != nullptr ? disc->radius : Length{0};
}

/// A triangle so thin that its corners are almost on a line, or a polygon with nothing special.
Body some_polygon(support::Random& random, Length size) {
  if (random.percent(50) || size < Length{8}) return random_polygon(random, size);
  const Point far{size, draw(random, -size, size)};
  const Point middle{far.x / 2, far.y / 2 + draw(random, 1, std::max(Length{1}, size / 1000))};
  return ConvexPolygon::make({{0, 0}, far, middle}).value();
}

/// Bodies about as large as their motions are long and far from each other, at some scale.
Case some_case(support::Random& random) {
  const Length size{std::int64_t{8} << random.below(35)};
  const auto place = [&] { return Point{draw(random, -size, size), draw(random, -size, size)}; };
  const auto motion = [&] {
    const Point from = place();
    return random.percent(15) ? rest(from, 1) : Motion{from, place(), 100};
  };
  const auto body = [&](bool is_disc) -> Body {
    const Length least = std::max(Length{3}, size / 50);
    const Length radius = draw(random, least, std::max(least, size / 3));
    if (is_disc) return Disc{radius};
    return some_polygon(random, radius);
  };
  const std::size_t which = random.below(3);
  Case c{body(which == 1), motion(), body(which == 2), motion()};
  if (c.a.from == c.a.to) c.a.duration = 1;
  return c;
}

// Whatever direction is asked about, by FCL or not: what it proves is true.
TEST(SweptShapes, NeverApartIfTheyCanMeet) {
  std::size_t num_apart = 0, num_by_fcl = 0, num_meeting = 0;
  for (std::size_t seed = 0; seed < support::scaled(20000); ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    const Case c = seed % 2 == 0 ? some_case(random) : hard_bodies(random);
    const bool can_meet = BodyPair(c.body_a, c.body_b).can_meet(c.a, c.b);
    const std::vector<Point> corners = grown_corners(c.body_a, c.body_b);
    SweptHull hull(c.a, corners, radius_of(c.body_a) + radius_of(c.body_b));
    const bool by_fcl = hull.clearance(c.b, hull.direction(c.b)) >= 0;
    const SweptLine a(c.a, c.a.from), b(c.b, c.a.from);
    const Vec3 between = distance(a, b).between;
    const bool by_lines = hull.clearance(c.b, {between.x, between.y}) >= 0;
    const Vec any{static_cast<double>(random.below(2001)) - 1000,
                  static_cast<double>(random.below(2001)) - 1000};
    const bool by_chance = hull.clearance(c.b, any) >= 0;
    ASSERT_FALSE(can_meet && (by_fcl || by_lines || by_chance)) << c;
    can_meet ? ++num_meeting : ++num_apart;
    if (by_fcl) ++num_by_fcl;
  }
  EXPECT_GT(num_meeting, num_apart / 10);
  // The rest touches, or comes as near as rounding or FCL's tolerance.
  EXPECT_GT(num_by_fcl, num_apart * 8 / 10);
  RecordProperty("apart", static_cast<int>(num_apart));
  RecordProperty("by_fcl", static_cast<int>(num_by_fcl));
}

// A corner is as near to a long line as integers can be: 2^-38 length units to either side, far
// less than doubles tell apart at such coordinates.
TEST(SweptShapes, RoundingIsOnTheSafeSide) {
  std::size_t num_tried = 0, num_apart = 0;
  for (std::size_t seed = 0; seed < support::scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    const Length least{std::int64_t{1} << 37};
    const auto long_way = [&] { return draw(random, least, 2 * least); };
    const Point step{long_way(), long_way()}, from{draw(random, -least, least), long_way()};
    if (std::gcd(step.x.value(), step.y.value()) != 1) continue;
    ++num_tried;
    const Motion line{from, from + step, 1};
    const Point left = left_of(step), wide{step.x / 8, step.y / 8}, out{-step.y / 4, step.x / 4};
    const auto is_apart = [&](const Point& corner) {  // of a triangle that else is far to the left
      const std::vector<Point> corners{corner, corner + out - wide, corner + out + wide};
      return SweptHull(rest({0, 0}, 1), corners, 0).clearance(line, to_vec({step.y, -step.x})) >= 0;
    };
    ASSERT_FALSE(is_apart(from + step - left));
    if (is_apart(from + left + Point{-step.y / 1000, step.x / 1000})) ++num_apart;
  }
  EXPECT_GT(num_tried, 100u);
  EXPECT_EQ(num_apart, num_tried);
}

// A disc that would still pass if it were larger by a thousandth of all lengths is never in doubt.
TEST(SweptShapes, WhatIsClearlyApartIsSettled) {
  SweptVolumes::Tally tally;
  std::size_t num_clear = 0;
  for (std::size_t seed = 0; seed < support::scaled(20000); ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    Case c = some_case(random);
    if (!std::holds_alternative<Disc>(c.body_b)) c.body_b = Disc{enclosing_radius(c.body_b)};
    if (std::holds_alternative<Disc>(c.body_a))
      c.body_a = some_polygon(random, std::max(Length{3}, std::get<Disc>(c.body_a).radius));
    const Length radius = std::get<Disc>(c.body_b).radius;
    const Length size = extent(c.b.from - c.a.from) + extent(c.a.to - c.a.from) +
                        extent(c.b.to - c.b.from) + radius + enclosing_radius(c.body_a);
    const BodyPair larger(c.body_a, Disc{radius + std::max(Length{1}, size / 1000)});
    if (larger.can_meet(c.a, c.b)) continue;
    ++num_clear;
    ASSERT_TRUE(SweptVolumes({c.b}).near(c.a, BodyPair(c.body_a, c.body_b), &tally).empty()) << c;
  }
  EXPECT_GT(num_clear, support::scaled(20000) / 10);
  EXPECT_GT(tally.by_hulls, support::scaled(20000) / 1000);
}

}  // namespace
}  // namespace quadrille::geometry
