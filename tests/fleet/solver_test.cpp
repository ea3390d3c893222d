// SPDX-License-Identifier: MIT
#include "quadrille/fleet/solver.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "fleet/support.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "support/environment.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

const VertexId kA(0), kB(1), kC(2);
/// A seed with which nine robots need more than one look.
constexpr std::uint32_t kCrowd = 0;

/// Two robots that change places on a line, where one has to go around by a siding at its middle.
Fleet meeting() {
  RoadmapBuilder roads({.length = 1_mm, .time = 10_ms});
  const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(2_m, 0_m, "b");
  const VertexId c = roads.vertex(4_m, 0_m, "c"), siding = roads.vertex(2_m, 1_m, "siding");
  roads.road(a, b).road(b, c).road(b, siding);
  Fleet fleet(roads.build().value());
  fleet.robot({.name = "p", .body = Disc(0.35_m), .speed = 1_mps}).from(a).to(c);
  fleet.robot({.name = "q", .body = Disc(0.35_m), .speed = 1_mps}).from(c).to(a);
  return fleet;
}

TEST(FleetSolver, AnswersInSecondsAndNames) {
  const Fleet fleet = meeting();
  const SolveOutcome outcome = solve(fleet).value();
  const auto below = continuous::solve(fleet.instance().value(), {}).value();
  EXPECT_EQ(outcome.status, Status::optimal);
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_EQ(outcome.plan->in_units(), *below.plan);
  EXPECT_EQ(outcome.cost, Seconds(static_cast<double>(*below.cost) / 100));
  EXPECT_EQ(outcome.lower_bound, *outcome.cost);
  EXPECT_EQ(outcome.cost, outcome.plan->sum_of_costs());
  EXPECT_EQ(outcome.summary(), "optimal: " + to_string(*outcome.cost));
  EXPECT_EQ((*outcome.plan)[*fleet.find("q")].name(), "q");
}

TEST(FleetSolver, ObjectivesAndRandomFleetsAgreeWithTheLayerBelow) {
  for (std::uint32_t seed = 0; seed < support::scaled(40); ++seed) {
    SCOPED_TRACE(seed);
    const Fleet fleet = test::random_fleet(seed, 2);
    const auto instance = fleet.instance();
    const auto objective = seed % 2 == 0 ? Objective::sum_of_costs : Objective::makespan;
    SolveOptions in_metres;
    in_metres.objective = objective;
    const SolveOutcome outcome = solve(fleet, in_metres).value();
    if (!instance) {
      EXPECT_EQ(outcome.status, Status::infeasible);
      EXPECT_EQ(outcome.summary(), "infeasible: " + instance.error().message);
      continue;
    }
    continuous::SolveOptions options;
    options.objective = objective;
    const auto below = continuous::solve(*instance, options).value();
    EXPECT_EQ(outcome.status, below.status);
    ASSERT_EQ(outcome.plan.has_value(), below.plan.has_value());
    if (!below.plan) continue;
    EXPECT_EQ(outcome.plan->in_units(), *below.plan);
    EXPECT_EQ(outcome.cost->value(),
              continuous::in_input_units(*below.cost, instance->resolution()));
    EXPECT_EQ(*outcome.cost, objective == Objective::makespan ? outcome.plan->makespan()
                                                              : outcome.plan->sum_of_costs());
  }
}

TEST(FleetSolver, NoPlanIsAnOutcome) {
  const RobotSpec spec{.name = {}, .body = Disc(0.35_m), .speed = 1_mps};
  Fleet overlapping(test::line(3));
  overlapping.robot(spec).from(kA).to(kB);
  overlapping.robot(spec).from(kA).to(kC);
  EXPECT_EQ(solve(overlapping).value().summary(),
            "infeasible: the starts of 'robot 0' at a and 'robot 1' at a overlap");
  Fleet stuck(test::line(3));
  stuck.robot(spec).from(kA).to(kC);
  stuck.robot(spec).from(kC).to(kA);
  const SolveOutcome outcome = solve(stuck).value();
  EXPECT_EQ(outcome.status, Status::infeasible);
  EXPECT_FALSE(outcome.explanation.empty());
  EXPECT_FALSE(outcome.plan.has_value());
  Fleet unfinished(test::line(3));
  unfinished.robot(spec).from(kA);
  EXPECT_EQ(solve(unfinished).error().message, "'robot 0' has no goal");
}

TEST(FleetSolver, WatchersSeeSecondsAndVerifiedPlans) {
  const Fleet fleet = test::random_fleet(kCrowd, 9);
  ASSERT_TRUE(fleet.instance().has_value());
  SolveOptions options;
  options.progress_interval = options.plan_interval = 0_s;
  options.limits.conflicts = 300;
  std::vector<Seconds> costs, bounds;
  options.on_progress = [&](const Progress& progress) {
    bounds.push_back(progress.lower_bound);
    EXPECT_GE(progress.elapsed, 0_s);
  };
  options.on_plan = [&](const TimedPlan& plan) {
    costs.push_back(plan.sum_of_costs());
    EXPECT_TRUE(verify(fleet, plan.in_units()).value().valid());
  };
  const SolveOutcome outcome = solve(fleet, options).value();
  ASSERT_TRUE(outcome.plan.has_value());
  ASSERT_FALSE(costs.empty());
  for (std::size_t k = 1; k < costs.size(); ++k) EXPECT_LT(costs[k], costs[k - 1]);
  EXPECT_LE(*outcome.cost, costs.back());
  for (const Seconds bound : bounds) EXPECT_LE(bound, outcome.lower_bound);
  options.on_plan = [](const TimedPlan&) { throw std::runtime_error("enough"); };
  EXPECT_THROW(static_cast<void>(solve(fleet, options)), std::runtime_error);
}

TEST(FleetSolver, LimitsAreThoseOfTheLayerBelow) {
  const Fleet fleet = test::random_fleet(4, 6);
  SolveOptions options;
  options.limits.wall = 0_s;
  const SolveOutcome outcome = solve(fleet, options).value();
  EXPECT_EQ(outcome.stop, StopReason::wall_time);
  EXPECT_TRUE(outcome.status == Status::unknown || outcome.status == Status::feasible);
  options.gap_percent = -1;
  EXPECT_EQ(solve(fleet, options).error().code, ErrorCode::out_of_range);
}

TEST(FleetSolver, SummariesSayHowGoodAPlanIs) {
  SolveOutcome outcome;
  outcome.status = Status::feasible;
  outcome.cost = 34.6_s;
  outcome.lower_bound = 33.8_s;
  EXPECT_EQ(outcome.summary(), "feasible: 34.6 s, at least 33.8 s (gap 2.37 %)");
  outcome.lower_bound = 0_s;
  EXPECT_EQ(outcome.summary(), "feasible: 34.6 s, at least 0 s");
}

}  // namespace
}  // namespace quadrille::fleet
