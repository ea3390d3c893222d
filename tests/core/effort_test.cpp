// SPDX-License-Identifier: MIT
#include "quadrille/core/effort.hpp"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

TEST(Effort, AddsUpAndIsShared) {
  Effort effort = Effort::microseconds(2);
  effort += Effort::nanoseconds(500);
  EXPECT_EQ(effort.count(), 2500);
  effort -= Effort::nanoseconds(100);
  EXPECT_EQ(effort, Effort::nanoseconds(2400));
  EXPECT_EQ(3 * effort - effort, effort + effort);
  EXPECT_EQ(effort / 7, Effort::nanoseconds(342));
  EXPECT_EQ(effort / Effort::nanoseconds(25), 96);
  EXPECT_EQ(Effort::nanoseconds(-49) / Effort::nanoseconds(25), -1);
}

TEST(Effort, IsOrdered) {
  EXPECT_EQ(Effort(), Effort::nanoseconds(0));
  EXPECT_LT(Effort::nanoseconds(999), Effort::microseconds(1));
  EXPECT_LT(Effort::microseconds(1), Effort::most());
}

}  // namespace
}  // namespace quadrille
