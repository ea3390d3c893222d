// SPDX-License-Identifier: MIT
#include "quadrille/core/outcome.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadrille {
namespace {

TEST(Gap, IsRelativeToTheLowerBound) {
  EXPECT_EQ(gap_percent(0, 0), 0);
  EXPECT_EQ(gap_percent(7, 7), 0);
  EXPECT_EQ(gap_percent(10, 8), 25);
  EXPECT_EQ(gap_percent(30, 10), 200);
  EXPECT_TRUE(std::isinf(gap_percent(1, 0)));
}

TEST(Gap, IsWithinWhatIsWanted) {
  EXPECT_FALSE(is_within_gap(std::nullopt, 7, 7));
  EXPECT_TRUE(is_within_gap(0, 7, 7));
  EXPECT_FALSE(is_within_gap(0, 8, 7));
  // Of the cost it would be 20 per cent.
  EXPECT_FALSE(is_within_gap(20, 10, 8));
  EXPECT_TRUE(is_within_gap(25, 10, 8));
  EXPECT_FALSE(is_within_gap(1e9, 1, 0));
}

}  // namespace
}  // namespace quadrille
