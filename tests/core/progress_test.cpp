// SPDX-License-Identifier: MIT
#include "quadrille/core/progress.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace quadrille {
namespace {

/// As a computation of length does.
void ask(LimitMonitor& monitor, int times) {
  for (int k = 0; k < times; ++k) static_cast<void>(monitor.exhausted());
}

TEST(Progress, PhasesHaveNames) {
  EXPECT_EQ(to_string(Phase::set_up), "set-up");
  EXPECT_EQ(to_string(Phase::joint_search), "joint-search");
  EXPECT_EQ(to_string(Phase::routes), "routes");
  EXPECT_EQ(to_string(Phase::first_plan), "first-plan");
  EXPECT_EQ(to_string(Phase::feasibility), "feasibility");
  EXPECT_EQ(to_string(Phase::search), "search");
}

TEST(Progress, IsToldWhenAPhaseBeginsAndWhereTheMonitorIsAsked) {
  std::vector<Progress> told;
  const std::function<void(const Progress&)> callback = [&](const Progress& progress) {
    told.push_back(progress);
  };
  LimitMonitor monitor(Limits{});
  {
    ProgressReporter reporter(callback, 0, monitor);
    EXPECT_TRUE(told.empty());
    reporter.enter(Phase::set_up);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].phase, Phase::set_up);
    reporter.know(7, 9);
    ask(monitor, 32);
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[2].lower_bound, 7);
    EXPECT_EQ(told[2].cost, 9);
    EXPECT_EQ(told[2].phase, Phase::set_up);
    static_cast<void>(monitor.exhausted_now());
    EXPECT_EQ(told.size(), 4U);
  }
  ask(monitor, 32);
  EXPECT_EQ(told.size(), 4U);  // The reporter is gone.
}

TEST(Progress, BetweenPhasesTheIntervalIsKept) {
  int num_told = 0;
  const std::function<void(const Progress&)> callback = [&](const Progress&) { ++num_told; };
  LimitMonitor monitor(Limits{});
  ProgressReporter reporter(callback, 3600, monitor);
  reporter.enter(Phase::set_up);
  ask(monitor, 100);
  reporter.tell_if_due();
  EXPECT_EQ(num_told, 1);
  reporter.enter(Phase::search);
  EXPECT_EQ(num_told, 2);
}

TEST(Progress, NothingIsToldAfterALimitOrAnException) {
  int num_told = 0;
  const std::function<void(const Progress&)> callback = [&](const Progress&) {
    if (++num_told == 2) throw std::runtime_error("enough");
  };
  LimitMonitor monitor(Limits{});
  ProgressReporter reporter(callback, 0, monitor);
  reporter.enter(Phase::set_up);
  EXPECT_THROW(ask(monitor, 16), std::runtime_error);
  ask(monitor, 100);
  reporter.enter(Phase::search);
  EXPECT_EQ(num_told, 2);

  const std::function<void(const Progress&)> counter = [&](const Progress&) { ++num_told; };
  LimitMonitor stopped(Limits{});
  const ProgressReporter second(counter, 0, stopped);
  stopped.stop(StopReason::interrupt);
  ask(stopped, 100);
  EXPECT_EQ(num_told, 2);
}

TEST(Progress, NobodyNeedsToListen) {
  const std::function<void(const Progress&)> nobody;
  LimitMonitor monitor(Limits{});
  ProgressReporter reporter(nobody, 0, monitor);
  reporter.enter(Phase::search);
  ask(monitor, 100);
  reporter.tell_if_due();
}

}  // namespace
}  // namespace quadrille
