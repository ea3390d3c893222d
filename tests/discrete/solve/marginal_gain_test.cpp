// SPDX-License-Identifier: MIT
#include "solve/marginal_gain.hpp"

#include <gtest/gtest.h>

namespace quadrille::discrete {
namespace {

const Settings kSettings;
constexpr Effort kSearch = Effort::microseconds(1'000'000), kPlans = kSearch / 40;
constexpr double kOpen = 50, kNearlyClosed = 0.5;  // per cent

/// What is due for a second of the search, after turns in which both gained so much.
Effort due_after(int turns, Cost gain_of_search, Cost gain_of_plans, double gap_percent) {
  MarginalGain gain(kSettings);
  for (int turn = 0; turn < turns; ++turn) {
    gain.count_search(kSearch, gain_of_search);
    gain.count_plans(kPlans, gain_of_plans, gap_percent);
  }
  return gain.due(kSearch);
}

TEST(MarginalGain, WhoClosesTheGapFasterGetsMore) {
  const Effort first = due_after(0, 0, 0, kOpen);
  EXPECT_GT(first, Effort());
  EXPECT_GT(due_after(1, 0, 1, kOpen), first);
  EXPECT_GT(due_after(20, 10, 100, kOpen), 20 * first);
  EXPECT_LT(due_after(1, 1, 0, kOpen), first);
  // The search has had forty times the effort.
  EXPECT_GT(due_after(1, 41, 2, kOpen), Effort());
  EXPECT_LT(due_after(1, 100, 2, kOpen), first);
  EXPECT_GT(due_after(1, 70, 2, kOpen), first);
}

TEST(MarginalGain, NobodyStarves) {
  const Effort least = due_after(100, 100, 0, kOpen), most = due_after(100, 0, 100, kOpen);
  EXPECT_GT(least, Effort());
  EXPECT_EQ(least, due_after(200, 100, 0, kOpen));
  EXPECT_EQ(most, due_after(200, 0, 100, kOpen));
  EXPECT_LT(most, 10 * kSearch);
}

TEST(MarginalGain, NothingIsGainedByNobody) {
  EXPECT_EQ(due_after(100, 0, 0, kOpen), due_after(100, 100, 0, kOpen));
}

TEST(MarginalGain, CloseToTheEndTheProofHasPriority) {
  EXPECT_LE(due_after(100, 0, 100, kNearlyClosed), due_after(0, 0, 0, kOpen));
  MarginalGain gain(kSettings);
  for (int turn = 0; turn < 100; ++turn) gain.count_plans(kPlans, 100, kOpen);
  const Effort before = gain.due(kSearch);
  gain.count_plans(kPlans, 100, kNearlyClosed);
  EXPECT_LT(gain.due(kSearch), before);
}

TEST(MarginalGain, WhatIsLongAgoIsForgotten) {
  MarginalGain gain(kSettings);
  gain.count_search(kSearch, 1'000'000);
  for (int turn = 0; turn < 100; ++turn) {
    gain.count_search(kSearch, 0);
    gain.count_plans(kPlans, 1, kOpen);
  }
  EXPECT_GT(gain.due(kSearch), due_after(0, 0, 0, kOpen));
}

}  // namespace
}  // namespace quadrille::discrete
