// SPDX-License-Identifier: MIT
// Robots that turn on grids, as roadmaps of poses, against a search over their joint states.
#include <gtest/gtest.h>

#include <algorithm>
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
  int hard = 0;  ///< With a plan, and not solved by all methods.
};

/// With all methods, or with clauses alone. These need not come to an end in time, above all where
/// there is no plan.
void expect_equal(const Instance& instance, const TurningAnswer& answer, Objective objective,
                  bool is_clauses_alone, Tally& tally) {
  SolveOptions options;
  options.objective = objective;
  if (is_clauses_alone) options.route_work = options.joint_work = 0;
  const bool may_give_up = is_clauses_alone || answer.status == Status::infeasible;
  options.limits.conflicts = answer.status == Status::infeasible ? 500 : 1'000;
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
    ++(may_give_up ? tally.unknown : tally.hard);
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
    const TurningTask task = support::random_turning_task(seed);
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
  RecordProperty("hard", tally.hard);
  if (count < 200) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(2 * tally.optimal, static_cast<int>(count));
  EXPECT_GE(50 * tally.infeasible, static_cast<int>(count));
  EXPECT_LE(200 * tally.hard, static_cast<int>(count));
}

INSTANTIATE_TEST_SUITE_P(All, Turning,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& param) {
                           return param.param == Objective::makespan ? "Makespan" : "SumOfCosts";
                         });

}  // namespace
}  // namespace quadrille::continuous::test
