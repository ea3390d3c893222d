// SPDX-License-Identifier: MIT
//
// Plans that begin later than at 0 under delays: all is as for those that begin at 0, but for the
// times.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "quadrille/discrete/primal.hpp"
#include "quadrille/execution/precedences.hpp"
#include "quadrille/execution/simulation.hpp"
#include "support/generators.hpp"

namespace quadrille::execution {
namespace {

TEST(TimeOriginExecution, ClocksBeginThen) {
  LimitMonitor limits{Limits{}};
  constexpr Ticks kLater = 100;
  int looked_at = 0;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    support::Random random(seed);
    const auto from_0 = discrete::support::random_grid(random, {});
    const auto later = from_0.with_now(100).value();
    const auto plan = discrete::find_plan(from_0, limits, 0);
    if (!plan) continue;
    ++looked_at;
    auto then = *plan;
    then.now = 100;
    const auto a = execution::precedences(from_0, *plan).value();
    const auto b = execution::precedences(later, then).value();
    EXPECT_EQ(a.list, b.list);
    EXPECT_EQ(b.now, kLater);
    for (const AgentId i : from_0.agent_ids()) EXPECT_EQ(b.end(i), a.end(i) + kLater);
    const auto run = [&](const execution::Precedences& order) {
      return execution::simulate(order, execution::draw_delays(order, {}, seed),
                                 execution::Rule::coupled, 1);
    };
    const auto x = run(a), y = run(b);
    EXPECT_EQ(x.makespan(), y.makespan());
    EXPECT_EQ(x.sum_of_costs(), y.sum_of_costs());
    EXPECT_EQ(x.held, y.held);
    for (const AgentId i : from_0.agent_ids()) EXPECT_EQ(y.finish[i], x.finish[i] + kLater);
  }
  EXPECT_GT(looked_at, 20);
}

}  // namespace
}  // namespace quadrille::execution
