// SPDX-License-Identifier: MIT
#include "quadrille/solve/pulse.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

namespace quadrille::solve {
namespace {

const Facts kNothing;

/// As a computation of length does.
void ask(LimitMonitor& monitor, int times) {
  for (int k = 0; k < times; ++k) static_cast<void>(monitor.exhausted());
}

TEST(Progress, IsToldWhenAPhaseBeginsAndWhereTheMonitorIsAsked) {
  std::vector<Progress> told;
  const std::function<void(const Progress&)> callback = [&](const Progress& progress) {
    told.push_back(progress);
  };
  LimitMonitor monitor(Limits{});
  Facts known;
  {
    ProgressReporter reporter(callback, 0, monitor, known);
    EXPECT_TRUE(told.empty());
    reporter.enter(Phase::set_up);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].phase, Phase::set_up);
    known.floor = 7;
    known.cost = 9;
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
  ProgressReporter reporter(callback, 3600, monitor, kNothing);
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
  ProgressReporter reporter(callback, 0, monitor, kNothing);
  reporter.enter(Phase::set_up);
  EXPECT_THROW(ask(monitor, 16), std::runtime_error);
  ask(monitor, 100);
  reporter.enter(Phase::search);
  EXPECT_EQ(num_told, 2);

  const std::function<void(const Progress&)> counter = [&](const Progress&) { ++num_told; };
  LimitMonitor stopped(Limits{});
  const ProgressReporter second(counter, 0, stopped, kNothing);
  stopped.stop(StopReason::interrupt);
  ask(stopped, 100);
  EXPECT_EQ(num_told, 2);
}

TEST(Progress, NobodyNeedsToListen) {
  const std::function<void(const Progress&)> nobody;
  LimitMonitor monitor(Limits{});
  ProgressReporter reporter(nobody, 0, monitor, kNothing);
  reporter.enter(Phase::search);
  ask(monitor, 100);
  reporter.tell_if_due();
}

TEST(Progress, IsNotToldWhereTheMonitorIsQuiet) {
  int num_told = 0;
  const std::function<void(const Progress&)> callback = [&](const Progress&) { ++num_told; };
  LimitMonitor monitor(Limits{});
  ProgressReporter reporter(callback, 0, monitor, kNothing);
  {
    const LimitMonitor::Quiet quiet(monitor);
    ask(monitor, 100);
  }
  EXPECT_EQ(num_told, 0);
  ask(monitor, 16);
  EXPECT_EQ(num_told, 1);
}

struct Told {
  Knowledge<int> known;
  Request<int> request;
  std::vector<int> plans;

  Told() {
    request.on_plan = [this](int plan) { plans.push_back(plan); };
    request.plan_interval_s = 0;
  }
  void find(int plan, Cost cost) { known.take(std::make_shared<const int>(plan), cost); }
};

TEST(Pulse, TellsEachCheaperPlanOnce) {
  Told told;
  LimitMonitor monitor(Limits{});
  Pulse<int> pulse(told.request, monitor, told.known, true);
  pulse.beat();
  told.find(1, 9);
  pulse.beat();
  pulse.beat();
  told.find(2, 8);
  pulse.beat();
  EXPECT_EQ(told.plans, (std::vector<int>{1, 2}));
  Pulse<int> silent(told.request, monitor, told.known, false);
  told.find(3, 7);
  silent.beat();
  EXPECT_EQ(told.plans.size(), 2U);
}

TEST(Pulse, StopsWhenWhatIsKnownIsGoodEnough) {
  Told told;
  told.request.gap_percent = 25;
  LimitMonitor monitor(Limits{});
  Pulse<int> pulse(told.request, monitor, told.known, true);
  told.known.raise(4);
  pulse.beat();
  told.find(1, 6);
  pulse.beat();
  EXPECT_EQ(monitor.reason(), StopReason::none);
  told.find(2, 5);
  pulse.beat();
  EXPECT_EQ(monitor.reason(), StopReason::gap);
}

}  // namespace
}  // namespace quadrille::solve
