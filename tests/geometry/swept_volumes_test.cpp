// SPDX-License-Identifier: MIT
#include "quadrille/geometry/swept_volumes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>

#include "geometry/cases.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

using testing::ElementsAre;

std::vector<std::size_t> indices(const std::vector<SweptVolumes::Nearby>& near) {
  std::vector<std::size_t> list;
  for (const auto& [index, is_sure] : near) list.push_back(index);
  return list;
}

BodyPair discs(Length sum_of_radii) { return BodyPair(Disc{sum_of_radii - 1}, Disc{1}); }

TEST(SweptVolumes, FindsWhatCanCollide) {
  // A cross of two long edges, a far edge, and a place beside the first edge that may be touched.
  const std::vector<Motion> motions{{{0, 0}, {100, 0}, 100},
                                    {{50, -50}, {50, 50}, 100},
                                    {{0, 200}, {100, 200}, 100},
                                    rest({10, 20}, 1),
                                    rest({10, 19}, 1)};
  const SweptVolumes volumes(motions);
  EXPECT_THAT(indices(volumes.near(motions[0], discs(19))), ElementsAre(0, 1, 4));
  EXPECT_FALSE(volumes.near(motions[0], discs(19)).back().is_sure);  // They touch.
  EXPECT_THAT(indices(volumes.near(motions[0], discs(21))), ElementsAre(0, 1, 3, 4));
  EXPECT_TRUE(volumes.near(motions[0], discs(21)).back().is_sure);
  EXPECT_THAT(indices(volumes.near(motions[2], discs(20))), ElementsAre(2));
  EXPECT_THAT(indices(volumes.near(rest({75, 0}, 0), discs(20))), ElementsAre(0));
  EXPECT_TRUE(SweptVolumes({}).near(motions[0], discs(15)).empty());

  SweptVolumes::Tally tally;
  static_cast<void>(volumes.near({{0, 0}, {100, 100}, 10}, discs(11), &tally));
  EXPECT_EQ(tally.by_boxes, 1u);  // The far edge.
  EXPECT_EQ(tally.apart, 0u);
  EXPECT_EQ(tally.sure, 4u);
}

// Whatever can collide is found, and what is said to be sure can.
void expect_agreement(const SweptVolumes& volumes, const Motion& motion, const Body& own,
                      const Body& other, SweptVolumes::Tally& tally) {
  const BodyPair pair(own, other);
  const auto near = volumes.near(motion, pair, &tally);
  std::size_t next = 0;
  for (std::size_t k = 0; k < volumes.motions().size(); ++k) {
    const bool is_found = next < near.size() && near[next].index == k;
    const bool is_sure = is_found && near[next].is_sure;
    if (is_found) ++next;
    const bool can_meet = pair.can_meet(motion, volumes.motions()[k]);
    ASSERT_TRUE(is_found || !can_meet) << k << " is missing";
    ASSERT_TRUE(can_meet || !is_sure) << k << " is not sure";
  }
  ASSERT_EQ(next, near.size());
}

TEST(SweptVolumes, AgreeWithAskingEachPair) {
  SweptVolumes::Tally tally;
  for (int seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(static_cast<std::uint64_t>(seed));
    // Bodies and motions of many cases; sometimes as large as can be.
    const auto generate = [&] {
      return seed % 4 == 0   ? hard_bodies(random)
             : seed % 4 == 1 ? small_bodies(random)
             : seed % 4 == 2 ? hard_discs(random)
                             : hard_balls(random);
    };
    const Case bodies = generate();
    std::vector<Motion> motions;
    for (int i = 0; i < 60; ++i) {
      const Case one = generate();
      motions.push_back(one.a);
      motions.push_back(one.b);
    }
    const SweptVolumes volumes(motions);
    for (const Motion& motion : motions)
      expect_agreement(volumes, motion, bodies.body_a, bodies.body_b, tally);
  }
  for (const std::size_t count :
       {tally.by_boxes, tally.apart, tally.by_nearest, tally.sure, tally.doubtful})
    EXPECT_GT(count, 1000u);
  EXPECT_GT(tally.by_hulls, 100u);
}

// Lines that are nearly parallel are what FCL's closed form is worst at.
TEST(SweptVolumes, NearlyParallelLines) {
  SweptVolumes::Tally tally;
  for (int seed = 0; seed < 6000; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(static_cast<std::uint64_t>(seed));
    const Length size{std::int64_t{1} << (20 + random.below(18))};
    const Point along{draw(random, -size, size), draw(random, -size, size)};
    const auto nudge = [&] { return draw(random, -3, 3); };
    const Length aside = draw(random, 0, size / 64);
    const Motion a{{0, 0}, along, 1 << 20};
    const Motion b{{nudge(), aside}, {along.x + nudge(), along.y + aside + nudge()}, 1 << 20};
    if (a.is_rest() || b.is_rest()) continue;
    const std::size_t turn = random.below(9);  // Where below 6: in space.
    // Discs whose reach is about as large as the lines are apart.
    const double exact =
        std::abs(static_cast<double>(along.x.value())) /
        std::hypot(static_cast<double>(along.x.value()), static_cast<double>(along.y.value())) *
        static_cast<double>(aside.value());
    const Length radius =
        std::max(Length{1}, Length(static_cast<std::int64_t>(exact / 2)) + nudge());
    Case c{Disc{radius}, a, Disc{radius}, b};
    if (turn < 6) c = turned(c, turn);
    if (turn < 3) c.b.to.z += nudge();
    expect_agreement(SweptVolumes({c.b}), c.a, c.body_a, c.body_b, tally);
  }
  EXPECT_GT(tally.doubtful, 1000u);
}

}  // namespace
}  // namespace quadrille::geometry
