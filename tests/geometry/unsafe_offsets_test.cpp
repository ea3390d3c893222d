// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numeric>

#include "exact/exact.hpp"
#include "geometry/cases.hpp"
#include "geometry/oracle.hpp"
#include "grown_shape.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

using oracle::BigInteger;
using oracle::Oracle;
using oracle::SmallInteger;
using Offsets = std::optional<TickInterval>;

ConvexPolygon square(Length half) {
  return ConvexPolygon::make({{-half, -half}, {half, -half}, {half, half}, {-half, half}}).value();
}

TEST(UnsafeOffsets, CrossingAtARightAngle) {
  const Motion east{{-100, 0}, {100, 0}, 200};
  const Motion north{{0, -100}, {0, 100}, 200};
  // Both at speed 1: with b late by d, the closest approach is |d| / sqrt(2) < 20 iff |d| <= 28.
  EXPECT_EQ(unsafe_offsets(Disc{10}, east, Disc{10}, north),
            Offsets(TickInterval::closed(-28, 28)));
  // The squares meet while |t| < 20 and |t - d| < 20.
  EXPECT_EQ(unsafe_offsets(square(10), east, square(10), north),
            Offsets(TickInterval::closed(-39, 39)));
}

TEST(UnsafeOffsets, FollowingAtEqualSpeedMayTouch) {
  const Motion first{{0, 0}, {1000, 0}, 1000};
  EXPECT_EQ(unsafe_offsets(Disc{10}, first, Disc{5}, first),
            Offsets(TickInterval::closed(-14, 14)));
  EXPECT_EQ(unsafe_offsets(square(10), first, square(5), first),
            Offsets(TickInterval::closed(-14, 14)));
  EXPECT_EQ(unsafe_offsets(square(10), first, Disc{5}, first),
            Offsets(TickInterval::closed(-14, 14)));
  // The next edge of the same line, at the same speed: b must be 15 behind or ahead.
  const Motion next{{1000, 0}, {2000, 0}, 1000};
  EXPECT_EQ(unsafe_offsets(Disc{10}, first, Disc{5}, next),
            Offsets(TickInterval::closed(986, 1000)));
}

TEST(UnsafeOffsets, PassingAtExactlyTheSumOfTheRadiiIsAllowed) {
  const Motion east{{0, 0}, {30, 40}, 7};
  const Motion back{{-4 * 5 + 30, 3 * 5 + 40}, {-4 * 5, 3 * 5}, 9};  // 25 to the left.
  EXPECT_EQ(unsafe_offsets(Disc{12}, east, Disc{13}, back), std::nullopt);
  EXPECT_FALSE(BodyPair(Disc{12}, Disc{13}).can_meet(east, back));
  EXPECT_EQ(unsafe_offsets(Disc{13}, east, Disc{13}, back), Offsets(TickInterval::closed(-9, 7)));
  EXPECT_TRUE(BodyPair(Disc{13}, Disc{13}).can_meet(east, back));
}

TEST(UnsafeOffsets, SquaresSideBySideOnAGrid) {
  const auto unit = ConvexPolygon::make({{0, 0}, {10, 0}, {10, 10}, {0, 10}}).value();
  const Motion lower{{0, 0}, {10, 0}, 10};
  EXPECT_EQ(unsafe_offsets(unit, lower, unit, {{0, 10}, {10, 10}, 10}), std::nullopt);
  EXPECT_EQ(unsafe_offsets(unit, lower, unit, {{10, 10}, {0, 10}, 3}), std::nullopt);
  EXPECT_FALSE(BodyPair(unit, unit).can_meet(lower, {{0, 10}, {10, 10}, 10}));
  EXPECT_TRUE(BodyPair(unit, unit).can_meet(lower, {{0, 9}, {10, 9}, 10}));
  // Side by side along a slope, where no box tells them apart.
  const auto tile = ConvexPolygon::make({{0, 0}, {4, 3}, {1, 7}, {-3, 4}}).value();
  const Motion slope{{0, 0}, {40, 30}, 10};
  EXPECT_FALSE(BodyPair(tile, tile).can_meet(slope, {{-3, 4}, {37, 34}, 10}));
  EXPECT_FALSE(BodyPair(tile, tile).can_meet(slope, {{3, -4}, {43, 26}, 10}));
  EXPECT_TRUE(BodyPair(tile, tile).can_meet(slope, {{3, -4}, {43, 27}, 10}));
  EXPECT_TRUE(BodyPair(tile, tile).can_meet(slope, {{-3, 4}, {37, 33}, 10}));
  // A corner on a slope that has no parallel: a single direction tells them apart.
  const auto wedge = ConvexPolygon::make({{0, 0}, {8, 0}, {0, 6}}).value();
  EXPECT_FALSE(BodyPair(wedge, unit).can_meet(rest({0, 0}, 1), rest({4, 3}, 1)));
  EXPECT_FALSE(BodyPair(unit, wedge).can_meet(rest({4, 3}, 1), rest({0, 0}, 1)));
  EXPECT_TRUE(BodyPair(wedge, unit).can_meet(rest({0, 0}, 1), rest({4, 2}, 1)));
  EXPECT_EQ(unsafe_offsets(tile, slope, tile, {{-3, 4}, {37, 34}, 10}), std::nullopt);
  EXPECT_EQ(unsafe_offsets(unit, lower, unit, {{0, 9}, {10, 9}, 10}),
            Offsets(TickInterval::closed(-9, 9)));
}

