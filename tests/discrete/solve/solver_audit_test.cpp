// SPDX-License-Identifier: MIT
// Clauses and cores against plans that are not the cheapest ones. In discrete time everything holds
// for all plans, whatever the incumbent costs: see sat::CostProblem.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "quadrille/discrete/primal.hpp"
#include "solve/tuning.hpp"
#include "support/distances.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

/// Some plan from `from` to `to`; empty if there is none, or none is found soon.
Plan plan_between(const Instance& instance, const std::vector<VertexId>& from,
                  const std::vector<VertexId>& to) {
  std::vector<Agent> tasks;
  for (std::size_t i = 0; i < from.size(); ++i) tasks.push_back({from[i], to[i]});
  const Instance part = Instance::make(instance.shared_graph(), std::move(tasks)).value();
  LimitMonitor limits{Limits{}};
  PrimalSearch search(part, distances_of(part), 0);
  return search.advance(1'000'000, limits) == PrimalSearch::State::found ? search.plan() : Plan();
}

/// Different vertices, from each of which its agent can reach its goal when it is alone. Requires
/// that the goals are reached from the starts.
std::vector<VertexId> stopovers(Random& random, const Instance& instance) {
  const auto distances = distances_of(instance);
  std::vector<VertexId> vertices, chosen;
  for (const VertexId v : IdRange<VertexId>(instance.graph().num_vertices())) vertices.push_back(v);
  random.shuffle(vertices);
  for (const AgentId i : instance.agent_ids()) {
    const auto at = std::find_if(vertices.begin(), vertices.end(), [&](VertexId v) {
      return (*distances)(i, v) != kUnreachable &&
             std::find(chosen.begin(), chosen.end(), v) == chosen.end();
    });
    if (at == vertices.end()) return {};
    chosen.push_back(*at);
  }
  return chosen;
}

/// By way of stopovers, with waits in between: what the agents do, they do for no reason. Where
/// they do not get that far, all wait before they follow the given plan.
Plan detour(Random& random, const Instance& instance, const Plan& straight) {
  std::vector<VertexId> starts, goals;
  for (const Agent& task : instance.agents()) {
    starts.push_back(task.start);
    goals.push_back(task.goal());
  }
  const std::vector<VertexId> between = stopovers(random, instance);
  Plan plan, rest;
  if (!between.empty()) {
    plan = plan_between(instance, starts, between);
    rest = plan_between(instance, between, goals);
  }
  if (plan.paths.empty() || rest.paths.empty()) {
    plan = Plan();
    for (const VertexId start : starts) plan.paths.push_back({start});
    rest = straight;
  }
  std::size_t length = random.between(1, 3);
  for (const Path& path : plan.paths) length = std::max(length, path.size() + random.below(2));
  for (const AgentId i : instance.agent_ids()) {
    Path& path = plan.paths[i];
    path.resize(length, path.back());
    path.insert(path.end(), rest.paths[i].begin(), rest.paths[i].end());
  }
  return plan;
}

struct Count {
  int plans = 0, dear = 0;
};

/// All systems, each with a plan of its own, which ends at the goals of `choice`.
void expect_that_all_allow_detours(const Instance& instance, const Instance& choice, Random& random,
                                   Count& count) {
  const Objective objective = random.percent(70) ? Objective::sum_of_costs : Objective::makespan;
  const JointAnswer chosen = joint_search(choice, objective);
  if (chosen.status != Status::optimal) return;
  const JointAnswer expected =
      instance.has_goal_sets() ? joint_search(instance, objective) : chosen;
  ASSERT_EQ(expected.status, Status::optimal);
  for (TunedOptions& options : random_systems(random, objective)) {
    const Plan plan = detour(random, choice, chosen.plan);
    ASSERT_EQ(replay(instance, plan), "");
    ++count.plans;
    count.dear += plan.cost(objective) > expected.cost ? 1 : 0;
    options.threads = 1;
    options.debug.audit = random.percent(50);
    options.debug.known_plan = plan;
    if (options.initial_plan) options.initial_plan = plan;
    options.first_plan = random.percent(70);
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_EQ(find_fault(instance, options, outcome, expected), "")
        << outcome.explanation << "\n"
        << to_string(options.system) << "\n";
  }
}

