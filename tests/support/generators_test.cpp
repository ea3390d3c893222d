// SPDX-License-Identifier: MIT
#include "support/generators.hpp"

#include <gtest/gtest.h>

namespace quadrille::discrete::support {
namespace {

TEST(Random, IsTheSameEverywhere) {
  Random random(5489);
  std::vector<std::size_t> draws;
  for (std::size_t bound = 2; bound < 12; ++bound) draws.push_back(random.below(bound * bound));
  EXPECT_EQ(draws, (std::vector<std::size_t>{3, 2, 11, 23, 0, 19, 16, 1, 52, 41}));
}

TEST(Random, DrawsEachNumberAboutEquallyOften) {
  Random random(1);
  std::vector<int> hits(7);
  for (int draw = 0; draw < 70000; ++draw) ++hits[random.below(7)];
  for (const int count : hits) EXPECT_NEAR(count, 10000, 500);
}

TEST(Generators, KnowTheNumberOfConnectedGraphs) {  // OEIS A001349
  EXPECT_EQ(connected_graphs(1).size(), 1U);
  EXPECT_EQ(connected_graphs(2).size(), 1U);
  EXPECT_EQ(connected_graphs(3).size(), 2U);
  EXPECT_EQ(connected_graphs(4).size(), 6U);
  EXPECT_EQ(connected_graphs(5).size(), 21U);
}

TEST(Generators, ArrangementsAreAllDifferentTuples) {
  EXPECT_EQ(arrangements(4, 3).size(), 24U);
  EXPECT_EQ(arrangements(3, 2), (std::vector<std::vector<std::size_t>>{
                                    {0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}));
}

TEST(Generators, RepeatThemselvesForASeed) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random first(seed), second(seed);
    const Instance a = random_grid(first, {}), b = random_grid(second, {});
    EXPECT_EQ(a.agents(), b.agents());
    EXPECT_EQ(a.graph().num_edges(), b.graph().num_edges());
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
