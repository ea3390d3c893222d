// SPDX-License-Identifier: MIT
// The makespan of agents that share all goals, by flow: against the joint search on small graphs,
// and as an oracle of the search by clauses on larger ones.
#include "flow/one_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

constexpr std::int64_t kNoEnd = std::numeric_limits<std::int64_t>::max();

/// All agents of the instance may end at `num_goals` vertices of those that somebody can reach.
Instance with_one_set(Random& random, const Instance& instance, std::size_t num_goals) {
  std::vector<VertexId> goals;
  for (const Agent& task : instance.agents()) goals.push_back(task.goal());
  while (goals.size() < num_goals)
    goals.emplace_back(random.below(instance.graph().num_vertices()));
  std::vector<Agent> tasks;
  for (const Agent& task : instance.agents()) tasks.push_back({task.start, Goals(goals)});
  return instance.with_agents(std::move(tasks)).value();
}

std::vector<AgentId> all_of(const Instance& instance) {
  std::vector<AgentId> all;
  for (const AgentId i : instance.agent_ids()) all.push_back(i);
  return all;
}

TEST(OneGroup, TakesAsLongAsTheJointSearch) {
  int num_compared = 0, num_longer = 0;
  for (std::uint64_t seed = 0; seed < scaled(3000); ++seed) {
    Random random(seed);
    const Instance drawn =
        random.percent(50) ? random_graph(random, 8, 5) : random_grid(random, {1, 3, 30, 2, 4});
    const Instance instance = with_one_set(random, drawn, drawn.num_agents() + random.below(3));
    const JointAnswer expected = joint_search(instance, Objective::makespan);
    if (expected.status != Status::optimal) continue;
    LimitMonitor limits{Limits{}};
    const GroupMakespan flow = least_makespan(instance, all_of(instance), kNoEnd, limits);
    ASSERT_TRUE(flow.paths) << seed;
    ASSERT_EQ(flow.lower, expected.cost) << seed;
    const Plan plan{IdVector<AgentId, Path>(*flow.paths)};
    const VerifyReport report = verify(instance, plan);
    ASSERT_TRUE(report.valid()) << seed << report.violations.front().message;
    ASSERT_EQ(report.makespan, expected.cost) << seed;
    ++num_compared;
    Timestep nearest = 0;
    for (const Agent& task : instance.agents())
      nearest = std::max(nearest, distances_to_nearest(instance.graph(), task.goals)[task.start]);
    num_longer += flow.lower > nearest ? 1 : 0;
  }
  EXPECT_GE(num_compared, static_cast<int>(scaled(2000)));
  EXPECT_GE(num_longer, static_cast<int>(scaled(80)));
}

// The search by clauses is asked with an explanation, for which flows do not answer.
TEST(OneGroup, AgreesWithTheSearchByClauses) {
  int num_compared = 0;
  for (std::uint64_t seed = 0; seed < scaled(60); ++seed) {
    Random random(seed);
    const Instance drawn = random_grid(random, {6, 10, 25, 6, 14});
    const Instance instance = with_one_set(random, drawn, drawn.num_agents() + random.below(5));
    SolveOptions options;
    options.objective = Objective::makespan;
    const SolveOutcome by_flow = solve(instance, options).value();
    if (by_flow.status == Status::infeasible) continue;
    ASSERT_EQ(by_flow.status, Status::optimal) << seed;
    ASSERT_EQ(by_flow.statistics.sat_calls, 0) << seed;
    options.explain = true;
    options.limits.conflicts = 2000;
    const SolveOutcome by_clauses = solve(instance, options).value();
    ASSERT_LE(by_clauses.lower_bound, *by_flow.cost) << seed;
    if (by_clauses.status != Status::optimal) continue;
    ASSERT_EQ(by_clauses.cost, by_flow.cost) << seed;
    ++num_compared;
  }
  EXPECT_GE(num_compared, static_cast<int>(scaled(20)));
}

// Two groups: each of them takes so long at least.
TEST(OneGroup, OfSeveralIsABound) {
  int num_compared = 0;
  for (std::uint64_t seed = 0; seed < scaled(500); ++seed) {
    Random random(seed);
    const Instance drawn = random_graph(random, 8, 5);
    std::vector<Agent> tasks;
    std::vector<VertexId> goals[2];
    for (const AgentId i : drawn.agent_ids())
      goals[i.index() % 2].push_back(drawn.agents()[i].goal());
    for (const AgentId i : drawn.agent_ids())
      tasks.push_back({drawn.agents()[i].start, Goals(goals[i.index() % 2])});
    const auto instance = drawn.with_agents(std::move(tasks));
    if (!instance) continue;
    const JointAnswer expected = joint_search(*instance, Objective::makespan);
    if (expected.status != Status::optimal) continue;
    SolveOptions options;
    options.objective = Objective::makespan;
    ASSERT_EQ(solve(*instance, options).value().cost, expected.cost) << seed;
    ++num_compared;
  }
  EXPECT_GE(num_compared, static_cast<int>(scaled(150)));
}

TEST(OneGroup, EndsWithABoundAfterItsSteps) {
  Random random(7);
  const Instance drawn = random_grid(random, {9, 9, 20, 10, 10});
  const Instance instance = with_one_set(random, drawn, drawn.num_agents());
  LimitMonitor limits{Limits{}};
  const GroupMakespan whole = least_makespan(instance, all_of(instance), kNoEnd, limits);
  const GroupMakespan part = least_makespan(instance, all_of(instance), 10, limits);
  ASSERT_TRUE(whole.paths);
  EXPECT_FALSE(part.paths);
  EXPECT_GT(part.lower, 0);
  EXPECT_LE(part.lower, whole.lower);
}

}  // namespace
}  // namespace quadrille::discrete::support
