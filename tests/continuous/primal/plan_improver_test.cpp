// SPDX-License-Identifier: MIT
#include "primal/plan_improver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "continuous/routes/order_search.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::int64_t kEffort = 3'000;

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
    PlanImprover improver(scene);
    Plan plan = oracle.some_plans.back();
    const Cost before = cost(plan, Objective::sum_of_costs);
    improver.improve(plan, kEffort);
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

}  // namespace
}  // namespace quadrille::continuous::test
