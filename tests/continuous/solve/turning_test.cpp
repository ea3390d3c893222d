// SPDX-License-Identifier: MIT
// Robots that turn on grids, as roadmaps of poses, against a search over their joint states.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"
#include "support/pose_search.hpp"
#include "support/random.hpp"

namespace quadrille::continuous::test {
namespace {

using support::TurningAnswer;
using support::TurningTask;

TurningTask random_task(std::uint64_t seed) {
  support::Random random(seed);
  TurningTask task;
  task.width = random.between(2, 4);
  task.height = random.between(1, 3);
  task.turn = random.percent(70) ? 1 : static_cast<int>(random.between(2, 3));
  const std::size_t blocked = random.below(4) * 10;
  std::vector<std::size_t> starts;
  for (std::size_t cell = 0; cell < task.width * task.height; ++cell) {
    task.passable.push_back(cell == 0 || !random.percent(blocked));
    if (task.passable.back()) starts.push_back(cell);
  }
  std::vector<std::size_t> goals = starts;
  random.shuffle(starts);
  random.shuffle(goals);
  // As many as the joint search finds quickly.
  const std::size_t states = 2 * 4 * starts.size() * static_cast<std::size_t>(task.turn);
  std::size_t count = std::min(starts.size(), random.between(1, 4));
  while (std::pow(states, count) > 550'000) --count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t heading = random.below(4);
    task.robots.push_back({starts[i], heading, goals[i]});
  }
  // Seldom two have one goal.
  if (count > 1 && random.percent(3)) task.robots[1].goal = task.robots[0].goal;
  return task;
}

std::string describe(const TurningTask& task) {
  std::string text = "turn " + std::to_string(task.turn) + "\n";
  for (std::size_t cell = 0; cell < task.passable.size(); ++cell) {
    text += task.passable[cell] ? '.' : '@';
    if ((cell + 1) % task.width == 0) text += '\n';
  }
  for (const auto& robot : task.robots)
    text += std::to_string(robot.start) + " " + std::to_string(robot.heading) + " -> " +
            std::to_string(robot.goal) + "\n";
  return text;
}

Result<Instance> as_instance(const TurningTask& task) {
  const auto width = static_cast<std::int32_t>(task.width);
  const auto cell = [&](std::size_t index) {
    const auto i = static_cast<std::int32_t>(index);
    return Cell{i % width, i / width};
  };
  const OccupancyGrid cells{static_cast<std::int32_t>(task.height), width, task.passable};
  const auto grid = PoseGrid::make(cells, Ticks(std::int64_t{task.turn})).value();
  std::vector<Agent> agents;
  for (const auto& robot : task.robots)
    agents.push_back({grid.vertex({cell(robot.start), kHeadings[robot.heading]}).value(),
                      grid.any_heading(cell(robot.goal)).value(), Body(Disc{PoseGrid::kRadius})});
  return Instance::make(grid.roadmap(), std::move(agents), PoseGrid::kResolution);
}

struct Tally {
  int optimal = 0, infeasible = 0, unknown = 0;
};

/// With all methods, or with clauses alone. These need not come to an end in time, above all where
/// there is no plan.
void expect_equal(const Instance& instance, const TurningAnswer& answer, Objective objective,
                  bool is_clauses_alone, Tally& tally) {
  SolveOptions options;
  options.objective = objective;
  if (is_clauses_alone) options.route_work = options.joint_work = 0;
  const bool may_give_up = is_clauses_alone || answer.status == Status::infeasible;
  options.limits.conflicts = answer.status == Status::infeasible ? 500 : 5'000;
  options.debug.audit = is_clauses_alone && instance.num_agents() == 2;
  const SolveOutcome outcome = solve(instance, options).value();
  ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->to_string();
  if (outcome.plan) {
    const VerifyReport report = verify(instance, *outcome.plan);
    ASSERT_TRUE(report.valid()) << report.violations.front().message;
    ASSERT_EQ(answer.status, Status::optimal);
    ASSERT_GE(*outcome.cost, answer.cost);
  }
  ASSERT_TRUE(answer.status == Status::infeasible || outcome.lower_bound <= answer.cost);
  if (outcome.status == Status::feasible || outcome.status == Status::unknown) {
    ASSERT_TRUE(may_give_up);
    ++tally.unknown;
    return;
  }
  ASSERT_EQ(outcome.status, answer.status);
  ASSERT_EQ(outcome.cost.value_or(0), answer.cost);
  ++(outcome.plan ? tally.optimal : tally.infeasible);
}

class Turning : public testing::TestWithParam<Objective> {};

TEST_P(Turning, CostsWhatTheJointSearchSays) {
  const Objective objective = GetParam();
  const auto count = static_cast<std::uint64_t>(support::scaled(400));
  const std::uint64_t first = objective == Objective::makespan ? 2'000'000 : 1'000'000;
  Tally tally;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const TurningTask task = random_task(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(task));
    const TurningAnswer answer = search_poses(task, objective);
    ASSERT_NE(answer.status, Status::unknown);
    const auto instance = as_instance(task);
    if (!instance) {
      ASSERT_EQ(instance.error().code, ErrorCode::no_plan) << instance.error().to_string();
      ASSERT_EQ(answer.status, Status::infeasible);
      ++tally.infeasible;
      continue;
    }
    expect_equal(*instance, answer, objective, seed % 2 == 1, tally);
    if (HasFatalFailure()) return;
  }
  RecordProperty("optimal", tally.optimal);
  RecordProperty("infeasible", tally.infeasible);
  RecordProperty("unknown", tally.unknown);
  if (count < 200) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(2 * tally.optimal, static_cast<int>(count));
  EXPECT_GE(50 * tally.infeasible, static_cast<int>(count));
}

INSTANTIATE_TEST_SUITE_P(All, Turning,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& param) {
                           return param.param == Objective::makespan ? "Makespan" : "SumOfCosts";
                         });

}  // namespace
}  // namespace quadrille::continuous::test
