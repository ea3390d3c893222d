// SPDX-License-Identifier: MIT
// The executor allocates nothing once it is made: here every allocation fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "faults/failing_allocator.hpp"
#include "quadrille/execution/executor.hpp"

namespace quadrille::execution::test {
namespace {

/// 100 agents in a ring, each of which follows the next one on every move, with little slack.
Precedences ring() {
  constexpr std::size_t kAgents = 100, kMoves = 40;
  Precedences order;
  for (std::size_t i = 0; i < kAgents; ++i) {
    order.moves.push_back({});
    for (std::size_t k = 0; k < kMoves; ++k) {
      const Ticks begin(static_cast<std::int64_t>(10 * k));
      order.moves[AgentId(i)].push_back({VertexId(k), VertexId(k + 1), begin, begin + 10});
    }
  }
  for (std::size_t i = 0; i < kAgents; ++i)
    for (std::uint32_t k = 0; k < kMoves; ++k)
      for (std::uint32_t lead = k; lead < std::min<std::size_t>(kMoves, k + 3); ++lead)
        order.list.push_back({{AgentId((i + 1) % kAgents), lead},
                              {AgentId(i), k},
                              Ticks(static_cast<std::int64_t>((i + k) % 5))});
  return order;
}

TEST(ExecutorAllocation, StepsAllocateNothing) {
  const Precedences order = ring();
  Executor executor(order);
  std::vector<Ticks> clocks(order.num_agents(), 0), targets = clocks, limits = clocks;
  std::size_t steps = 0;
  quadrille::support::fail_allocations(1, INT64_MAX / 2);
  while (clocks.front() < Ticks(400) && steps < 10'000) {
    executor.limits(clocks, limits);
    targets = clocks;
    executor.gate(clocks, targets);
    for (std::size_t i = 0; i < clocks.size(); ++i)
      targets[i] = (steps + i) % 7 == 0 ? clocks[i] : std::min(Ticks(400), clocks[i] + 3);
    executor.couple(clocks, targets);
    clocks.swap(targets);
    ++steps;
  }
  EXPECT_EQ(quadrille::support::stop_failing(), 0);
  EXPECT_GE(clocks.front(), Ticks(400));
  EXPECT_GT(steps, 134u);
}

}  // namespace
}  // namespace quadrille::execution::test
