// SPDX-License-Identifier: MIT
// Agents that may end at any one of several goals: answers against the joint search, claims about
// parts of bounds against the joint search of their agents, and what is refused.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "feasibility/goal_choice.hpp"
#include "feasibility/goal_reach.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/plan_improver.hpp"
#include "quadrille/discrete/primal.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::only_system;
using quadrille::support::scaled;

struct Count {
  int solved = 0, infeasible = 0;
};

void compare(const Instance& instance, Random& random, const std::string& origin, Count& count) {
  const Objective objective = random.percent(60) ? Objective::sum_of_costs : Objective::makespan;
  const JointAnswer expected = joint_search(instance, objective);
  ASSERT_NE(expected.status, Status::unknown) << origin;
  count.infeasible += expected.status == Status::infeasible ? 1 : 0;
  for (const TunedOptions& options : random_systems(random, objective)) {
    if (!only_system().empty() && to_string(options.system) != only_system()) continue;
    const std::string fault = solve_and_compare(instance, options, expected, origin);
    ASSERT_EQ(fault, "") << fault;
    ++count.solved;
  }
}

template <class Draw>
void run_shard(const char* name, int shard, std::size_t cases, const Draw& draw) {
  Count count;
  for (std::size_t number = 0; number < scaled(cases); ++number) {
    const std::uint64_t seed = static_cast<std::uint64_t>(shard) * 1'000'000 + number;
    Random random(seed);
    const Instance plain = draw(random);
    const Instance instance =
        random.percent(50) ? with_more_goals(random, plain) : with_group_goals(random, plain);
    compare(instance, random, name + (" with goal sets, seed " + std::to_string(seed)), count);
    if (testing::Test::HasFailure()) return;
  }
  testing::Test::RecordProperty("solved", count.solved);
  testing::Test::RecordProperty("infeasible", count.infeasible);
}

class GoalSets : public testing::TestWithParam<int> {};

TEST_P(GoalSets, SmallGrids) {
  run_shard("small grid", 400 + GetParam(), 400, [](Random& random) {
    GridShape shape;
    shape.max_agents = random.percent(50) ? 2 : 3;
    if (random.percent(25)) shape = {1, 3, 30, 4, 4};
    return random_grid(random, shape);
  });
}

TEST_P(GoalSets, CrowdedBoards) {
  run_shard("crowded board", 500 + GetParam(), 40, [](Random& random) {
    return random_grid(random, {2, 3, 15, 4, 5});
  });
}

TEST_P(GoalSets, SmallGraphs) {
  run_shard("small graph", 600 + GetParam(), 200,
            [](Random& random) { return random_graph(random, 9, 4); });
}

INSTANTIATE_TEST_SUITE_P(Shard, GoalSets, testing::Range(0, 6));

Instance corridor(std::vector<Agent> agents) {
  return Instance::make(Graph::grid(5, 1, std::vector<bool>(5, true)), std::move(agents)).value();
}

TEST(GoalSet, EachAgentTakesTheGoalThatIsCheapestForAll) {
  const auto v = [](std::size_t x) { return VertexId(x); };
  // Both are nearest to 2, and cannot pass each other.
  const Instance instance = corridor({{v(0), Goals({v(1), v(2)})}, {v(4), Goals({v(2), v(1)})}});
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    for (TunedOptions& options : all_systems(objective)) {
      options.debug.audit = true;
      const SolveOutcome outcome = solve(instance, options).value();
      ASSERT_EQ(outcome.status, Status::optimal);
      EXPECT_EQ(*outcome.cost, objective == Objective::sum_of_costs ? 3 : 2);
      EXPECT_EQ(outcome.plan->paths[AgentId(0)].back(), v(1));
      EXPECT_EQ(outcome.plan->paths[AgentId(1)].back(), v(2));
    }
}

TEST(GoalSet, TheOnlyGoalOfAnotherIsTaken) {
  const auto v = [](std::size_t x) { return VertexId(x); };
  const Instance instance = corridor({{v(0), v(1)}, {v(2), Goals({v(1), v(4)})}});
  const SolveOutcome outcome = solve(instance, SolveOptions()).value();
  ASSERT_EQ(outcome.status, Status::optimal);
  EXPECT_EQ(*outcome.cost, 3);
  EXPECT_EQ(outcome.plan->paths[AgentId(1)].back(), v(4));
}

