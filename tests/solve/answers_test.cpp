// SPDX-License-Identifier: MIT
// What an answer says of those who are still the same later.
#include "quadrille/solve/answers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <vector>

namespace quadrille::solve {
namespace {

using Same = IdVector<AgentId, std::optional<AgentId>>;

std::vector<AgentId> agents(std::initializer_list<std::size_t> numbers) {
  std::vector<AgentId> agents;
  for (const std::size_t number : numbers) agents.emplace_back(number);
  return agents;
}

/// Of six agents, agent i costs 10 + i alone: 0 and 1 cost 2 more, with 2 another 1, 3 and 4 cost 3
/// more where 5 stands by.
Attribution attribution(Objective objective) {
  Attribution proved;
  proved.objective = objective;
  proved.agents = IdVector<AgentId, AgentCharge>(6);
  for (std::size_t i = 0; i < 6; ++i)
    proved.agents[AgentId(i)].free_cost = static_cast<Cost>(10 + i);
  proved.free_bound = objective == Objective::makespan ? 15 : 75;
  proved.raises = {{RaiseKind::core, 2, agents({0, 1}), {}},
                   {RaiseKind::core, 1, agents({1, 2}), {}},
                   {RaiseKind::core, 3, agents({3, 4}), agents({5})}};
  return proved;
}

/// All of them but these, who are called by the order that is left.
Same without(std::initializer_list<std::size_t> lost) {
  Same same(6);
  std::size_t next = 0;
  for (std::size_t i = 0; i < 6; ++i)
    if (std::find(lost.begin(), lost.end(), i) == lost.end()) same[AgentId(i)] = AgentId(next++);
  return same;
}

std::vector<GroupBound> bounds(Objective objective, const Same& same, Cost elapsed) {
  std::vector<GroupBound> bounds;
  add_bounds(attribution(objective), same, elapsed, bounds);
  return bounds;
}

TEST(AnswerBounds, AreOfGroupsThatRaisesConnect) {
  const auto all = bounds(Objective::sum_of_costs, without({}), 0);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].agents, agents({0, 1, 2}));
  EXPECT_EQ(all[0].cost, 10 + 11 + 12 + 2 + 1);
  EXPECT_EQ(all[1].agents, agents({3, 4, 5}));
  EXPECT_EQ(all[1].cost, 13 + 14 + 15 + 3);
  const auto later = bounds(Objective::sum_of_costs, without({}), 4);
  EXPECT_EQ(later[0].cost, all[0].cost - 3 * 4);
  // A bystander is needed as well.
  const auto few = bounds(Objective::sum_of_costs, without({2, 5}), 0);
  ASSERT_EQ(few.size(), 1U);
  EXPECT_EQ(few[0].agents, agents({0, 1}));
  EXPECT_EQ(few[0].cost, 10 + 11 + 2);
  EXPECT_TRUE(bounds(Objective::sum_of_costs, without({1, 4}), 0).empty());
}

TEST(AnswerBounds, AreOfTheLastRaiseForTheMakespan) {
  const auto all = bounds(Objective::makespan, without({}), 1);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].agents, agents({3, 4, 5}));
  EXPECT_EQ(all[0].cost, 15 + 2 + 1 + 3 - 1);
  const auto few = bounds(Objective::makespan, without({3}), 0);
  ASSERT_EQ(few.size(), 1U);
  EXPECT_EQ(few[0].agents, agents({1, 2}));
  EXPECT_EQ(few[0].cost, 15 + 2 + 1);
}

TEST(AnswerBounds, AreAddedUpWhereNobodyIsCountedTwice) {
  const IdVector<AgentId, Cost> free_costs(std::vector<Cost>{5, 5, 5, 5});
  const std::vector<GroupBound> groups{
      {agents({0, 1}), 12}, {agents({1, 2}), 13}, {agents({0}), 4}, {agents({3}), 6}};
  EXPECT_EQ(bound_of_all(groups, free_costs, Objective::sum_of_costs), 20 + 3 + 1);
  EXPECT_EQ(bound_of_all(groups, free_costs, Objective::makespan), 13);
  EXPECT_EQ(bound_of_all({}, free_costs, Objective::sum_of_costs), 20);
  EXPECT_EQ(bound_of_all({}, free_costs, Objective::makespan), 5);
}

}  // namespace
}  // namespace quadrille::solve
