// SPDX-License-Identifier: MIT
#include "quadrille/execution/releaser.hpp"

#include <gtest/gtest.h>

#include <string>

#include "execution/plans.hpp"
#include "execution/replay.hpp"
#include "quadrille/execution/node_order.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::execution::test {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

TEST(Releaser, ReleasesWhenTheLeaderHasEnded) {
  Precedences order;
  const VertexId a(0), b(1), c(2);
  order.moves.push_back({{a, b, 0, 1}, {b, c, 1, 2}});
  order.moves.push_back({{c, a, 2, 3}, {a, b, 3, 4}});
  order.list = {{{AgentId(0), 0}, {AgentId(1), 1}, 2}, {{AgentId(0), 1}, {AgentId(1), 0}, 1}};
  Releaser releaser(order);
  EXPECT_EQ(releaser.take_news(), std::vector<AgentId>{AgentId(0)});
  EXPECT_EQ(releaser.released(AgentId(0)), 2u);
  EXPECT_EQ(releaser.released(AgentId(1)), 0u);
  releaser.end_moves(AgentId(0), 1);
  EXPECT_TRUE(releaser.take_news().empty());
  releaser.end_moves(AgentId(0), 2);
  EXPECT_EQ(releaser.released(AgentId(1)), 2u);
  EXPECT_EQ(releaser.take_news(), std::vector<AgentId>{AgentId(1)});
}

TEST(Releaser, WholeMovesInAnyOrderNeitherCollideNorGetStuckWithoutACycle) {
  Random random(5);
  std::size_t num_cyclic = 0, num_acyclic = 0;
  for (std::uint32_t seed = 0; seed < scaled(150); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto c = continuous_case(seed, 2 + seed % 6);
    if (!c) continue;
    const auto order = precedences(c->instance, c->plan).value();
    const bool acyclic = node_order(order).acyclic();
    ++(acyclic ? num_acyclic : num_cyclic);
    const Replay replay(c->instance, c->plan);
    Releaser releaser(order);
    ASSERT_EQ(releaser.cycle().empty(), acyclic);
    std::vector<Replay::Real> clocks(order.num_agents(), 0);
    std::vector<std::uint32_t> ended(order.num_agents(), 0);
    while (true) {
      std::vector<std::size_t> able;
      for (std::size_t i = 0; i < clocks.size(); ++i)
        if (ended[i] < releaser.released(AgentId(i))) able.push_back(i);
      if (able.empty()) break;
      // A share of the next move, or all of it.
      const std::size_t i = random.pick(able);
      const TimedMove& move = order.moves[AgentId(i)][ended[i]];
      auto after = clocks;
      const auto end = static_cast<Replay::Real>(move.end.value());
      after[i] =
          random.percent(50)
              ? end
              : (std::max(clocks[i], static_cast<Replay::Real>(move.begin.value())) + end) / 2;
      ASSERT_GE(replay.least_separation(clocks, after), -1e-9L);
      clocks = after;
      if (after[i] >= end) releaser.end_moves(AgentId(i), ++ended[i]);
    }
    bool all_arrived = true;
    for (std::size_t i = 0; i < ended.size(); ++i)
      all_arrived = all_arrived && ended[i] == order.moves[AgentId(i)].size();
    ASSERT_EQ(all_arrived, acyclic);
  }
  EXPECT_GE(num_acyclic, scaled(50));
}

TEST(Releaser, ATurningSquareIsNotReleased) {
  const VertexId v[] = {VertexId(0), VertexId(1), VertexId(2), VertexId(3)};
  Precedences order;
  for (std::size_t i = 0; i < 4; ++i) {
    order.moves.push_back({{v[i], v[(i + 1) % 4], 0, 1}});
    order.list.push_back({{AgentId((i + 1) % 4), 0}, {AgentId(i), 0}, 0});
  }
  const Releaser releaser(order);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(releaser.released(AgentId(i)), 0u);
  EXPECT_EQ(node_order(order).cycle.size(), 4u);
  EXPECT_EQ(releaser.cycle(), node_order(order).cycle);
}

}  // namespace
}  // namespace quadrille::execution::test
