// SPDX-License-Identifier: MIT
#include "routes/cost_floors.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "continuous/routes/order_search.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

std::vector<Cost> floors_of(const Instance& instance) {
  LimitMonitor limits{Limits{}};
  Scene scene(instance, limits);
  return cost_floors(scene);
}

/// A line of four, with an alcove at its second place.
std::vector<Point> line() { return {{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}, {1000, 900}}; }

TEST(CostFloors, WhoStandsOnTheOnlyWayWaitsUntilTheOthersHavePassed) {
  const auto map = roadmap(line(), Roads{{0, 1}, {1, 2}, {2, 3}, {1, 4}});
  const Instance instance = Instance::make(map, {agent(0, 3, 300), agent(2, 2, 300)}).value();
  // The first one is at 1000 at the earliest when it begins the move to 2000, and at 2000 when it
  // begins the one to 3000, which is in contact for as long as the centres are nearer than 600.
  EXPECT_EQ(floors_of(instance), (std::vector<Cost>{3000, 2600}));
}

TEST(CostFloors, WhoCanGoAroundAsksForNothing) {
  const auto map =
      roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 900}}, Roads{{0, 1}, {1, 2}, {0, 3}, {3, 2}});
  const Instance instance = Instance::make(map, {agent(0, 2, 300), agent(1, 1, 300)}).value();
  EXPECT_EQ(floors_of(instance), (std::vector<Cost>{2000, 0}));
}

TEST(CostFloors, NoPlanIsBelow) {
  int raised = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(200); ++seed) {
    RandomOptions options;
    options.edge_percent = 35;
    const Instance instance = random_instance(seed, options);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const std::vector<Cost> floors = floors_of(instance);
    const OrderSearch oracle = search_orders(instance, Objective::sum_of_costs, 4);
    LimitMonitor limits{Limits{}};
    Scene scene(instance, limits);
    for (const AgentId i : instance.agent_ids()) {
      raised += floors[i.index()] > scene.free_cost(i) ? 1 : 0;
      for (const Plan& plan : oracle.some_plans)
        ASSERT_GE(cost(plan.paths[i]), floors[i.index()]) << "agent " << i.index();
      if (oracle.best) {
        ASSERT_GE(cost(oracle.best_plan.paths[i]), floors[i.index()]);
      }
    }
  }
  EXPECT_GT(raised, 0);
}

}  // namespace
}  // namespace quadrille::continuous::test
