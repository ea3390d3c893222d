// SPDX-License-Identifier: MIT
#include "quadrille/geometry/encounter.hpp"

#include <gtest/gtest.h>

#include <map>

#include "geometry/cases.hpp"
#include "geometry/oracle.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "support/environment.hpp"

namespace quadrille::geometry {
namespace {

Leg leg(const Motion& motion, Ticks begin) {
  return {motion.from, motion.to, begin, begin + motion.duration};
}

Length extent_of(const Case& c) {
  Length extent = 0;
  for (const Point& p : {c.a.from, c.a.to, c.b.from, c.b.to})
    extent = std::max({extent, abs(p.x), abs(p.y), abs(p.z)});
  return extent;
}

Encounter look(const Case& c, Ticks offset) {
  return EncounterCheck(c.body_a, c.body_b, extent_of(c)).look(leg(c.a, 0), leg(c.b, offset));
}

const ConvexPolygon kSquare =
    ConvexPolygon::make({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}).value();

TEST(Encounter, DiscsThatPass) {
  const Disc disc{10};
  const auto pass = [&](Length beside) {
    return look({disc, {{0, 0}, {100, 0}, 100}, disc, {{100, beside}, {0, beside}, 100}}, 0);
  };
  EXPECT_EQ(pass(19), Encounter::collision);
  EXPECT_EQ(pass(20), Encounter::touch);
  EXPECT_EQ(pass(21), Encounter::clear);
  EXPECT_EQ(pass(-21), Encounter::clear);
  EXPECT_EQ(pass(0), Encounter::collision);
}

TEST(Encounter, PolygonsThatPass) {
  const auto pass = [&](const Body& a, const Body& b, Length beside) {
    return look({a, {{0, 0}, {100, 0}, 100}, b, {{100, beside}, {0, beside}, 100}}, 0);
  };
  for (const Body& other : {Body(kSquare), Body(Disc{10})}) {
    EXPECT_EQ(pass(kSquare, other, 19), Encounter::collision);
    EXPECT_EQ(pass(kSquare, other, 20), Encounter::touch);
    EXPECT_EQ(pass(kSquare, other, 21), Encounter::clear);
    EXPECT_EQ(pass(other, kSquare, -20), Encounter::touch);
    EXPECT_EQ(pass(other, kSquare, 0), Encounter::collision);
  }
}

TEST(Encounter, BallsThatPass) {
  const auto pass = [](Length beside, Length above) {
    return look({Disc{10},
                 {{0, 0}, {0, 0, 100}, 100},
                 Disc{15},
                 {{beside, above, 100}, {beside, above, 0}, 100}},
                0);
  };
  EXPECT_EQ(pass(15, 19), Encounter::collision);
  EXPECT_EQ(pass(15, 20), Encounter::touch);
  EXPECT_EQ(pass(15, 21), Encounter::clear);
}

TEST(Encounter, OnlyCommonMomentsCount) {
  const EncounterCheck check(Disc{10}, kSquare, 100);
  const Leg a{{0, 0}, {100, 0}, 0, 100};
  EXPECT_EQ(check.look(a, {{100, 0}, {100, 0}, 0, 80}), Encounter::touch);
  EXPECT_EQ(check.look(a, {{100, 0}, {100, 0}, 0, 81}), Encounter::collision);
  EXPECT_EQ(check.look(a, {{100, 0}, {100, 0}, 101, 200}), Encounter::clear);
  EXPECT_EQ(check.look(a, {{100, 0}, {100, 0}, 100, 100}), Encounter::collision);
  EXPECT_EQ(check.look(a, {{0, 0}, {0, 0}, 20, 20}), Encounter::touch);
}

// Seconds in nanoseconds, and a stay to the end of all plans.
TEST(Encounter, LongStays) {
  const Ticks day{std::int64_t{86'400'000'000'000}};
  const EncounterCheck check(Disc{300}, Disc{300}, 100'000);
  const Leg stay{{50'000, 0}, {50'000, 0}, 5, Ticks{std::int64_t{1} << 60}};
  EXPECT_EQ(check.look({{0, 599}, {100'000, 599}, day, day + 100}, stay), Encounter::collision);
  EXPECT_EQ(check.look({{0, 601}, {100'000, 601}, day, day + 100}, stay), Encounter::clear);
}

/// Holds all answers about a case against the exact ones. Returns what it saw.
void compare(const Case& c, Ticks offset, bool exact, std::map<Encounter, int>& seen) {
  const EncounterCheck check(c.body_a, c.body_b, extent_of(c));
  const Encounter encounter = check.look(leg(c.a, 0), leg(c.b, offset));
  ++seen[encounter];
  EXPECT_EQ(check.look(leg(c.a, 1000), leg(c.b, 1000 + offset)), encounter);
  EXPECT_NE(encounter, exact ? Encounter::clear : Encounter::collision);
  const auto gap = BodyPair(c.body_a, c.body_b).gap(c.a, c.b, offset);
  if (gap && gap->at_least > check.tolerance()) {
    EXPECT_EQ(encounter, Encounter::clear) << gap->at_least << " > " << check.tolerance();
  }
}

TEST(Encounter, AgreesWithTheOracle) {
  std::map<Encounter, int> seen;
  const int num_seeds = static_cast<int>(support::scaled(4000));
  int exact_touches = 0;
  for (int seed = 0; seed < num_seeds; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = seed % 3 == 0   ? small_discs(random)
                   : seed % 3 == 1 ? small_bodies(random)
                                   : small_balls(random);
    for (int k = 0; k < 4; ++k) {
      const Ticks offset = draw_ticks(random, -c.b.duration, c.a.duration);
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", offset " << offset << ": " << c);
      const bool exact =
          oracle::Oracle<oracle::BigInteger>(c.body_a, c.a, c.body_b, c.b).collide(offset);
      compare(c, offset, exact, seen);
      const auto gap = BodyPair(c.body_a, c.body_b).gap(c.a, c.b, offset);
      if (!exact && gap && gap->at_most < 1e-9) ++exact_touches;
      if (HasFailure()) return;
    }
  }
  // Numbers are small: nothing comes near the tolerance that does not touch.
  EXPECT_EQ(seen[Encounter::touch], exact_touches);
  EXPECT_GT(seen[Encounter::clear], num_seeds);
  EXPECT_GT(seen[Encounter::collision], num_seeds);
}

TEST(Encounter, IsNeverWrongAboutHardCases) {
  std::map<Encounter, int> seen;
  const int num_seeds = static_cast<int>(support::scaled(6000));
  for (int seed = 0; seed < num_seeds; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = seed % 3 == 0   ? hard_discs(random)
                   : seed % 3 == 1 ? hard_bodies(random)
                                   : hard_balls(random);
    const Ticks offset = draw_ticks(random, -c.b.duration, c.a.duration);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", offset " << offset << ": " << c);
    const bool exact =
        oracle::Oracle<oracle::BigInteger>(c.body_a, c.a, c.body_b, c.b).collide(offset);
    compare(c, offset, exact, seen);
    if (HasFailure()) return;
  }
  EXPECT_GT(seen[Encounter::clear], num_seeds / 5);
  EXPECT_GT(seen[Encounter::collision], num_seeds / 5);
}

}  // namespace
}  // namespace quadrille::geometry
