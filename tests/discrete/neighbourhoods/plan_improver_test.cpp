// SPDX-License-Identifier: MIT
//
// How first plans are improved.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "discrete/primal/primal_support.hpp"
#include "primal/lacam.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using State = PrimalSearch::State;
using quadrille::support::scaled;
using support::instance_text;
using support::joint_search;
using support::replay;

TEST(PlanImprover, NeverWorsensAndStaysAboveTheOptimum) {
  support::Random random(4);
  std::size_t num_plans[2] = {0, 0}, num_optimal[2] = {0, 0};
  for (std::size_t round = 0; round < scaled(1200); ++round) {
    const Instance instance = random_instance(random);
    const auto objective = round % 2 == 0 ? Objective::sum_of_costs : Objective::makespan;
    const auto answer = joint_search(instance, objective, 100'000);
    if (answer.status != Status::optimal) continue;
    SCOPED_TRACE(instance_text(instance));
    const PrimalSearch search = searched(instance, 1);
    ASSERT_EQ(search.state(), State::found);
    LimitMonitor limits{Limits{}};
    PlanImprover improver(instance, distances_of(instance), objective, search.plan(), 1);
    ASSERT_EQ(improver.plan(), search.plan());
    for (int step = 0; step < 60; ++step) {
      const Cost cost = improver.cost();
      const Cost sum = improver.plan().cost(Objective::sum_of_costs);
      const bool improved = improver.step(limits);
      ASSERT_EQ(replay(instance, improver.plan()), "");
      ASSERT_EQ(improver.cost(), improver.plan().cost(objective));
      ASSERT_LE(improver.cost(), cost);
      const Cost new_sum = improver.plan().cost(Objective::sum_of_costs);
      ASSERT_TRUE(improver.cost() < cost || new_sum <= sum);
      ASSERT_EQ(improved, improver.cost() < cost || new_sum < sum);
    }
    ASSERT_GE(improver.cost(), answer.cost);
    ++num_plans[round % 2];
    if (improver.cost() == answer.cost) ++num_optimal[round % 2];
  }
  for (const int k : {0, 1}) {
    EXPECT_GE(num_plans[k], scaled(200));
    EXPECT_GE(num_optimal[k], num_plans[k] * 9 / 10);  // It is a local search; measured: 97 %.
  }
}

TEST(PlanImprover, PaysForASmallerMakespanWithTheSumOfCosts) {
  // Either the first agent waits once, or the second one three times.
  const Instance instance = instance_of(
      "map\n@@@@.@@@@@\n@@@@.@@@@@\n..........\n@@@.@@@@@@\n"
      "task 0 2 -> 9 2\ntask 4 0 -> 3 3\n");
  const auto distances = distances_of(instance);
  LimitMonitor limits{Limits{}};
  PlanImprover sum(instance, distances, Objective::sum_of_costs, searched(instance).plan(), 0);
  sum.improve(1000, limits);
  ASSERT_EQ(sum.cost(), 14);
  ASSERT_EQ(sum.plan().cost(Objective::makespan), 10);
  PlanImprover makespan(instance, distances, Objective::makespan, sum.plan(), 0);
  EXPECT_TRUE(makespan.improve(1000, limits));
  EXPECT_EQ(makespan.cost(), 9);
  EXPECT_EQ(makespan.plan().cost(Objective::sum_of_costs), 16);
}

TEST(PlanImprover, ImprovesCrowdsByMuch) {
  for (const auto objective : {Objective::sum_of_costs, Objective::makespan}) {
    const Instance instance = crowd(20, 150, 5);
    LimitMonitor limits{Limits{}};
    Lacam search(instance, distances_of(instance), 0, nullptr);  // Without a guide plans are dear.
    static_cast<void>(search.advance(kNoEnd, limits));
    const Plan first = search.plan();
    PlanImprover improver(instance, distances_of(instance), objective, first, 0);
    EXPECT_TRUE(improver.improve(400'000, limits));
    ASSERT_TRUE(verify(instance, improver.plan()).valid());
    if (objective == Objective::makespan) {
      EXPECT_LE(improver.cost(), first.cost(objective));
      continue;
    }
    const Cost ideal = sum_of_distances(instance);
    EXPECT_LT(improver.cost() - ideal, (first.cost(objective) - ideal) / 4);
  }
}

TEST(PlanImprover, ReachesTheIdealPlanAndStops) {
  const Instance instance = crowd(30, 10, 6);
  LimitMonitor limits{Limits{}};
  PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                        searched(instance).plan(), 0);
  improver.improve(kNoEnd, limits);  // Ends, since there is such a plan.
  EXPECT_TRUE(improver.is_ideal());
  EXPECT_EQ(improver.cost(), sum_of_distances(instance));
  EXPECT_FALSE(improver.step(limits));
}

TEST(PlanImprover, StopsAtTheTarget) {
  const Instance instance = crowd(20, 150, 5);
  LimitMonitor limits{Limits{}};
  PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                        searched(instance).plan(), 0);
  const Cost target = improver.cost() - 20;
  EXPECT_TRUE(improver.improve(kNoEnd, limits, target));
  EXPECT_LE(improver.cost(), target);
  const std::int64_t effort = improver.effort();
  EXPECT_FALSE(improver.improve(kNoEnd, limits, target));
  EXPECT_EQ(improver.effort(), effort);
}

TEST(PlanImprover, DependsOnTheSeedAndNotOnSlicesOrRepetition) {
  const Instance instance = crowd(15, 100, 8);
  const Plan first = searched(instance).plan();
  const auto distances = distances_of(instance);
  LimitMonitor limits{Limits{}};
  const auto improved = [&](std::uint32_t seed, std::int64_t slice) {
    PlanImprover improver(instance, distances, Objective::sum_of_costs, first, seed);
    while (improver.effort() < 50'000) improver.improve(slice, limits);
    return improver.plan();
  };
  const Plan once = improved(1, 50'000);
  EXPECT_EQ(improved(1, 50'000), once);
  EXPECT_EQ(improved(1, 1), once);
  EXPECT_NE(improved(2, 50'000), once);
}

TEST(PlanImprover, GoesOnFromAnotherPlan) {
  const Instance instance = crowd(15, 100, 8);
  LimitMonitor limits{Limits{}};
  PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                        searched(instance, 1).plan(), 0);
  improver.improve(20'000, limits);
  Plan other = searched(instance, 2).plan();
  for (Path& path : other.paths) path.resize(path.size() + 3, path.back());  // Not trimmed.
  improver.restart_from(other);
  EXPECT_EQ(improver.cost(), other.cost(Objective::sum_of_costs));
  trim(other);
  EXPECT_EQ(improver.plan(), other);
  improver.improve(20'000, limits);
  EXPECT_TRUE(verify(instance, improver.plan()).valid());
  EXPECT_LT(improver.cost(), other.cost(Objective::sum_of_costs));
}

TEST(PlanImprover, IsNeverCostlierThanAPlanInjectedAtAnyMoment) {
  support::Random random(12);
  const Instance instance = crowd(12, 70, 10);
  const auto distances = distances_of(instance);
  LimitMonitor limits{Limits{}};
  PlanImprover giver(instance, distances, Objective::sum_of_costs, searched(instance, 1).plan(), 1);
  PlanImprover taker(instance, distances, Objective::sum_of_costs, searched(instance, 2).plan(), 2);
  std::size_t num_injected = 0;
  Cost best = taker.cost();
  for (int round = 0; round < 300; ++round) {
    giver.improve(static_cast<std::int64_t>(random.below(2000)), limits);
    taker.improve(static_cast<std::int64_t>(random.below(1000)), limits);
    ASSERT_LE(taker.cost(), best);
    if (giver.cost() < taker.cost()) {
      taker.restart_from(giver.plan());
      ASSERT_EQ(taker.cost(), giver.cost());
      ++num_injected;
    }
    best = taker.cost();
    ASSERT_TRUE(verify(instance, taker.plan()).valid());
    ASSERT_EQ(best, taker.plan().cost(Objective::sum_of_costs));
  }
  EXPECT_GE(num_injected, 3U);
}

TEST(PlanImprover, KeepsAValidPlanWhereverItIsCut) {
  const Instance instance = crowd(30, 300, 9);
  const auto distances = distances_of(instance);
  const Plan first = searched(instance).plan();
  std::size_t num_cut_within = 0;
  for (int calls = 1; calls <= 60; ++calls) {
    // Many of the looks are inside a step.
    Limits limits;
    limits.looks = 16 * calls;
    LimitMonitor monitor(limits);
    PlanImprover improver(instance, distances, Objective::sum_of_costs, first, 0);
    Cost cost = improver.cost();
    Plan plan = improver.plan();
    while (!monitor.exhausted()) {
      const bool improved = improver.step(monitor);
      if (monitor.reason() != StopReason::none && !improved && improver.plan() == plan)
        ++num_cut_within;
      plan = improver.plan();
      ASSERT_LE(improver.cost(), cost);
      cost = improver.cost();
    }
    ASSERT_TRUE(verify(instance, improver.plan()).valid());
    ASSERT_FALSE(improver.step(monitor));
    ASSERT_EQ(improver.plan(), plan);
  }
  EXPECT_GE(num_cut_within, 10u);
}

TEST(Primal, ComesCloseToTheReferenceCostsOfBenchmarks) {
  const auto folder = quadrille::support::data_folder();
  if (!folder) GTEST_SKIP() << "QUADRILLE_DATA is not set";
  struct Row {
    std::string map;
    std::size_t num_agents;
    Cost optimum;
  };
  const std::vector<Row> rows{{"random-32-32-20", 50, 1147}, {"maze-32-32-2", 25, 1407},
                              {"room-32-32-4", 35, 962},     {"den312d", 80, 4332},
                              {"empty-16-16", 70, 753},      {"Berlin_1_256", 200, 35309}};
  for (const Row& row : rows) {
    const auto map = read_map(*folder + "/movingai/maps/" + row.map + ".map").value();
    const auto scenario =
        read_scenario(*folder + "/movingai/scens/" + row.map + "-random-1.scen").value();
    const Instance instance =
        make_instance(std::make_shared<const Graph>(map.graph()), scenario, row.num_agents).value();
    LimitMonitor limits{Limits{}};
    PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                          searched(instance).plan(), 0);
    improver.improve(1'000'000, limits);
    EXPECT_TRUE(verify(instance, improver.plan()).valid()) << row.map;
    EXPECT_GE(improver.cost(), row.optimum) << row.map;
    EXPECT_LE(improver.cost(), row.optimum + row.optimum / 100) << row.map;
  }
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
