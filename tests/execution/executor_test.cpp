// SPDX-License-Identifier: MIT
#include "quadrille/execution/executor.hpp"

#include <gtest/gtest.h>

#include "quadrille/execution/node_order.hpp"

namespace quadrille::execution::test {
namespace {

VertexId v(std::size_t index) { return VertexId(index); }

/// Agents with one move each, all in [0, 10], and these precedences.
Precedences order_of(std::size_t agents, std::vector<Precedence> list) {
  Precedences order;
  for (std::size_t i = 0; i < agents; ++i) order.moves.push_back({{v(2 * i), v(2 * i + 1), 0, 10}});
  order.list = std::move(list);
  return order;
}
Precedence after(std::size_t leader, std::size_t follower, Ticks slack) {
  return {{AgentId(leader), 0}, {AgentId(follower), 0}, slack};
}

using Clocks = std::vector<Ticks>;

Clocks limits(Executor& executor, const Clocks& clocks) {
  Clocks result(clocks.size());
  executor.limits(clocks, result);
  return result;
}
Clocks couple(Executor& executor, const Clocks& clocks, Clocks targets) {
  executor.couple(clocks, targets);
  return targets;
}
Clocks gate(Executor& executor, const Clocks& clocks, Clocks targets) {
  executor.gate(clocks, targets);
  return targets;
}

TEST(Executor, AFollowerIsHeldUntilTheLeaderHasEnded) {
  const Precedences order = order_of(2, {after(0, 1, 3)});
  Executor executor(order);
  const Ticks free = Executor::kUnlimited;
  EXPECT_EQ(limits(executor, {0, 0}), (Clocks{free, 3}));
  EXPECT_EQ(limits(executor, {4, 0}), (Clocks{free, 7}));
  EXPECT_EQ(limits(executor, {7, 5}), (Clocks{free, free}));  // 7 + 3: it may end its move.
  executor.reset();
  EXPECT_EQ(limits(executor, {0, 0}), (Clocks{free, 3}));
  EXPECT_EQ(couple(executor, {0, 0}, {5, 20}), (Clocks{5, 8}));
  EXPECT_EQ(couple(executor, {0, 0}, {0, 20}), (Clocks{0, 3}));
  EXPECT_EQ(gate(executor, {0, 0}, {5, 20}), (Clocks{5, 0}));
  EXPECT_EQ(gate(executor, {9, 0}, {12, 2}), (Clocks{12, 0}));
  EXPECT_EQ(gate(executor, {10, 0}, {12, 2}), (Clocks{12, 2}));
}

TEST(Executor, AFollowerMayAlwaysGoToTheBeginningOfItsMove) {
  Precedences order = order_of(2, {after(0, 1, 1)});
  order.moves[AgentId(1)].front() = {v(2), v(3), 7, 12};
  Executor executor(order);
  EXPECT_EQ(limits(executor, {0, 0}), (Clocks{Executor::kUnlimited, 7}));
  EXPECT_EQ(limits(executor, {7, 7}), (Clocks{Executor::kUnlimited, 8}));
  executor.reset();
  // 6 is ahead of 4 + 1: on the way to 9 it would pass 7 before the leader is at 6.
  EXPECT_EQ(couple(executor, {4, 6}, {8, 10}), (Clocks{8, 7}));
  EXPECT_EQ(couple(executor, {4, 5}, {8, 10}), (Clocks{8, 9}));
}

TEST(Executor, ACircleWithoutSlackGoesOnTogether) {
  const Precedences order = order_of(3, {after(0, 1, 0), after(1, 2, 0), after(2, 0, 0)});
  Executor executor(order);
  EXPECT_EQ(limits(executor, {2, 2, 2}), (Clocks{2, 2, 2}));
  EXPECT_EQ(couple(executor, {2, 2, 2}, {6, 7, 8}), (Clocks{6, 6, 6}));
  EXPECT_EQ(couple(executor, {2, 2, 2}, {6, 2, 8}), (Clocks{2, 2, 2}));
}

TEST(NodeOrder, NamesACycleAndCountsKnots) {
  EXPECT_TRUE(node_order(order_of(3, {after(0, 1, 0), after(1, 2, 0), after(0, 2, 5)})).acyclic());
  const NodeOrder knot =
      node_order(order_of(4, {after(0, 1, 2), after(1, 2, 2), after(2, 1, 2), after(2, 3, 2)}));
  EXPECT_FALSE(knot.acyclic());
  EXPECT_EQ(knot.num_knots, 1u);
  EXPECT_EQ(knot.num_knotted_moves, 2u);
  EXPECT_EQ(knot.num_overlaps, 4u);
  EXPECT_EQ(knot.cycle, (std::vector<MoveId>{{AgentId(1), 0}, {AgentId(2), 0}}));
}

TEST(NodeOrder, AnAgentsOwnMovesBelongToTheCycle) {
  // Agent 0 leads with its second move, and follows with its first.
  Precedences order = order_of(2, {});
  order.moves[AgentId(0)].push_back({v(1), v(4), 10, 15});
  order.moves[AgentId(1)].push_back({v(3), v(5), 10, 15});
  order.list = {{{AgentId(0), 1}, {AgentId(1), 0}, 0}, {{AgentId(1), 1}, {AgentId(0), 0}, 0}};
  const NodeOrder knot = node_order(order);
  EXPECT_EQ(knot.cycle, (std::vector<MoveId>{
                            {AgentId(0), 0}, {AgentId(0), 1}, {AgentId(1), 0}, {AgentId(1), 1}}));
}

}  // namespace
}  // namespace quadrille::execution::test
