// SPDX-License-Identifier: MIT
// Robots that turn, solved in timesteps, against a search over their joint poses.
#include "quadrille/poses/steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"
#include "support/pose_search.hpp"

namespace quadrille::poses {
namespace {

using continuous::Agent;
using continuous::Instance;
using continuous::Pose;
using continuous::PoseGrid;
using continuous::SolveOptions;
using continuous::SolveOutcome;
using continuous::Ticks;
using support::TurningAnswer;
using support::TurningTask;

PoseGrid grid_of(const TurningTask& task) {
  return PoseGrid::make({static_cast<std::int32_t>(task.height),
                         static_cast<std::int32_t>(task.width), task.passable},
                        Ticks(std::int64_t{task.turn}))
      .value();
}

std::vector<Agent> agents_of(const TurningTask& task, const PoseGrid& grid) {
  const auto width = static_cast<std::int32_t>(task.width);
  const auto cell = [&](std::size_t index) {
    const auto i = static_cast<std::int32_t>(index);
    return continuous::Cell{i % width, i / width};
  };
  std::vector<Agent> agents;
  for (const auto& robot : task.robots)
    agents.push_back({grid.vertex({cell(robot.start), kHeadings[robot.heading]}).value(),
                      grid.any_heading(cell(robot.goal)).value(),
                      continuous::Body(continuous::Disc{PoseGrid::kRadius})});
  return agents;
}

Result<Instance> instance_of(const PoseGrid& grid, std::vector<Agent> agents) {
  return Instance::make(grid.roadmap(), std::move(agents), PoseGrid::kResolution);
}

class Steps : public testing::TestWithParam<Objective> {};

TEST_P(Steps, CostWhatTheJointSearchSays) {
  const auto count = static_cast<std::uint64_t>(support::scaled(1500));
  const std::uint64_t first = GetParam() == Objective::makespan ? 4'000'000 : 3'000'000;
  int optimal = 0, infeasible = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const TurningTask task = support::random_turning_task(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(task));
    const TurningAnswer answer = search_poses(task, GetParam());
    ASSERT_NE(answer.status, Status::unknown);
    const PoseGrid grid = grid_of(task);
    const auto instance = instance_of(grid, agents_of(task, grid));
    if (!instance) {
      ASSERT_EQ(answer.status, Status::infeasible) << instance.error().to_string();
      continue;
    }
    SolveOptions options;
    options.objective = GetParam();
    options.debug.audit = seed % 4 == 0;
    options.threads = seed % 16 == 1 ? 2 : 1;
    const SolveOutcome outcome = solve(grid, *instance, options).value();
    ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->to_string();
    ASSERT_EQ(outcome.status, answer.status);
    if (answer.status == Status::infeasible) {
      ++infeasible;
      continue;
    }
    ++optimal;
    ASSERT_EQ(*outcome.cost, answer.cost);
    const continuous::VerifyReport report = verify(*instance, *outcome.plan);
    ASSERT_TRUE(report.valid()) << report.violations.front().message;
    ASSERT_EQ(continuous::cost(*outcome.plan, GetParam()), answer.cost);
    // There and back.
    const auto steps = in_steps(grid, *instance);
    const discrete::Plan plan = in_steps(grid, *steps, *outcome.plan);
    ASSERT_TRUE(discrete::verify(*steps, plan).valid());
    ASSERT_EQ(in_ticks(grid, *instance, plan), *outcome.plan);
  }
  RecordProperty("optimal", optimal);
  RecordProperty("infeasible", infeasible);
  EXPECT_GE(2 * optimal, static_cast<int>(count));
  EXPECT_GT(infeasible, 0);
}

INSTANTIATE_TEST_SUITE_P(All, Steps, testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& param) {
                           return param.param == Objective::makespan ? "Makespan" : "SumOfCosts";
                         });

/// Three by two cells.
TurningTask field(int turn) {
  return {3, 2, std::vector<bool>(6, true), turn, {{0, 0, 5}, {5, 2, 0}}};
}

