// SPDX-License-Identifier: MIT
// Limits: a search that is cut short anywhere claims nothing that is not true.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include "continuous/formats/file_support.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

struct Case {
  Instance instance;
  SolveOptions options;
  SolveOutcome truth;
};

/// Instances that are solved to optimality, each with a part of the searches that there are.
std::vector<Case> cases(std::size_t count) {
  std::vector<Case> found;
  for (std::uint32_t seed = 1; found.size() < count && seed < 200; ++seed) {
    RandomOptions random;
    random.num_vertices = 14;
    random.num_agents = 3 + seed % 2;
    random.size = 100;
    random.edge_percent = 25;
    const Instance instance = random_instance(seed, random);
    SolveOptions options;
    options.objective = seed % 2 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.system = seed % 3 == 0 ? System::smt_cbs : System::dpll;
    if (seed % 5 != 0) options.joint_work = options.route_work = 0;
    options.limits.conflicts = 1000;
    options.limits.cpu_s = 1;
    SolveOutcome truth = solve(instance, options).value();
    if (truth.status != Status::optimal || truth.statistics.sat_calls == 0) continue;
    options.limits = {};
    found.push_back({instance, options, std::move(truth)});
  }
  return found;
}

/// What the agents cost when each is alone, and no obstacle is there.
Cost alone(const Instance& instance, Objective objective) {
  Cost sum = 0, most = 0;
  for (const AgentId i : instance.agent_ids()) {
    const Cost cost = as_cost(free_cost(instance, i).value());
    sum += cost;
    most = std::max(most, cost);
  }
  return objective == Objective::sum_of_costs ? sum : most;
}

TEST(SolverLimits, CutAtAnyLookNothingFalseIsClaimed) {
  constexpr std::int64_t kLooks = 400;
  const std::int64_t stride = kLooks / static_cast<std::int64_t>(support::scaled(kLooks / 2));
  int num_cut = 0, num_plans = 0;
  for (const Case& c : cases(12))
    for (std::int64_t looks = 1; looks <= kLooks; looks += stride) {
      SCOPED_TRACE(describe(c.instance) + " looks " + std::to_string(looks));
      SolveOptions options = c.options;
      options.limits.looks = looks;
      const SolveOutcome outcome = solve(c.instance, options).value();
      ASSERT_FALSE(outcome.internal_error);
      ASSERT_GE(outcome.lower_bound, alone(c.instance, options.objective));
      ASSERT_LE(outcome.lower_bound, *c.truth.cost);
      ASSERT_NE(outcome.status, Status::infeasible);
      ASSERT_EQ(outcome.plan.has_value(), outcome.status != Status::unknown);
      if (outcome.plan) {
        ++num_plans;
        ASSERT_TRUE(verify(c.instance, *outcome.plan).valid());
        ASSERT_GE(*outcome.cost, *c.truth.cost);
      }
      if (outcome.status == Status::optimal) {
        ASSERT_EQ(*outcome.cost, *c.truth.cost);
        continue;
      }
      ASSERT_EQ(outcome.stop, StopReason::interrupt) << to_string(outcome.stop);
      ++num_cut;
    }
  EXPECT_GT(num_cut, kLooks / stride);
  // Scaled down, for slow builds, there are fewer and other cases: too few to count on chance.
  if (stride <= 2) {
    EXPECT_GT(num_plans, 0);
  }
}

// Whatever ends a search before it begins: how far the goals are is known.
TEST(SolverLimits, TheFreeBoundIsNeverLost) {
  const std::atomic<bool> interrupt = true;
  std::vector<Limits> all(4);
  all[0].wall_s = 0;
  all[1].cpu_s = 0;
  all[2].conflicts = 0;
  all[3].interrupt = &interrupt;
  RandomOptions random;
  random.num_vertices = 20;
  random.num_agents = 6;
  random.size = 200;
  random.edge_percent = 25;
  random.obstacles_percent = random.release_percent = 50;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Instance instance = random_instance(seed, random);
    for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
      for (const System system : {System::dpll, System::smt_cbs})
        for (const Limits& limits : all)
          for (const std::size_t threads : {std::size_t{1}, std::size_t{2}}) {
            SolveOptions options;
            options.objective = objective;
            options.system = system;
            options.limits = limits;
            options.threads = threads;
            const SolveOutcome outcome = solve(instance, options).value();
            ASSERT_GE(outcome.lower_bound, alone(instance, objective)) << describe(instance);
            ASSERT_GT(outcome.lower_bound, 0);
          }
  }
}

