// SPDX-License-Identifier: MIT
//
// Instances whose answers are known.
#include "quadrille/continuous/solver.hpp"

#include <gtest/gtest.h>

#include "continuous/support/least_cost.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous::test {
namespace {

/// A line of three places with a fourth beside the middle.
std::shared_ptr<const Roadmap> alcove() {
  return roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 800}}, {{0, 1}, {1, 2}, {1, 3}});
}

class ContinuousSolver : public testing::TestWithParam<System> {
 protected:
  Cost least(const Instance& instance, Objective objective = Objective::sum_of_costs) {
    return least_cost(instance, GetParam(), objective);
  }
};

TEST_P(ContinuousSolver, NoAgents) {
  EXPECT_EQ(least(Instance::make(roadmap({{0, 0}}, {}), {}).value()), 0);
}

TEST_P(ContinuousSolver, AlreadyThere) {
  EXPECT_EQ(least(Instance::make(roadmap({{0, 0}, {9, 0}}, {{0, 1}}), {agent(0, 0, 3)}).value()),
            0);
}

TEST_P(ContinuousSolver, CrossingWaitsForTheFirstTickAtWhichBodiesTouchAtMost) {
  const auto map = roadmap({{-100, 0}, {100, 0}, {0, -100}, {0, 100}}, {{0, 1}, {2, 3}});
  const auto instance = Instance::make(map, {agent(0, 1, 49), agent(2, 3, 50)}).value();
  EXPECT_EQ(least(instance), 400 + 141);  // 99 * sqrt(2) = 140.007
  EXPECT_EQ(least(instance, Objective::makespan), 200 + 141);
}