TEST(GoalSet, MoreAgentsThanGoalsAreInfeasible) {
  const auto v = [](std::size_t x) { return VertexId(x); };
  const Goals two({v(1), v(2)});
  const Instance instance = corridor({{v(0), two}, {v(2), two}, {v(4), two}});
  const Feasibility verdict = check_feasibility(instance);
  EXPECT_FALSE(verdict.feasible);
  EXPECT_TRUE(verdict.is_decided);
  EXPECT_EQ(verdict.reason, "agents 0, 1 and 2 can only end at 2 different goals");
  EXPECT_EQ(solve(instance, SolveOptions()).value().status, Status::infeasible);
}

TEST(GoalSet, InstancesRefuseWhatCannotBe) {
  const Graph graph = Graph::grid(2, 1, {1, 1});
  EXPECT_EQ(Instance::make(graph, {{VertexId(0), Goals(std::vector<VertexId>{})}}).error().message,
            "agent 0 has no goal");
  EXPECT_EQ(Instance::make(graph, {{VertexId(0), Goals({VertexId(0), VertexId(2)})}}).error().code,
            ErrorCode::invalid_instance);
}

// Many who share many: whoever could go where does not fit into this memory.
TEST(GoalSet, WhoCanGoWhereIsWithinTheMemoryLimit) {
  const Graph graph = Graph::grid(40, 40, std::vector<bool>(1600, true));
  std::vector<VertexId> all;
  for (std::size_t v = 0; v < 1600; ++v) all.emplace_back(v);
  const Goals shared(all);
  std::vector<Agent> agents;
  for (const VertexId v : all) agents.push_back({v, shared});
  const Instance instance = Instance::make(graph, std::move(agents)).value();
  Limits limits;
  limits.memory_mib = 40;
  LimitMonitor monitor(limits);
  EXPECT_FALSE(choose_goals(instance, &monitor).chosen);
  EXPECT_EQ(monitor.reason(), StopReason::memory);
}

TEST(GoalSet, FirstPlansAndTheirImprovementEndAtGoals) {
  int found = 0, num_priced = 0;
  for (std::uint64_t seed = 0; seed < scaled(100); ++seed) {
    Random random(seed);
    const Instance plain = random_grid(random, {4, 6, 20, 3, 9});
    const Instance instance =
        seed % 2 == 0 ? with_more_goals(random, plain) : with_group_goals(random, plain);
    LimitMonitor limits{Limits{}};
    const auto plan = find_plan(instance, limits, 0);
    const Feasibility verdict = check_feasibility(instance);
    ASSERT_TRUE(!verdict.is_decided || verdict.feasible == plan.has_value()) << seed;
    if (!plan) continue;
    ++found;
    ASSERT_TRUE(verify(instance, *plan).valid()) << seed;
    const auto distances = GoalDistances::make(instance, limits);
    PlanImprover improver(instance, distances, Objective::sum_of_costs, *plan, 0);
    static_cast<void>(improver.improve(100'000, limits));
    ASSERT_TRUE(verify(instance, improver.plan()).valid()) << seed;
    ASSERT_LE(improver.cost(), plan->cost(Objective::sum_of_costs)) << seed;
    const auto priced = price_goals(instance, limits);
    if (!priced) continue;
    ++num_priced;
    PlanImprover fair(instance, priced->distances, Objective::sum_of_costs, *plan, 0);
    Cost cost = plan->cost(Objective::sum_of_costs);
    for (int step = 0; step < 200; ++step) {
      static_cast<void>(fair.step(limits));
      ASSERT_TRUE(verify(instance, fair.plan()).valid()) << seed;
      ASSERT_EQ(fair.cost(), fair.plan().cost(Objective::sum_of_costs)) << seed;
      ASSERT_LE(fair.cost(), cost) << seed;
      cost = fair.cost();
    }
  }
  if (scaled(100) < 100) return;  // too few to count on chance
  EXPECT_GT(found, 50);
  EXPECT_GT(num_priced, 10);
}

}  // namespace
}  // namespace quadrille::discrete::support
