// SPDX-License-Identifier: MIT
#include "primal/plan_improver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "continuous/routes/order_search.hpp"
#include "continuous/support/few_looks.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr Effort kEffort = Effort::microseconds(75), kTurn = Effort::microseconds(2500);

TEST(PlanImprover, StaysAboveTheOptimum) {
  int cheaper = 0, optimal = 0, count = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    RandomOptions random;
    random.num_agents = 3;
    random.num_vertices = 5 + seed % 3;
    const Instance instance = random_instance(seed, random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const OrderSearch oracle = search_orders(instance, Objective::sum_of_costs, 3);
    if (oracle.some_plans.empty()) continue;
    LimitMonitor limits({});
    Scene scene(instance, limits);
    const Cost before = cost(oracle.some_plans.back(), Objective::sum_of_costs);
    PlanImprover improver(scene, oracle.some_plans.back());
    improver.improve(kEffort);
    const Plan& plan = improver.plan();
    const Cost after = cost(plan, Objective::sum_of_costs);
    ASSERT_TRUE(verify(instance, plan).valid());
    ASSERT_LE(after, before);
    Cost longest = 0;
    for (const Path& path : plan.paths) longest = std::max(longest, Cost(path.size()));
    if (longest <= 4) {
      ASSERT_GE(after, *oracle.best);
    }
    ++count;
    cheaper += static_cast<int>(after < before);
    optimal += static_cast<int>(after <= *oracle.best);
  }
  EXPECT_GE(count, 20);
  EXPECT_GE(cheaper, 5);
  EXPECT_GE(2 * optimal, count);
  RecordProperty("cheaper", cheaper);
  RecordProperty("optimal", optimal);
}

/// Random ones for which the oracle finds several plans.
std::vector<Instance> instances_with_plans(std::size_t count) {
  std::vector<Instance> instances;
  for (std::uint32_t seed = 0; instances.size() < count; ++seed) {
    RandomOptions random;
    random.num_agents = 3;
    random.num_vertices = 6 + seed % 3;
    Instance instance = random_instance(seed, random);
    if (search_orders(instance, Objective::sum_of_costs, 3).some_plans.size() > 1)
      instances.push_back(std::move(instance));
  }
  return instances;
}

TEST(PlanImprover, GoesOnFromAnyPlan) {
  for (const Instance& instance : instances_with_plans(20)) {
    SCOPED_TRACE(describe(instance));
    const auto plans = search_orders(instance, Objective::sum_of_costs, 3).some_plans;
    LimitMonitor limits({});
    Scene scene(instance, limits);
    PlanImprover improver(scene, plans.front());
    for (const Plan& plan : plans) {
      improver.restart_from(plan);
      ASSERT_EQ(improver.plan(), plan);
      const Effort before = improver.effort(), slice = Effort::nanoseconds(12'500);
      const bool is_better = improver.improve(slice);
      ASSERT_EQ(is_better, improver.cost() < cost(plan, Objective::sum_of_costs));
      ASSERT_EQ(improver.cost(), cost(improver.plan(), Objective::sum_of_costs));
      ASSERT_TRUE(verify(instance, improver.plan()).valid());
      if (!improver.is_done()) {
        ASSERT_GE(improver.effort(), before + slice);
      }
    }
  }
}

TEST(PlanImprover, StopsWhenItPaysNoMore) {
  for (const Instance& instance : instances_with_plans(5)) {
    SCOPED_TRACE(describe(instance));
    const Plan plan = search_orders(instance, Objective::sum_of_costs, 3).some_plans.back();
    std::vector<Plan> results;
    for (int run = 0; run < 2; ++run) {
      LimitMonitor limits({});
      Scene scene(instance, limits);
      PlanImprover improver(scene, plan);
      bool is_better = false;
      while (improver.pays()) is_better |= improver.improve(kTurn);
      EXPECT_EQ(is_better, improver.cost() < cost(plan, Objective::sum_of_costs));
      EXPECT_LT(improver.effort(), 200 * kTurn);
      EXPECT_FALSE(improver.improve(kTurn)) << "much was tried in vain";
      results.push_back(improver.plan());
    }
    EXPECT_EQ(results[0], results[1]);
  }
}

TEST(PlanImprover, KeepsAValidPlanWhereverItIsCut) {
  const Instance instance = instances_with_plans(1).front();
  const Plan plan = search_orders(instance, Objective::sum_of_costs, 3).some_plans.back();
  int num_cut = 0;
  at_each_look(instance, 200, 3, [&](Scene& scene, LimitMonitor& limits) {
    PlanImprover improver(scene, plan);
    while (improver.pays() && !limits.exhausted()) static_cast<void>(improver.improve(kTurn));
    ASSERT_TRUE(verify(instance, improver.plan()).valid());
    ASSERT_LE(improver.cost(), cost(plan, Objective::sum_of_costs));
    ++num_cut;
  });
  EXPECT_GE(num_cut, 40);
}

}  // namespace
}  // namespace quadrille::continuous::test
