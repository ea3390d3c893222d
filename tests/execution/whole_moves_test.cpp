// SPDX-License-Identifier: MIT
//
// Plans for systems that release whole moves are kept by these.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "execution/plans.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/execution/node_order.hpp"
#include "quadrille/execution/releaser.hpp"
#include "quadrille/execution/simulation.hpp"
#include "support/environment.hpp"

namespace quadrille::execution::test {
namespace {

using quadrille::support::scaled;

/// Another plan of the same instance, for whole moves.
std::optional<continuous::Plan> whole_plan(const continuous::Instance& instance) {
  continuous::SolveOptions options;
  options.gap_percent = 1e6;
  options.joint_work = 0;
  options.route_work = 0;
  options.limits.conflicts = 20;
  auto outcome = continuous::solve(instance.with_whole_moves(), options);
  if (!outcome) return std::nullopt;
  return std::move(outcome->plan);
}

std::optional<DiscreteCase> robust_case(std::uint64_t seed) {
  const auto plain = discrete_case(seed);
  if (!plain) return std::nullopt;
  discrete::Rules rules;
  rules.robust = 1;
  const auto instance = discrete::Instance::make(plain->instance.shared_graph(),
                                                 plain->instance.agents().items(), 0, rules);
  discrete::SolveOptions options;
  options.gap_percent = 1e6;
  options.limits.conflicts = 20;
  auto outcome = discrete::solve(*instance, options);
  if (!outcome || !outcome->plan) return std::nullopt;
  return DiscreteCase{plain->instance, std::move(*outcome->plan)};
}

/// Nobody waits who is on time, and everybody arrives, however late, by the plan and all delays.
void expect_kept(const Precedences& order, std::uint64_t seed) {
  const NodeOrder nodes = node_order(order);
  ASSERT_TRUE(nodes.acyclic());
  ASSERT_EQ(nodes.num_overlaps, 0u);
  ASSERT_TRUE(Releaser(order).cycle().empty());
  const auto on_time = simulate(order, Delays(order.num_agents()), Rule::gated, 1);
  ASSERT_TRUE(on_time.all_arrived);
  for (const AgentId i : IdRange<AgentId>(order.num_agents())) {
    ASSERT_EQ(on_time.finish[i], order.end(i));
    ASSERT_EQ(on_time.held[i], Ticks(0));
  }
  const Delays delays =
      draw_delays(order, {.pause_chance = 0.3, .longest_pause = 9, .slowness = 0}, seed);
  Ticks all = 0;
  for (const AgentDelay& delay : delays)
    for (const AgentDelay::Pause& pause : delay.pauses) all += pause.duration;
  const auto late = simulate(order, delays, Rule::gated, 1);
  ASSERT_TRUE(late.all_arrived);
  for (const AgentId i : IdRange<AgentId>(order.num_agents()))
    ASSERT_LE(late.finish[i], order.end(i) + all);
}

TEST(WholeMoves, PlansOnRoadmapsAreKept) {
  int num_plans = 0, num_overlaps = 0, num_cycles = 0, num_precedences = 0;
  for (std::uint32_t seed = 9000; seed < 9000 + scaled(400); ++seed) {
    const auto gradual = continuous_case(seed, 2 + seed % 5);
    if (!gradual) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const NodeOrder before = node_order(precedences(gradual->instance, gradual->plan).value());
    num_overlaps += before.num_overlaps > 0 ? 1 : 0;
    num_cycles += before.acyclic() ? 0 : 1;
    const auto plan = whole_plan(gradual->instance);
    if (!plan) continue;
    // As a plan of the instance with the rule, or without it.
    const auto order = precedences(gradual->instance.with_whole_moves(), *plan);
    ASSERT_TRUE(order) << order.error().message;
    ASSERT_EQ(*order, precedences(gradual->instance, *plan).value());
    expect_kept(*order, seed);
    if (HasFatalFailure()) return;
    ++num_plans;
    num_precedences += static_cast<int>(order->list.size());
  }
  RecordProperty("plans", num_plans);
  RecordProperty("cycles_without", num_cycles);
  RecordProperty("precedences", num_precedences);
  EXPECT_GE(num_plans, static_cast<int>(scaled(400) / 4));
  EXPECT_GE(num_overlaps, 1);
  if (scaled(400) < 400) return;
  EXPECT_GE(num_cycles, 1);
}

TEST(WholeMoves, RobustPlansOnGridsAreKept) {
  int num_plans = 0;
  for (std::uint64_t seed = 1; seed <= scaled(300); ++seed) {
    const auto c = robust_case(seed);
    if (!c) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto order = precedences(c->instance, c->plan);
    ASSERT_TRUE(order) << order.error().message;
    expect_kept(*order, seed);
    if (HasFatalFailure()) return;
    ++num_plans;
  }
  RecordProperty("plans", num_plans);
  EXPECT_GE(num_plans, static_cast<int>(scaled(300) / 10));
}

}  // namespace
}  // namespace quadrille::execution::test