TEST(StepsOf, InstancesThatSayMoreAreNone) {
  const TurningTask task = field(1);
  const PoseGrid grid = grid_of(task);
  const auto is_known = [&](const std::function<void(Agent&)>& change, Ticks now = 0) {
    std::vector<Agent> agents = agents_of(task, grid);
    change(agents[0]);
    auto instance =
        Instance::make(grid.roadmap(), std::move(agents), PoseGrid::kResolution, {}, {}, now);
    EXPECT_TRUE(instance) << instance.error().to_string();
    return instance && in_steps(grid, *instance).has_value();
  };
  EXPECT_TRUE(is_known([](Agent&) {}));
  EXPECT_TRUE(is_known([](Agent& a) { a.body = continuous::Disc{1}; }));
  EXPECT_FALSE(is_known([](Agent& a) { a.body = continuous::Disc{36}; }));
  EXPECT_FALSE(is_known([](Agent& a) { a.release = 2; }));
  EXPECT_FALSE(is_known([](Agent& a) { a.deadline = Ticks(20); }));
  EXPECT_FALSE(is_known([](Agent& a) { a.leaves = true; }));
  EXPECT_FALSE(is_known([](Agent&) {}, 5));
  EXPECT_FALSE(is_known([](Agent& a) { a.goals = a.goals.vertices().front(); }));
  const TurningTask slow = field(discrete::kMaxTurn + 1);
  const PoseGrid slow_grid = grid_of(slow);
  EXPECT_FALSE(in_steps(slow_grid, instance_of(slow_grid, agents_of(slow, slow_grid)).value()));
  // That of another grid.
  EXPECT_FALSE(in_steps(grid, instance_of(slow_grid, agents_of(slow, slow_grid)).value()));
}

TEST(StepsOf, WhatIsNotKnownIsSolvedInTicks) {
  const TurningTask task = field(2);
  const PoseGrid grid = grid_of(task);
  std::vector<Agent> agents = agents_of(task, grid);
  agents[0].release = 3;
  const Instance instance = instance_of(grid, std::move(agents)).value();
  const SolveOutcome outcome = solve(grid, instance, {}).value();
  EXPECT_EQ(outcome.status, Status::optimal);
  EXPECT_EQ(outcome.cost, continuous::solve(instance, {}).value().cost);
}

TEST(StepsOf, PlansAreGivenAndTold) {
  const TurningTask task = field(1);
  const PoseGrid grid = grid_of(task);
  const Instance instance = instance_of(grid, agents_of(task, grid)).value();
  const SolveOutcome first = solve(grid, instance, {}).value();
  SolveOptions options;
  options.debug.known_plan = first.plan;
  int num_told = 0;
  options.plan_interval_s = 0;
  options.on_plan = [&](const continuous::Plan& plan) {
    EXPECT_TRUE(verify(instance, plan).valid());
    ++num_told;
  };
  const SolveOutcome again = solve(grid, instance, options).value();
  EXPECT_EQ(again.status, Status::optimal);
  EXPECT_EQ(again.cost, first.cost);
  EXPECT_GT(num_told, 0);
  options.initial_plan = first.plan;
  EXPECT_EQ(solve(grid, instance, options).value().cost, first.cost);
  options.initial_plan->paths[AgentId(0)].pop_back();
  const auto refused = solve(grid, instance, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_plan);
}

// Who turns after it has come, as plans of others may, pays for it in ticks only.
TEST(StepsOf, TurnsAtTheGoalAreDropped) {
  const TurningTask task{2, 1, {true, true}, 3, {{0, 0, 1}}};
  const PoseGrid grid = grid_of(task);
  const Instance instance = instance_of(grid, agents_of(task, grid)).value();
  const auto at = [&](std::int32_t x, Heading heading) {
    return grid.vertex({{x, 0}, heading}).value();
  };
  continuous::Plan plan;
  plan.paths.push_back(
      {{at(0, Heading::east), 0, 2}, {at(1, Heading::east), 3, 4}, {at(1, Heading::south), 7, 7}});
  ASSERT_TRUE(verify(instance, plan).valid());
  const discrete::Instance steps = in_steps(grid, instance).value();
  const discrete::Plan same = in_steps(grid, steps, plan);
  EXPECT_EQ(same.paths[AgentId(0)],
            (discrete::Path{VertexId(0), VertexId(0), VertexId(0), VertexId(1)}));
}

}  // namespace
}  // namespace quadrille::poses
