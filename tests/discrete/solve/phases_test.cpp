// SPDX-License-Identifier: MIT
// Progress: which phases a solve goes through, and that the long ones show that they go on.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "quadrille/discrete/primal.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using enum Phase;

Instance crowd(std::size_t size, std::size_t num_agents) {
  Random random(1);
  return random_grid(random, {size, size, 0, num_agents, num_agents});
}

struct Told {
  std::vector<Phase> phases;  ///< As they began.
  std::map<Phase, int> num_times;
};

Told told_by(const Instance& instance, SolveOptions options) {
  Told told;
  options.on_progress = [&](const Progress& progress) {
    if (told.phases.empty() || told.phases.back() != progress.phase)
      told.phases.push_back(progress.phase);
    ++told.num_times[progress.phase];
  };
  static_cast<void>(solve(instance, options).value());
  return told;
}

TEST(Phases, EachIsToldWhenItBegins) {
  using List = std::vector<Phase>;
  SolveOptions options;
  options.limits.conflicts = 10;
  options.progress_interval_s = 1000;
  for (const std::size_t threads : {1U, 2U}) {
    options.threads = threads;
    EXPECT_EQ(told_by(crowd(12, 20), options).phases,
              (List{feasibility, set_up, first_plan, search}));
  }
  options.threads = 1;
  options.first_plan = false;
  EXPECT_EQ(told_by(crowd(12, 20), options).phases, (List{feasibility, set_up, search}));
  options.system = System::mdd_sat;
  EXPECT_EQ(told_by(crowd(8, 6), options).phases, (List{feasibility, set_up, search}));
}

TEST(Phases, LongOnesShowThatTheyGoOn) {
  SolveOptions options;
  options.limits.conflicts = 100;
  options.progress_interval_s = 0;
  Told told = told_by(crowd(32, 300), options);
  EXPECT_GE(told.num_times[set_up], 10);
  EXPECT_GE(told.num_times[first_plan], 2);
  EXPECT_GE(told.num_times[search], 10);
}

TEST(Phases, ADearFirstPlanIsImprovedBeforeTheSearch) {
  const Instance instance = crowd(20, 200);
  LimitMonitor limits{Limits{}};
  PrimalSearch first(instance, GoalDistances::make(instance, limits), 0);
  while (!first.is_over()) first.advance(100'000, limits);
  SolveOptions options;
  options.limits.conflicts = 1;
  const SolveOutcome result = solve(instance, options).value();
  ASSERT_TRUE(result.cost.has_value());
  EXPECT_LT(10 * *result.cost, 9 * first.cost());
  EXPECT_EQ(solve(instance, options)->plan, result.plan);
  // There is nothing dear about the makespan of it, and nobody asked for less.
  options.objective = Objective::makespan;
  EXPECT_GT(solve(instance, options)->plan->cost(Objective::sum_of_costs), *result.cost);
}

}  // namespace
}  // namespace quadrille::discrete::support
