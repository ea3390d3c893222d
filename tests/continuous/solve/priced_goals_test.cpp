// SPDX-License-Identifier: MIT
// Prices of goals against all choices of goals on small roadmaps, and plans that go to and fro
// between an instance and that with prices.
#include "solve/priced_goals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

RandomOptions with_sets(std::uint32_t seed) {
  RandomOptions random;
  random.num_agents = 2 + seed % 4;
  random.num_vertices = 5 + seed % 3;
  random.size = 200;
  random.goal_sets_percent = 90;
  random.deadline_percent = 0;
  return random;
}

/// When the agent arrives at the earliest if it is alone; by edges, again and again.
std::vector<Cost> arrivals(const Instance& instance, AgentId i) {
  const Roadmap& roadmap = instance.roadmap();
  const ClassId c = instance.class_of(i);
  std::vector<Cost> at(roadmap.num_vertices(), -1);
  at[instance.agent(i).start.index()] = as_cost(instance.agent(i).release);
  for (std::size_t round = 0; round < roadmap.num_vertices(); ++round)
    for (const EdgeId e : IdRange<EdgeId>(roadmap.num_edges())) {
      const Cost from = at[roadmap.edge(e).from.index()];
      if (from < 0 || !instance.may_use(c, e)) continue;
      Cost& to = at[roadmap.edge(e).to.index()];
      const Cost via = from + as_cost(instance.duration(c, e));
      if (to < 0 || via < to) to = via;
    }
  return at;
}

/// The least sum of arrivals; no two agents that stay end in one place.
std::optional<Cost> least_choice(const Instance& instance, std::size_t agent,
                                 std::vector<VertexId>& taken) {
  if (agent == instance.num_agents()) return 0;
  const Agent& task = instance.agent(AgentId(agent));
  const std::vector<Cost> at = arrivals(instance, AgentId(agent));
  std::optional<Cost> least;
  for (const VertexId goal : task.goals.vertices()) {
    const bool is_start = goal == task.start;
    if (at[goal.index()] < 0 ||
        (!task.leaves && std::find(taken.begin(), taken.end(), goal) != taken.end()))
      continue;
    if (!task.leaves) taken.push_back(goal);
    if (const auto rest = least_choice(instance, agent + 1, taken)) {
      const Cost cost = *rest + (is_start ? 0 : at[goal.index()]);
      least = std::min(least.value_or(cost), cost);
    }
    if (!task.leaves) taken.pop_back();
  }
  return least;
}

// With prices too low, or too high, the least costs would not come to that: every plan's cost would
// still be told right, and the bound would be a worse one.
TEST(PricedGoals, RaiseTheLeastCostsToACheapestChoice) {
  const auto count = static_cast<std::uint32_t>(support::scaled(3000));
  int num_priced = 0, num_with_fees = 0;
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    const Instance instance = random_instance(seed, with_sets(seed));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    LimitMonitor limits{Limits{}};
    const auto priced = PricedGoals::make(instance, limits);
    if (!priced) continue;
    ++num_priced;
    num_with_fees += priced->fees().empty() ? 0 : 1;
    Cost bound = -priced->paid();
    for (const AgentId i : instance.agent_ids())
      bound += as_cost(free_cost(priced->instance(), i).value());
    std::vector<VertexId> taken;
    ASSERT_EQ(bound, least_choice(instance, 0, taken));
  }
  if (count < 3000) return;
  EXPECT_GT(num_priced, 300);
  EXPECT_GT(num_with_fees, 100);
}

TEST(PricedGoals, PlansAreTheSameButForCosts) {
  const auto count = static_cast<std::uint32_t>(support::scaled(2000));
  int num_plans = 0;
  for (std::uint32_t seed = 1'000'000; seed < 1'000'000 + count; ++seed) {
    const Instance instance = random_instance(seed, with_sets(seed));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    LimitMonitor limits{Limits{}};
    const auto priced = PricedGoals::make(instance, limits);
    if (!priced) continue;
    SolveOptions options;
    options.objective = Objective::makespan;  // without prices
    options.limits.looks = 2000;
    const auto plan = solve(instance, options).value().plan;
    if (!plan) continue;
    ++num_plans;
    Plan other = *plan;
    priced->enter(other);
    ASSERT_TRUE(verify(priced->instance(), other).valid());
    Cost fees = 0;
    for (const Fee& fee : priced->fees()) fees += ends_at(other, fee.goal) ? 0 : fee.amount;
    ASSERT_EQ(cost(other, Objective::sum_of_costs) + fees,
              cost(*plan, Objective::sum_of_costs) + priced->paid());
    priced->leave(other);
    ASSERT_EQ(other, *plan);
  }
  if (count < 2000) return;
  EXPECT_GT(num_plans, 200);
}

// Two polygons that lie beside their positions may end in one place.
TEST(PricedGoals, AreNoneWhereAGoalServesTwo) {
  const auto wing = [](std::int64_t side) {
    const Length near(side * 100), far(side * 200);
    return ConvexPolygon::make({{near, -50}, {far, -50}, {far, 50}}).value();
  };
  const auto docker = [](std::size_t start, Body body) {
    Agent made = agent(start, start, 300);
    made.goals = Goals({VertexId(2), VertexId(3)});
    made.body = std::move(body);
    return made;
  };
  const std::vector<Point> row{{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}};
  const Roads roads{{0, 1}, {1, 2}, {2, 3}};
  LimitMonitor limits{Limits{}};
  const auto discs =
      Instance::make(roadmap(row, roads), {docker(0, Disc{300}), docker(1, Disc{300})}).value();
  EXPECT_TRUE(PricedGoals::make(discs, limits));
  const auto wings =
      Instance::make(roadmap(row, roads), {docker(0, wing(-1)), docker(1, wing(1))}).value();
  EXPECT_FALSE(PricedGoals::make(wings, limits));
  SolveOptions options;
  options.joint_work = 0;
  EXPECT_EQ(solve(wings, options).value().cost, 3000);
}

}  // namespace
}  // namespace quadrille::continuous::test