TEST_P(ContinuousSolver, FollowingAtTouchingDistanceCostsNothing) {
  const auto map = roadmap({{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  EXPECT_EQ(least(Instance::make(map, {agent(0, 2, 500), agent(1, 3, 500)}).value()), 4000);
}

TEST_P(ContinuousSolver, AFasterFollowerWaits) {
  // The second agent is twice as fast and 1000 behind.
  const auto map = roadmap({{0, 0}, {1000, 0}, {3000, 0}, {4000, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const auto instance =
      Instance::make(map, {agent(1, 3, 150), agent(0, 2, 150, 2 * kUnitSpeed)}).value();
  // If the follower enters the middle edge at s, it is at its end, 3000, at s + 1000, when the
  // leader is at 2000 + s: s >= 1300 keeps them 300 apart.
  EXPECT_EQ(least(instance), 3000 + 1300 + 1000);
}

TEST_P(ContinuousSolver, OneOfTwoGivesWayInAnAlcove) {
  const auto instance = Instance::make(alcove(), {agent(0, 2, 300), agent(2, 0, 300)}).value();
  const Cost cost = least(instance);
  EXPECT_GT(cost, 4000 + 1600);
  EXPECT_LT(cost, 4000 + 1600 + 1000);
}

INSTANTIATE_TEST_SUITE_P(Systems, ContinuousSolver, testing::Values(System::dpll, System::smt_cbs),
                         [](const auto& param) {
                           return std::string(param.param == System::dpll ? "Dpll" : "SmtCbs");
                         });

TEST(ContinuousSolverInfeasible, TwoAgentsThatHaveToPassOnALine) {
  for (const std::size_t length : {1U, 2U, 6U}) {
    std::vector<Point> points{{0, 0}};
    Roads roads;
    for (std::size_t v = 1; v <= length; ++v) {
      points.push_back({Length(1000 * static_cast<std::int64_t>(v)), 0});
      roads.emplace_back(v - 1, v);
    }
    const auto map = roadmap(points, roads);
    const auto instance =
        Instance::make(map, {agent(0, length, 100), agent(length, 0, 100)}).value();
    SolveOptions options;
    options.limits.cpu_s = 20;
    const SolveOutcome outcome = solve(instance, options).value();
    EXPECT_EQ(outcome.status, Status::infeasible);
    EXPECT_EQ(outcome.statistics.conflicts, 0);
    EXPECT_FALSE(outcome.explanation.empty());
  }
}

TEST(ContinuousSolverInfeasible, ThreeAgentsWithRoomForTwo) {
  // The first two can pass each other by way of the alcove as long as the third is not in it.
  SolveOptions options;
  options.limits.cpu_s = 20;
  const auto instance =
      Instance::make(alcove(), {agent(0, 2, 300), agent(2, 0, 300), agent(3, 3, 300)}).value();
  EXPECT_EQ(solve(instance, options).value().status, Status::infeasible);
}

TEST(ContinuousSolverLimits, APlanAndABoundAreKnownWhenALimitEndsTheSearch) {
  // A grid whose columns are crossed by agents along its rows, in both directions.
  std::vector<Point> points;
  Roads roads;
  for (std::size_t y = 0; y < 6; ++y)
    for (std::size_t x = 0; x < 6; ++x) {
      points.push_back({Length(1000 * static_cast<std::int64_t>(x)),
                        Length(1000 * static_cast<std::int64_t>(y))});
      if (x > 0) roads.emplace_back(6 * y + x - 1, 6 * y + x);
      if (y > 0) roads.emplace_back(6 * y + x - 6, 6 * y + x);
    }
  std::vector<Agent> agents;
  for (std::size_t k = 1; k < 5; ++k) {
    agents.push_back(agent(6 * k, 6 * (5 - k) + 5, 400));
    agents.push_back(agent(30 + k, 5 - k, 400));
  }
  const auto instance = Instance::make(roadmap(points, roads), agents).value();
  SolveOptions options;
  options.limits.conflicts = 1;
  const SolveOutcome outcome = solve(instance, options).value();
  ASSERT_EQ(outcome.status, Status::feasible);
  EXPECT_TRUE(verify(instance, *outcome.plan).valid());
  EXPECT_GE(outcome.lower_bound, 8 * 5000);
  EXPECT_GT(*outcome.cost, outcome.lower_bound);
}

TEST(ContinuousSolverLimits, CongestionTakesFewConflicts) {
  SolveOptions options;
  options.limits.conflicts = 600;
  options.route_work = options.joint_work = 0;
  const auto instance = Instance::make(alcove(), {agent(0, 2, 300), agent(2, 0, 300)}).value();
  const SolveOutcome outcome = solve(instance, options).value();
  EXPECT_EQ(outcome.status, Status::optimal);
  EXPECT_EQ(outcome.lower_bound, 6547);
}

TEST(ContinuousSolveOptions, OutsideTheirRangesAreErrorsWithAReason) {
  const auto instance = Instance::make(alcove(), {agent(0, 2, 300)}).value();
  const auto expect_refused = [&](const SolveOptions& options, ErrorCode code,
                                  const std::string& reason) {
    const auto outcome = solve(instance, options);
    ASSERT_FALSE(outcome) << reason;
    EXPECT_EQ(outcome.error().code, code) << reason;
    EXPECT_NE(outcome.error().message.find(reason), std::string::npos) << outcome.error().message;
  };
  SolveOptions gap, seed, progress, known;
  gap.gap_percent = -1;
  expect_refused(gap, ErrorCode::out_of_range, "gap");
  gap.gap_percent = std::numeric_limits<double>::quiet_NaN();
  expect_refused(gap, ErrorCode::out_of_range, "gap");
  seed.seed = 2'000'000'001;
  expect_refused(seed, ErrorCode::out_of_range, "seed");
  progress.progress_interval_s = -1;
  expect_refused(progress, ErrorCode::out_of_range, "progress");
  known.debug.known_plan = Plan();
  expect_refused(known, ErrorCode::invalid_plan, "known plan");
}

}  // namespace
}  // namespace quadrille::continuous::test