TEST(UnsafeOffsets, OnlyAtOneEnd) {
  // b starts where a arrives, and is away at once: only the very moment at which a's motion ends
  // and b's begins has both in reach.
  const Motion a{{0, 0}, {100, 0}, 10};
  const Motion b{{119, 0}, {1119, 0}, 10};
  EXPECT_EQ(unsafe_offsets(Disc{10}, a, Disc{10}, b), Offsets(TickInterval::closed(10, 10)));
  EXPECT_EQ(unsafe_offsets(Disc{10}, a, Disc{10}, {{120, 0}, {1120, 0}, 10}), std::nullopt);
}

TEST(UnsafeOffsets, RunShorterThanATick) {
  // Both are at the crossing for a moment only: the contact is a whole number of ticks late.
  const Motion a{{-1000, 0}, {1000, 0}, 2};
  const Motion b{{0, -1500}, {0, 500}, 2};  // Half a tick late.
  EXPECT_EQ(unsafe_offsets(Disc{10}, a, Disc{10}, b), std::nullopt);
  EXPECT_TRUE(BodyPair(Disc{10}, Disc{10}).can_meet(a, b));
  EXPECT_EQ(unsafe_offsets(square(10), a, square(10), b), std::nullopt);
  EXPECT_TRUE(BodyPair(square(10), square(10)).can_meet(a, b));
  EXPECT_EQ(unsafe_offsets(Disc{10}, a, Disc{10}, {{0, -1000}, {0, 1000}, 2}),
            Offsets(TickInterval::closed(0, 0)));
}

