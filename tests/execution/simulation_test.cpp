// SPDX-License-Identifier: MIT
#include "quadrille/execution/simulation.hpp"

#include <gtest/gtest.h>

#include "execution/plans.hpp"
#include "execution/replay.hpp"
#include "quadrille/execution/clearance.hpp"
#include "support/environment.hpp"

namespace quadrille::execution::test {
namespace {

using quadrille::support::scaled;

std::vector<Replay::Real> real(std::span<const Ticks> clocks) {
  std::vector<Replay::Real> result;
  for (const Ticks clock : clocks) result.push_back(static_cast<Replay::Real>(clock.value()));
  return result;
}

TEST(Simulation, WithoutDelaysThePlanIsKept) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const auto c = continuous_case(seed, 4);
    if (!c) continue;
    const auto order = precedences(c->instance, c->plan).value();
    Delays none(order.num_agents());
    const auto result = simulate(order, none, Rule::coupled, 1);
    ASSERT_TRUE(result.all_arrived);
    EXPECT_EQ(result.sum_of_costs().value(), cost(c->plan, Objective::sum_of_costs));
    EXPECT_EQ(result.makespan().value(), cost(c->plan, Objective::makespan));
    for (const Ticks held : result.held) EXPECT_EQ(held, Ticks(0));
  }
}

TEST(Simulation, DelaysAreThoseThatWereDrawn) {
  const auto c = continuous_case(1, 2);
  ASSERT_TRUE(c.has_value());
  const auto order = precedences(c->instance, c->plan).value();
  const DelayOptions options{.pause_chance = 1, .longest_pause = 7, .slowness = 0.5};
  const Delays delays = draw_delays(order, options, 3);
  ASSERT_EQ(delays.size(), 2u);
  const auto alone = simulate(order, delays, Rule::naive, 1);
  for (const AgentId i : {AgentId(0), AgentId(1)}) {
    ASSERT_EQ(delays[i].pauses.size(), order.moves[i].size());
    EXPECT_GE(delays[i].speed, 500'000);
    if (order.moves[i].empty()) continue;
    Ticks pauses = 0;
    for (const auto& pause : delays[i].pauses) pauses += pause.duration;
    // Exactly as slow as drawn, but for what is lost of the fraction of a tick at each pause.
    const double least =
        static_cast<double>(order.end(i).value()) * 1e6 / static_cast<double>(delays[i].speed) +
        static_cast<double>(pauses.value());
    EXPECT_GE(static_cast<double>(alone.finish[i].value()), least - 1);
    EXPECT_LE(static_cast<double>(alone.finish[i].value()),
              least + 2 + 2 * static_cast<double>(order.moves[i].size()));
  }
}

TEST(Simulation, RulesDifferInWhatTheyPromise) {
  std::size_t naive_contacts = 0, num_runs = 0;
  for (std::uint32_t seed = 0; num_runs < scaled(200); ++seed) {
    const auto c = continuous_case(seed, 3 + seed % 5);
    if (!c) continue;
    const auto order = precedences(c->instance, c->plan).value();
    const Replay replay(c->instance, c->plan);
    for (std::uint64_t k = 0; k < 4; ++k, ++num_runs) {
      const Delays delays = draw_delays(order, {.longest_pause = 40}, k);
      for (const Rule rule : {Rule::naive, Rule::gated, Rule::coupled}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        ClearanceWatch watch(c->instance, c->plan);
        Replay::Real least = 1;
        const auto result =
            simulate(order, delays, rule, 3,
                     [&](std::span<const Ticks> before, std::span<const Ticks> after) {
                       watch.add(before, after);
                       least = std::min(least, replay.least_separation(real(before), real(after)));
                     });
        // Two opinions, in double and in long double. They differ about the depth of an overlap of
        // polygons, not about whether there is one.
        if (least < 1 && watch.least() > 0) {
          ASSERT_NEAR(static_cast<double>(least), watch.least(), 1e-6);
        }
        ASSERT_EQ(watch.contacts().empty(), least > -1e-8L) << static_cast<double>(least);
        if (rule == Rule::naive) {
          naive_contacts += watch.contacts().empty() ? 0 : 1;
          continue;
        }
        ASSERT_TRUE(watch.contacts().empty());
        if (rule == Rule::coupled) {
          ASSERT_TRUE(result.all_arrived);
        }
      }
    }
  }
  EXPECT_GE(naive_contacts * 10, num_runs);
}

TEST(Simulation, ATurningSquareGoesOnTogetherAndStandsStillWhenGated) {
  const VertexId a(0), b(1), c(2), d(3);
  auto graph = discrete::Graph::make(4, {{a, b}, {b, c}, {c, d}, {d, a}});
  const auto instance =
      discrete::Instance::make(std::move(graph).value(), {{a, b}, {b, c}, {c, d}, {d, a}});
  ASSERT_TRUE(instance.has_value());
  discrete::Plan plan;
  for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, d}, {d, a}})
    plan.paths.push_back({from, to});
  const auto order = precedences(*instance, plan).value();
  const Delays delays = draw_delays(order, {.pause_chance = 1, .longest_pause = 5}, 1);
  ConflictWatch watch(plan);
  const auto look = [&](std::span<const Ticks> before, std::span<const Ticks> after) {
    watch.add(before, after);
  };
  EXPECT_TRUE(simulate(order, delays, Rule::coupled, 1, look).all_arrived);
  EXPECT_TRUE(watch.contacts().empty());
  EXPECT_FALSE(simulate(order, delays, Rule::gated, 1, look).all_arrived);
  EXPECT_TRUE(watch.contacts().empty());
  EXPECT_TRUE(simulate(order, delays, Rule::naive, 1, look).all_arrived);
  EXPECT_FALSE(watch.contacts().empty());
}

TEST(Simulation, RulesHaveNames) {
  for (const Rule rule : {Rule::naive, Rule::gated, Rule::coupled})
    EXPECT_EQ(parse_rule(to_string(rule)), rule);
  EXPECT_EQ(parse_rule("quick"), std::nullopt);
}

}  // namespace
}  // namespace quadrille::execution::test