// A limit of conflicts leaves time to sum up what takes longer than other limits allow.
TEST(SolverLimits, TheFreeBoundIsWholeWhereTimeIsLeft) {
  const auto discs = [](std::size_t num) {
    std::vector<Point> places;
    std::vector<Edge> edges;
    std::vector<Agent> agents;
    for (std::size_t v = 0; v < 2 * num; ++v) {
      places.push_back({Length(static_cast<std::int64_t>(v) * 10), 0});
      if (v > 0) edges.push_back({VertexId(v - 1), VertexId(v), {}, Groups::all()});
      if (v < num) agents.push_back({VertexId(v), VertexId(v + num), Disc{5}});
    }
    return Instance::make(Roadmap::make(places, edges).value(), agents).value();
  };
  const std::size_t num = support::scaled(2000);
  SolveOptions options;
  options.limits.conflicts = 0;
  const SolveOutcome outcome = solve(discs(num), options).value();
  EXPECT_EQ(outcome.stop, StopReason::conflicts);
  EXPECT_EQ(outcome.lower_bound, static_cast<Cost>(10 * num * num));
}

// Where no plan is known, costs that hit all cores by greed may rise for ever: the cheapest ones
// have to come in between.
TEST(SolverLimits, CoversByGreedHaveAnEnd) {
  const Instance instance = read_instance_json(test::data("greedy_covers_rise.json")).value();
  SolveOptions options;
  options.system = System::smt_cbs;
  options.joint_work = 0;
  options.limits.looks = 200'000;
  EXPECT_EQ(solve(instance, options).value().status, Status::optimal);
}

// Searches of paths look at the limits, too, and are left by an exception.
TEST(SolverLimits, WhatWasDoneIsToldWhereverItIsCut) {
  RandomOptions random;
  random.num_vertices = 150;
  random.num_agents = 20;
  random.size = 400;
  random.edge_percent = 4;
  const Instance instance = random_instance(3, random);
  int num_with_cores = 0;
  for (std::int64_t looks = 116'000; looks <= 128'000; looks += 4000) {
    SolveOptions options;
    options.joint_work = options.route_work = 0;
    options.limits.looks = looks;
    const SolveOutcome outcome = solve(instance, options).value();
    if (outcome.statistics.cores == 0) continue;
    ++num_with_cores;
    EXPECT_GT(outcome.statistics.sat_calls, 0) << looks;
  }
  EXPECT_GE(num_with_cores, 2);
}

// Progress is told between two solves or slices of one: the bound grows, and is one.
TEST(SolverLimits, ProgressIsToldInOrder) {
  int num_told = 0;
  for (const Case& c : cases(12)) {
    SolveOptions options = c.options;
    options.progress_interval_s = 0;
    Cost bound = 0;
    options.on_progress = [&](const Progress& progress) {
      ++num_told;
      EXPECT_GE(progress.lower_bound, bound);
      bound = progress.lower_bound;
      EXPECT_LE(bound, *c.truth.cost);
      if (progress.cost) {
        EXPECT_GE(*progress.cost, *c.truth.cost);
      }
    };
    const SolveOutcome outcome = solve(c.instance, options).value();
    EXPECT_EQ(outcome.cost, c.truth.cost);
  }
  EXPECT_GE(num_told, 12);
}

TEST(SolverLimits, BetterPlansAreTold) {
  int num_told = 0;
  for (const Case& c : cases(12)) {
    SolveOptions options = c.options;
    options.plan_interval_s = 0;
    Cost last = std::numeric_limits<Cost>::max();
    options.on_plan = [&](const Plan& plan) {
      ++num_told;
      EXPECT_TRUE(verify(c.instance, plan).valid());
      EXPECT_LT(cost(plan, options.objective), last);
      last = cost(plan, options.objective);
    };
    const SolveOutcome outcome = solve(c.instance, options).value();
    EXPECT_LE(outcome.cost, last);
  }
  EXPECT_GE(num_told, 12);
}

// Where agent 1 has to cost as much as in the plan, each tick below was a core of its own: no lemma
// speaks of a cost between.
TEST(ContinuousBounds, DoNotRiseTickByTick) {
  RandomInstanceOptions discs;
  discs.num_vertices = 12;
  discs.num_agents = 3;
  discs.mixed = true;
  SolveOptions options;
  options.system = System::smt_cbs;
  options.route_work = options.joint_work = 0;
  options.limits.cpu_s = 5;
  const SolveOutcome outcome = solve(random_instance(discs, 2).value(), options).value();
  EXPECT_EQ(outcome.status, Status::optimal);
  EXPECT_LT(outcome.statistics.cores, 1000);
}

}  // namespace
}  // namespace quadrille::continuous::test