// Everything by hand for small numbers: each offset is tried.
template <class Int, class Generator>
void every_offset(Generator generate, int count) {
  int unsafe_cases = 0;
  for (int seed = 0; seed < count; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = generate(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    const Oracle<Int> oracle(c.body_a, c.a, c.body_b, c.b);
    const BodyPair pair(c.body_a, c.body_b);
    const Offsets offsets = pair.unsafe_offsets(c.a, c.b);
    if (offsets) ++unsafe_cases;
    for (Ticks d = -c.b.duration - 2; d <= c.a.duration + 2; ++d) {
      const bool expected = oracle.collide(d);
      ASSERT_EQ(offsets && offsets->contains(d), expected) << "offset " << d;
      ASSERT_EQ(pair.collide(c.a, c.b, d), expected) << "offset " << d;
      ASSERT_TRUE(!expected || pair.can_meet(c.a, c.b));
    }
  }
  EXPECT_GT(unsafe_cases, count / 5);
  EXPECT_LT(unsafe_cases, count - count / 10);
}

TEST(UnsafeOffsets, EveryOffsetOfSmallDiscs) { every_offset<SmallInteger>(small_discs, 8000); }
TEST(UnsafeOffsets, EveryOffsetOfSmallBodies) { every_offset<SmallInteger>(small_bodies, 4000); }
TEST(UnsafeOffsets, EveryOffsetOfSmallBalls) { every_offset<BigInteger>(small_balls, 3000); }

// For large discs only: whether any offset is unsafe, by ternary search on the convex distance.
bool any_unsafe(const Oracle<BigInteger>& oracle, const Case& c) {
  Ticks low = -c.b.duration;
  Ticks high = c.a.duration;
  while (high - low > 2) {
    const Ticks first = low + (high - low) / 3;
    const Ticks second = high - (high - low) / 3;
    const auto distance_first = oracle.squared_distance(first);
    const auto distance_second = oracle.squared_distance(second);
    // Where they are equal there is a minimum between them.
    if (!Oracle<BigInteger>::less(distance_first, distance_second)) low = first;
    if (!Oracle<BigInteger>::less(distance_second, distance_first)) high = second;
  }
  for (Ticks d = low; d <= high; ++d)
    if (oracle.collide(d)) return true;
  return false;
}

// At both ends of the run: the last unsafe offset is unsafe and the next one is not. The offsets
// are one run, which the small cases show.
void expect_ends(const Oracle<BigInteger>& oracle, const TickInterval& run) {
  ASSERT_LE(run.first(), run.last());
  EXPECT_TRUE(oracle.collide(run.first()));
  EXPECT_TRUE(oracle.collide(run.last()));
  EXPECT_FALSE(oracle.collide(run.first() - 1));
  EXPECT_FALSE(oracle.collide(run.last() + 1));
}

void expect_symmetric(const Case& c, const BodyPair& pair, const Offsets& offsets) {
  const Offsets mirrored = pair.swapped().unsafe_offsets(c.b, c.a);
  ASSERT_EQ(mirrored.has_value(), offsets.has_value());
  if (offsets) {
    EXPECT_EQ(mirrored->first(), -offsets->last());
    EXPECT_EQ(mirrored->last(), -offsets->first());
  }
  EXPECT_EQ(pair.can_meet(c.a, c.b), pair.swapped().can_meet(c.b, c.a));
}

template <class Generator>
void expect_agreement(Generator generate, int count) {
  int unsafe_cases = 0;
  for (int seed = 0; seed < count; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = generate(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    ASSERT_TRUE(is_valid(c.a) && is_valid(c.b));
    const Oracle<BigInteger> oracle(c.body_a, c.a, c.body_b, c.b);
    const BodyPair pair(c.body_a, c.body_b);
    const Offsets offsets = pair.unsafe_offsets(c.a, c.b);
    if (offsets) {
      ++unsafe_cases;
      expect_ends(oracle, *offsets);
      EXPECT_TRUE(pair.can_meet(c.a, c.b));
    } else {
      EXPECT_FALSE(any_unsafe(oracle, c));
    }
    expect_symmetric(c, pair, offsets);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(unsafe_cases, count / 4);
  EXPECT_LT(unsafe_cases, count - count / 12);
}

TEST(UnsafeOffsets, HardDiscsAgreeWithTheOracle) { expect_agreement(hard_discs, 12000); }
TEST(UnsafeOffsets, HardBallsAgreeWithTheOracle) { expect_agreement(hard_balls, 8000); }

TEST(UnsafeOffsets, HardBodiesAgreeWithTheOracle) {
  for (int seed = 0; seed < 3000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = hard_bodies(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    ASSERT_TRUE(is_valid(c.a) && is_valid(c.b));
    const Oracle<BigInteger> oracle(c.body_a, c.a, c.body_b, c.b);
    const BodyPair pair(c.body_a, c.body_b);
    const Offsets offsets = pair.unsafe_offsets(c.a, c.b);
    if (offsets) {
      expect_ends(oracle, *offsets);
      EXPECT_TRUE(pair.can_meet(c.a, c.b));
    } else {
      for (int i = 0; i < 40; ++i)
        EXPECT_FALSE(oracle.collide(draw_ticks(random, -c.b.duration, c.a.duration)));
      for (Ticks d : {-c.b.duration, Ticks{-1}, Ticks{0}, Ticks{1}, c.a.duration})
        EXPECT_FALSE(oracle.collide(d));
    }
    expect_symmetric(c, pair, offsets);
    if (testing::Test::HasFailure()) return;
  }
}

// Triangles on two sides of a long line, over which one of them is by 2^-38 length units, or by as
// much on its own side: far less than doubles tell apart at such coordinates.
TEST(UnsafeOffsets, RoundingIsOnTheSafeSide) {
  int num_tried = 0;
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(static_cast<std::uint64_t>(seed));
    const Length least{std::int64_t{1} << 37};
    const Point step{draw(random, least, 2 * least), draw(random, least, 2 * least)};
    if (std::gcd(step.x.value(), step.y.value()) != 1) continue;
    ++num_tried;
    const auto at = [&](std::int64_t along, std::int64_t left) {  // in 64ths of the step
      return Point{Length((along * step.x.value() - left * step.y.value()) / 64),
                   Length((along * step.y.value() + left * step.x.value()) / 64)};
    };
    const Body right = ConvexPolygon::make({{0, 0}, at(-8, -16), at(8, -16)}).value();
    const Point over = left_of(step);
    const auto minus = [](const Point& p, const Point& q) { return Point{p.x - q.x, p.y - q.y}; };
    // Beside a side, at rest.
    const Body left = ConvexPolygon::make({{0, 0}, step, at(32, 16)}).value();
    const BodyPair side(left, right);
    ASSERT_TRUE(side.overlap({0, 0}, over));
    ASSERT_FALSE(side.overlap({0, 0}, minus(step, over)));
    // Past a corner.
    const BodyPair corner(ConvexPolygon::make({{0, 0}, at(8, 16), at(-8, 16)}).value(), right);
    const Motion stays = rest({0, 0}, 1000);
    ASSERT_TRUE(corner.collide(stays, {minus(over, step), over, 1000}, 0));
    ASSERT_FALSE(corner.collide(stays, {minus({0, 0}, over), minus(step, over), 1000}, 0));
  }
  EXPECT_GT(num_tried, 100);
}

// The search that the closed form makes unnecessary nearly always.
TEST(UnsafeOffsets, ExactSearchFindsAnOffsetIfThereIsOne) {
  for (int seed = 0; seed < 2000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = seed % 2 == 0 ? hard_discs(random) : hard_bodies(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    const auto radius = [](const Body& body) {
      return std::holds_alternative<Disc>(body) ? std::get<Disc>(body).radius : Length{0};
    };
    const Length reach = radius(c.body_a) + radius(c.body_b);
    const std::optional<Ticks> found =
        exact::find_meeting(c.a, c.b, grown_corners(c.body_a, c.body_b), reach);
    const Offsets offsets = unsafe_offsets(c.body_a, c.a, c.body_b, c.b);
    ASSERT_EQ(found.has_value(), offsets.has_value());
    if (found) {
      ASSERT_LE(offsets->first(), *found);
      ASSERT_GE(offsets->last(), *found);
    }
  }
}

}  // namespace
}  // namespace quadrille::geometry