/// Goals for all out of their sets, whatever they cost. Itself where they take the same ones.
Instance any_choice(Random& random, const Instance& instance) {
  std::vector<Agent> tasks;
  for (const Agent& task : instance.agents()) {
    const auto own = task.goals.vertices();
    tasks.push_back({task.start, own[random.below(own.size())]});
  }
  auto made = instance.with_agents(std::move(tasks));
  return made ? std::move(made).value() : instance;
}

class SolverAudit : public testing::TestWithParam<int> {};

TEST_P(SolverAudit, NoClauseExcludesAPlanThatCostsMore) {
  Count count;
  for (std::size_t number = 0; number < scaled(100); ++number) {
    const std::uint64_t seed = static_cast<std::uint64_t>(GetParam()) * 1'000'000 + number;
    SCOPED_TRACE(seed);
    Random random(seed);
    const Instance instance =
        random.percent(50) ? random_grid(random, {2, 4, 30, 2, 4}) : random_graph(random, 8, 4);
    expect_that_all_allow_detours(instance, instance, random, count);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(count.dear, count.plans / 2);
  EXPECT_GT(count.plans, static_cast<int>(scaled(100)));
}

TEST_P(SolverAudit, NoClauseExcludesAPlanWithOtherGoals) {
  Count count;
  for (std::size_t number = 0; number < scaled(100); ++number) {
    const std::uint64_t seed = static_cast<std::uint64_t>(50 + GetParam()) * 1'000'000 + number;
    SCOPED_TRACE(seed);
    Random random(seed);
    const Instance plain =
        random.percent(50) ? random_grid(random, {2, 4, 30, 2, 4}) : random_graph(random, 8, 4);
    const Instance instance =
        random.percent(50) ? with_more_goals(random, plain) : with_group_goals(random, plain);
    const Instance choice = any_choice(random, instance);
    if (choice.has_goal_sets()) continue;
    expect_that_all_allow_detours(instance, choice, random, count);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(count.dear, count.plans / 2);
  EXPECT_GT(count.plans, static_cast<int>(scaled(50)));
}

/// Turns from above begin with the first conflict.
SolveOutcome solve_from_above(const Instance& instance, const SolveOptions& options) {
  const Tuner tuner = [&](const SolveOptions& of_search) {
    Tuning tuning = choose_tuning(features_of(instance), of_search);
    tuning.cores.from_above = true;
    tuning.settings.core_turn = 1;
    tuning.settings.core_passes = 1;
    tuning.settings.core_head_start = 1;
    return tuning;
  };
  return solve_tuned(instance, options, tuner).value();
}

// Larger and denser: the first plan is mostly not the best one, cores are hard, and there are turns
// from above, whose bounds come from the incumbent.
TEST_P(SolverAudit, TheSearchFromAboveExcludesNoPlanThatCostsMore) {
  int solved = 0, dear = 0, different = 0;
  for (std::size_t number = 0; number < scaled(10); ++number) {
    const std::uint64_t seed = static_cast<std::uint64_t>(GetParam()) * 1'000'000 + number;
    SCOPED_TRACE(seed);
    Random random(seed);
    const Instance instance = random_grid(random, {6, 8, 15, 12, 18});
    TunedOptions options;
    options.limits.conflicts = 4000;
    const SolveOutcome expected = solve(instance, options).value();
    if (expected.status != Status::optimal) continue;
    options.limits = {};
    options.debug.audit = true;
    options.debug.known_plan = detour(random, instance, *expected.plan);
    ASSERT_EQ(replay(instance, *options.debug.known_plan), "");
    // Without an incumbent bounds on the sum come first.
    for (const bool first_plan : {true, false}) {
      options.first_plan = first_plan;
      const SolveOutcome outcome = solve_from_above(instance, options);
      ASSERT_EQ(outcome.status, Status::optimal) << outcome.explanation;
      ASSERT_EQ(outcome.cost, expected.cost);
      different += outcome.statistics.sat_calls != expected.statistics.sat_calls ? 1 : 0;
    }
    ++solved;
    dear += options.debug.known_plan->cost(Objective::sum_of_costs) > *expected.cost ? 1 : 0;
  }
  EXPECT_GE(2 * solved, static_cast<int>(scaled(10)));
  EXPECT_EQ(dear, solved);
  EXPECT_GE(different, solved) << "there are turns from above";
}

INSTANTIATE_TEST_SUITE_P(Shard, SolverAudit, testing::Range(0, 4));

}  // namespace
}  // namespace quadrille::discrete::support
