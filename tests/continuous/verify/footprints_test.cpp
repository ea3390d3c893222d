// SPDX-License-Identifier: MIT
#include "verify/footprints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "geometry/oracle.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

/// A motion of b past a, which rests, during `kTicks` ticks.
struct Case {
  Body a, b;
  Point from, to;
};
constexpr Ticks kTicks{7};

Case draw_case(std::uint32_t seed) {
  Draw draw(seed);
  RandomOptions options;
  options.shapes_percent = 0;
  options.num_agents = 2;
  options.polygon_percent = 70;
  const Instance instance = random_instance(seed, options);
  const Body &a = instance.agent(AgentId(0)).body, &b = instance.agent(AgentId(1)).body;
  const bool in_space =
      std::holds_alternative<Disc>(a) && std::holds_alternative<Disc>(b) && draw.chance(35);
  const auto place = [&] {
    return Point{draw.length(-20, 20), draw.length(-20, 20),
                 in_space ? draw.length(-15, 15) : Length{0}};
  };
  const Point from = place();
  return {a, b, from, draw.chance(15) ? from : place()};
}

ExactStep exact(const Case& c, std::int64_t scale) {
  const auto at = [&](const Point& p) {
    return ExactPoint{scale * p.x.value(), scale * p.y.value(), scale * p.z.value()};
  };
  return {at(c.from), at(c.to), Integer(scale)};
}

RealStep real(const Case& c) {
  const auto at = [](const Point& p) {
    return RealPoint{static_cast<long double>(p.x.value()), static_cast<long double>(p.y.value()),
                     static_cast<long double>(p.z.value())};
  };
  return {at(c.from), at(c.to)};
}

TEST(Footprints, MeetWhenGeometryAndTheOracleSaySo) {
  int meeting = 0, apart = 0, touching = 0, high = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(20'000); ++seed) {
    const Case c = draw_case(seed);
    SCOPED_TRACE(seed);
    if (c.from.z != 0) ++high;
    const FootprintPair pair(c.a, c.b);
    const geometry::Motion rest{{0, 0}, {0, 0}, kTicks}, motion{c.from, c.to, kTicks};
    const bool meet = pair.interiors_meet(exact(c, 1));
    using Oracle = geometry::oracle::Oracle<geometry::oracle::SmallInteger>;
    ASSERT_EQ(meet, Oracle(c.a, rest, c.b, motion).collide(0));
    ASSERT_EQ(meet, geometry::BodyPair(c.a, c.b).collide(rest, motion, 0));
    ASSERT_EQ(meet, pair.interiors_meet(exact(c, 12'345)));
    // The gap in floating point, which polygons of geometry/ do not have when they overlap.
    const auto near = pair.nearest(real(c));
    ASSERT_GE(near.share, 0);
    ASSERT_LE(near.share, 1);
    ASSERT_LE(pair.least_gap(real(c)), near.gap + 1e-12L);
    // At that moment it is as small as that, and at no other one smaller.
    const auto gap_at = [&](long double share) {
      const auto [from, to] = real(c);
      const RealPoint at{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                         from.z + share * (to.z - from.z)};
      return pair.nearest({at, at}).gap;
    };
    ASSERT_NEAR(static_cast<double>(gap_at(near.share) - near.gap), 0, 1e-12);
    for (int k = 0; k <= 20; ++k) ASSERT_GE(gap_at(k / 20.0L), near.gap - 1e-12L);
    const auto gap = geometry::BodyPair(c.a, c.b).gap(rest, motion, 0).value();
    if (meet) {
      ASSERT_LT(near.gap, 0);
    } else {
      ASSERT_GE(near.gap, -1e-12L);
      ASSERT_NEAR(static_cast<double>(near.gap), gap.at_most, 1e-9);
    }
    ++(meet ? meeting : std::abs(near.gap) < 1e-9L ? touching : apart);
  }
  EXPECT_GT(meeting, 100);
  EXPECT_GT(apart, 100);
  EXPECT_GT(touching, 5);
  EXPECT_GT(high, 100);
}

/// The depth of an overlap is what a body has to be moved by.
TEST(Footprints, OverlapIsThePushThatSeparates) {
  const Body square = ConvexPolygon::make({{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}).value();
  const Body disc = Disc{3};
  const auto gap = [](const Body& a, const Body& b, long double x, long double y) {
    return static_cast<double>(FootprintPair(a, b).nearest({{x, y}, {x, y}}).gap);
  };
  EXPECT_NEAR(gap(square, square, 8, 1), -2, 1e-12);
  EXPECT_NEAR(gap(square, square, 10, 1), 0, 1e-12);
  EXPECT_NEAR(gap(square, square, 13, 14), 5, 1e-12);
  EXPECT_NEAR(gap(square, disc, 7, 2), -1, 1e-12);
  EXPECT_NEAR(gap(disc, square, -7, 2), -1, 1e-12);
  EXPECT_NEAR(gap(square, disc, 8, 9), 2, 1e-12);
  EXPECT_NEAR(gap(disc, disc, 3, 4), -1, 1e-12);
  const RealPoint above{1, 2, 2};
  EXPECT_NEAR(static_cast<double>(FootprintPair(disc, disc).nearest({above, above}).gap), -3,
              1e-12);
}

/// Ways that cut a sliver far from its corners: both ends are outside, and all corners far away.
TEST(Footprints, ThinBodiesAreNotJumpedOver) {
  for (std::uint32_t seed = 0; seed < support::scaled(2'000); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const Length size{std::int64_t{1} << draw.length(4, 39).value()};
    // The third corner is a length unit or less beside the other side.
    const Point far{size, draw.length(-5, 5)}, middle{far.x / 2, far.y / 2 + 1};
    const auto sliver = ConvexPolygon::make({{0, 0}, far, middle});
    ASSERT_TRUE(sliver);
    const auto beside = [&](std::int64_t sign) {
      return Point{draw.length(size / 4, 3 * (size / 4)), sign * draw.length(10, size)};
    };
    const Case c{*sliver, Disc{1}, beside(1), beside(-1)};
    const FootprintPair pair(c.a, c.b);
    ASSERT_TRUE(pair.interiors_meet(exact(c, 1)));
    ASSERT_LT(pair.nearest(real(c)).gap, 0.5L);
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
