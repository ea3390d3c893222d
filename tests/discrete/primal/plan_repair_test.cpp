// SPDX-License-Identifier: MIT
#include "primal/plan_repair.hpp"

#include <gtest/gtest.h>

#include "discrete/primal/primal_support.hpp"
#include "quadrille/discrete/verify.hpp"
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
  for (const AgentId agent : instance.agents())
    plan.paths.push_back(planner.find(agent, nobody, kForever - 1, kNoEnd / 2, limits).value());
  return plan;
}

TEST(PlanRepair, MakesPlansOfPathsThatCollide) {
  support::Random random(7);
  std::size_t num_colliding = 0, num_plans = 0;
  for (std::size_t round = 0; round < scaled(2000); ++round) {
    const Instance instance = random_instance(random);
    const auto distances = distances_of(instance);
    bool has_ways = true;
    for (const AgentId agent : instance.agents())
      has_ways = has_ways && (*distances)(agent, instance.tasks()[agent].start) != kUnreachable;
    if (!has_ways) continue;
    SCOPED_TRACE(instance_text(instance));
    LimitMonitor limits{Limits{}};
    const Plan draft = lonely_paths(instance, *distances, static_cast<std::uint32_t>(round));
    const bool collides = !replay(instance, draft).empty();
    PlanRepair repair(instance, distances, 3);
    const auto plan = repair.repair(draft, limits);
    if (!collides) {
      ASSERT_TRUE(plan.has_value());
      ASSERT_EQ(*plan, draft);
      continue;
    }
    ++num_colliding;
    if (!plan) continue;
    ++num_plans;
    ASSERT_EQ(replay(instance, *plan), "");
    // What the first repair has reserved is forgotten.
    ASSERT_EQ(repair.repair(*plan, limits), plan);
  }
  EXPECT_GE(num_colliding, scaled(300));
  // Measured: 248 of 715, and 26 of 108 when a tenth of the instances is drawn.
  EXPECT_GE(num_plans + 2, num_colliding / 4);
  EXPECT_GE(num_plans, num_colliding / 6);  // the sharper one when only few are drawn
}

TEST(PlanRepair, KeepsMostPathsWhereThereIsRoom) {
  const Instance instance = crowd(16, 40, 11);
  const auto distances = distances_of(instance);
  const Plan draft = lonely_paths(instance, *distances, 5);
  ASSERT_NE(replay(instance, draft), "");
  LimitMonitor limits{Limits{}};
  PlanRepair repair(instance, distances, 0);
  const auto plan = repair.repair(draft, limits);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(replay(instance, *plan), "");
  std::size_t num_kept = 0;
  for (const AgentId agent : instance.agents())
    if (plan->paths[agent] == draft.paths[agent]) ++num_kept;
  EXPECT_GE(num_kept, 20U);
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
