// SPDX-License-Identifier: MIT
#include "neighbourhoods/plan_repair.hpp"

#include <gtest/gtest.h>

#include "discrete/primal/primal_support.hpp"
#include "quadrille/discrete/verify.hpp"
#include "reservations/path_planner.hpp"
#include "support/environment.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using quadrille::support::scaled;
using support::instance_text;
using support::replay;

/// Each agent's path as if it were alone.
Plan lonely_paths(const Instance& instance, const GoalDistances& distances, std::uint32_t seed) {
  Random random(seed);
  PathPlanner planner(instance, distances, random);
  const Reservations nobody(instance.graph().num_vertices());
  LimitMonitor limits{Limits{}};
  Plan plan;
  for (const AgentId agent : instance.agent_ids())
    plan.paths.push_back(planner.find(agent, nobody, kForever - 1, kNoEnd / 2, limits).value());
  return plan;
}

/// Whether all agents can get to their goals if they are alone.
bool has_ways(const Instance& instance, const GoalDistances& distances) {
  for (const AgentId agent : instance.agent_ids())
    if (distances(agent, instance.agents()[agent].start) == kUnreachable) return false;
  return true;
}

TEST(PlanRepair, MakesPlansOfPathsThatCollide) {
  support::Random random(7);
  std::size_t num_colliding = 0, num_solvable = 0, num_plans = 0;
  for (std::size_t round = 0; round < scaled(3000); ++round) {
    const Instance instance = random_instance(random);
    const auto distances = distances_of(instance);
    if (!has_ways(instance, *distances)) continue;
    SCOPED_TRACE(instance_text(instance));
    LimitMonitor limits{Limits{}};
    const Plan draft = lonely_paths(instance, *distances, static_cast<std::uint32_t>(round));
    const bool collides = !replay(instance, draft).empty();
    PlanRepair repair(instance, distances, 3);
    const auto plan = repair.repair(draft, 20'000, limits);
    ASSERT_EQ(plan.has_value(), repair.num_meetings() == 0);
    if (!collides) {
      ASSERT_TRUE(plan.has_value());
      ASSERT_EQ(*plan, draft);
      continue;
    }
    ++num_colliding;
    ASSERT_EQ(replay(instance, repair.plan()).empty(), plan.has_value());
    if (searched(instance).state() != PrimalSearch::State::found) {
      ASSERT_FALSE(plan.has_value());
      continue;
    }
    ++num_solvable;
    if (!plan) continue;
    ++num_plans;
    // What the first repair has reserved is forgotten.
    ASSERT_EQ(repair.repair(*plan, 20'000, limits), plan);
  }
  EXPECT_GE(num_colliding, scaled(400));
  EXPECT_LT(num_solvable, num_colliding);
  // Measured: nine in ten. Where both have to give way, one path after the other is not enough.
  EXPECT_GE(num_plans, num_solvable * 8 / 10);
}

TEST(PlanRepair, KeepsMostPathsWhereThereIsRoom) {
  const Instance instance = crowd(24, 40, 11);
  const auto distances = distances_of(instance);
  const Plan draft = lonely_paths(instance, *distances, 5);
  ASSERT_NE(replay(instance, draft), "");
  LimitMonitor limits{Limits{}};
  PlanRepair repair(instance, distances, 0);
  const auto plan = repair.repair(draft, 100'000, limits);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(replay(instance, *plan), "");
  std::size_t num_kept = 0;
  for (const AgentId agent : instance.agent_ids())
    if (plan->paths[agent] == draft.paths[agent]) ++num_kept;
  EXPECT_GE(num_kept, 15U);
}

TEST(PlanRepair, NeverMeetsMoreAndDoesNotDependOnSlices) {
  const Instance instance = crowd(12, 80, 3);
  const auto distances = distances_of(instance);
  const Plan draft = lonely_paths(instance, *distances, 1);
  LimitMonitor limits{Limits{}};
  PlanRepair whole(instance, distances, 4), sliced(instance, distances, 4);
  whole.restart_from(draft);
  ASSERT_TRUE(whole.advance(10'000'000, limits));
  EXPECT_TRUE(verify(instance, whole.plan()).valid());
  sliced.restart_from(draft);
  std::int64_t before = sliced.num_meetings();
  std::size_t num_slices = 1;
  for (; !sliced.advance(1, limits); ++num_slices) {
    ASSERT_LE(sliced.num_meetings(), before);
    before = sliced.num_meetings();
  }
  EXPECT_GE(num_slices, 20U);
  EXPECT_EQ(sliced.plan(), whole.plan());
  EXPECT_EQ(sliced.effort(), whole.effort());
}

TEST(PlanRepair, StaysWholeWhereverItIsCut) {
  const Instance instance = crowd(12, 70, 3);
  const auto distances = distances_of(instance);
  const Plan draft = lonely_paths(instance, *distances, 1);
  LimitMonitor no_limits{Limits{}};
  for (int looks = 1; looks <= 200; looks += 7) {
    Limits limits;
    limits.looks = looks;
    LimitMonitor monitor(limits);
    PlanRepair repair(instance, distances, 4);
    repair.restart_from(draft);
    const std::int64_t before = repair.num_meetings();
    static_cast<void>(repair.advance(10'000'000, monitor));
    ASSERT_LE(repair.num_meetings(), before);
    // What it knows of its paths is what somebody sees who begins with them.
    PlanRepair other(instance, distances, 0);
    other.restart_from(repair.plan());
    ASSERT_EQ(other.num_meetings(), repair.num_meetings());
    ASSERT_TRUE(repair.advance(10'000'000, no_limits));
    ASSERT_TRUE(verify(instance, repair.plan()).valid());
  }
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
