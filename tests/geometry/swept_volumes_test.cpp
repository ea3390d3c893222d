// SPDX-License-Identifier: MIT
#include "quadrille/geometry/swept_volumes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/cases.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

using testing::ElementsAre;

TEST(SweptVolumes, FindsWhatCanCollide) {
  // A cross of two long edges, a far edge, and a place beside the first edge that may be touched.
  const std::vector<Motion> motions{{{0, 0}, {100, 0}, 100},
                                    {{50, -50}, {50, 50}, 100},
                                    {{0, 200}, {100, 200}, 100},
                                    rest({10, 20}, 1),
                                    rest({10, 19}, 1)};
  const SweptVolumes volumes(Disc{10}, motions);
  EXPECT_THAT(volumes.near(Disc{10}, 0), ElementsAre(0, 1, 4));
  EXPECT_THAT(volumes.near(Disc{11}, 0), ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(volumes.near(Disc{10}, 2), ElementsAre(2));
  EXPECT_THAT(volumes.near(Disc{10}, rest({75, 0}, 0)), ElementsAre(0));
  EXPECT_TRUE(SweptVolumes(Disc{10}, {}).near(Disc{5}, motions[0]).empty());
}

TEST(SweptVolumes, EqualsAskingEachPair) {
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(static_cast<std::uint64_t>(seed));
    // Bodies and motions of many cases; sometimes as large as can be.
    std::vector<Motion> motions;
    const auto generate = [&] {
      return seed % 3 == 0 ? hard_bodies(random) : small_bodies(random);
    };
    const Case bodies = generate();
    for (int i = 0; i < 60; ++i) motions.push_back(generate().a);
    const SweptVolumes volumes(bodies.body_b, motions);
    const BodyPair pair(bodies.body_a, bodies.body_b);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      std::vector<std::size_t> expected;
      for (std::size_t k = 0; k < motions.size(); ++k)
        if (pair.can_meet(motions[i], motions[k])) expected.push_back(k);
      ASSERT_EQ(volumes.near(bodies.body_a, i), expected);
    }
  }
}

}  // namespace
}  // namespace quadrille::geometry
