// SPDX-License-Identifier: MIT
// Tables of distances, plain and packed, against one breadth-first search at a time.
#include "quadrille/discrete/goal_distances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <vector>

#include "support/distances.hpp"
#include "support/generators.hpp"

namespace quadrille::discrete {
namespace {

using support::distances_of;

std::shared_ptr<const GoalDistances> packed_distances_of(const Instance& instance) {
  LimitMonitor limits{Limits{}};
  return GoalDistances::make(instance, limits, 0);
}

void expect_right(const Instance& instance, const GoalDistances& table, std::size_t stride = 1) {
  for (const AgentId agent : instance.agent_ids()) {
    const Agent& task = instance.agents()[agent];
    IdVector<VertexId, Timestep> expected(instance.graph().num_vertices(), kUnreachable);
    for (const VertexId goal : task.goals.vertices()) {
      const auto to_goal = distances_from(instance.graph(), goal);
      for (std::size_t v = 0; v < expected.size(); ++v)
        expected[VertexId(v)] = std::min(expected[VertexId(v)], to_goal[VertexId(v)]);
    }
    ASSERT_EQ(expected, distances_to_nearest(instance.graph(), task.goals));
    const auto from_start = distances_from(instance.graph(), task.start);
    const GoalDistances::Row row = table.row(agent);
    const auto own = table.pack(from_start);
    for (std::size_t v = 0; v < expected.size(); v += stride) {
      ASSERT_EQ(table(agent, VertexId(v)), expected[VertexId(v)]);
      ASSERT_EQ(row[VertexId(v)], expected[VertexId(v)]);
      ASSERT_EQ((*own)[VertexId(v)], from_start[VertexId(v)]);
    }
  }
}

Instance line(std::size_t length) {
  const auto width = static_cast<std::int32_t>(length);
  return Instance::make(Graph::grid(width, 1, std::vector<bool>(length, true)),
                        {{VertexId(0), VertexId(length - 1)},
                         {VertexId(1), VertexId(0)},
                         {VertexId(2), VertexId(length / 2)}})
      .value();
}

TEST(GoalDistances, AreThoseOfABreadthFirstSearch) {
  support::Random random(1);
  for (int round = 0; round < 200 && !testing::Test::HasFatalFailure(); ++round) {
    const Instance grid = support::random_grid(random, {1, 30, 50, 1, 9});
    const Instance graph = support::random_graph(random, 100, 5);
    for (const Instance* instance : {&grid, &graph}) {
      expect_right(*instance, *distances_of(*instance));
      expect_right(*instance, *packed_distances_of(*instance));
    }
  }
}

TEST(GoalDistances, AreRightWhereTheyNoLongerFitIntoTwoBytes) {
  for (const std::size_t length : {65'534U, 65'535U, 65'536U, 65'537U, 131'073U}) {
    SCOPED_TRACE(length);
    expect_right(line(length), *distances_of(line(length)), 7);
  }
}

// Four lines beside each other: many vertices, but no distance is large.
TEST(GoalDistances, KnowWhereThereIsNoWay) {
  constexpr std::int32_t kWidth = 17'000;
  std::vector<bool> passable;
  for (std::size_t row = 0; row < 7; ++row) passable.insert(passable.end(), kWidth, row % 2 == 0);
  const Instance instance =
      Instance::make(Graph::grid(kWidth, 7, passable),
                     {{VertexId(5), VertexId(kWidth + 5)}, {VertexId(6), VertexId(0)}})
          .value();
  EXPECT_EQ((*distances_of(instance))(AgentId(0), VertexId(5)), kUnreachable);
  expect_right(instance, *distances_of(instance), 3);
  expect_right(instance, *packed_distances_of(instance), 3);
}

TEST(GoalDistances, AreTheSameFromSeveralThreads) {
  support::Random random(2);
  for (int round = 0; round < 50 && !testing::Test::HasFatalFailure(); ++round) {
    const Instance instance = support::random_grid(random, {5, 30, 30, 1, 9});
    GoalDistancesInTheMaking making(instance);
    std::vector<std::shared_ptr<const GoalDistances>> tables(3);
    {
      std::vector<std::jthread> threads;
      for (auto& table : tables)
        threads.emplace_back([&making, &table] {
          LimitMonitor limits{Limits{}};
          table = making.join(limits);
        });
    }
    for (const auto& table : tables) ASSERT_EQ(table, tables.front());
    expect_right(instance, *tables.front());
  }
}

// What one leaves that meets a limit is done by the others.
TEST(GoalDistances, OfSeveralThreadsAreNoneForWhoMeetsALimit) {
  for (int round = 0; round < 20; ++round) {
    const Instance instance = line(30'000);
    GoalDistancesInTheMaking making(instance);
    std::shared_ptr<const GoalDistances> table;
    {
      const std::jthread other([&] {
        LimitMonitor limits{Limits{}};
        table = making.join(limits);
      });
      Limits few;
      few.looks = round % 4;
      LimitMonitor limits(few);
      const auto mine = making.join(limits);
      EXPECT_EQ(mine == nullptr, limits.reason() != StopReason::none);
    }
    ASSERT_NE(table, nullptr);
    expect_right(instance, *table, 1000);
  }
}

TEST(GoalDistances, StopAtLimits) {
  const std::atomic<bool> interrupt = true;
  Limits limits;
  limits.interrupt = &interrupt;
  LimitMonitor stopped(limits);
  EXPECT_EQ(GoalDistances::make(line(1000), stopped), nullptr);
  Limits few;
  few.looks = 3;  // inside a search
  LimitMonitor monitor(few);
  EXPECT_EQ(GoalDistances::make(line(70'000), monitor), nullptr);
}

}  // namespace
}  // namespace quadrille::discrete
