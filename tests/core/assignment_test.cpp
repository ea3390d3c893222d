// SPDX-License-Identifier: MIT
#include "quadrille/core/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <set>

#include "quadrille/core/random.hpp"

namespace quadrille {
namespace {

using Reaches = std::vector<std::vector<Reach>>;

Reaches random_reach(Random& random, std::size_t num_agents, std::size_t num_goals) {
  Reaches reach(num_agents);
  const std::size_t share = 20 + random.below(81), dearest = 1 + random.below(12);
  for (auto& own : reach)
    for (std::size_t goal = 0; goal < num_goals; ++goal) {
      if (random.below(100) >= share) continue;
      own.push_back({goal, static_cast<Cost>(random.below(dearest))});
    }
  return reach;
}

/// By trying all.
std::optional<Cost> least_cost(const Reaches& reach, std::size_t agent, std::vector<bool>& taken) {
  if (agent == reach.size()) return 0;
  std::optional<Cost> least;
  for (const Reach& to : reach[agent]) {
    if (taken[to.goal]) continue;
    taken[to.goal] = true;
    if (const auto rest = least_cost(reach, agent + 1, taken))
      least = std::min(least.value_or(*rest + to.cost), *rest + to.cost);
    taken[to.goal] = false;
  }
  return least;
}

Cost paid(const std::vector<Reach>& own, std::size_t goal, const std::vector<Cost>& prices) {
  const auto to =
      std::find_if(own.begin(), own.end(), [&](const Reach& one) { return one.goal == goal; });
  EXPECT_NE(to, own.end());
  return to->cost + prices[goal];
}

/// With all costs and prices.
Cost cheapest(const std::vector<Reach>& own, const std::vector<Cost>& prices) {
  Cost least = own.front().cost + prices[own.front().goal];
  for (const Reach& to : own) least = std::min(least, to.cost + prices[to.goal]);
  return least;
}

TEST(Assignment, IsCheapestAndPricesProveIt) {
  LimitMonitor limits{Limits{}};
  int assigned = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::size_t num_agents = 1 + random.below(5), num_goals = 1 + random.below(6);
    const Reaches reach = random_reach(random, num_agents, num_goals);
    std::vector<bool> taken(num_goals, false);
    const auto expected = least_cost(reach, 0, taken);
    const auto found = cheapest_assignment(reach, num_goals, limits);
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (!found) continue;
    ++assigned;
    Cost cost = 0, bound = 0;
    for (std::size_t agent = 0; agent < num_agents; ++agent) {
      const std::size_t goal = found->goals[agent];
      ASSERT_FALSE(taken[goal]);
      taken[goal] = true;
      const Cost own = paid(reach[agent], goal, found->prices);
      ASSERT_EQ(own, cheapest(reach[agent], found->prices));
      cost += own - found->prices[goal];
      bound += own;
    }
    for (std::size_t goal = 0; goal < num_goals; ++goal) {
      ASSERT_GE(found->prices[goal], 0);
      ASSERT_TRUE(taken[goal] || found->prices[goal] == 0);
      bound -= found->prices[goal];
    }
    ASSERT_EQ(cost, *expected);
    ASSERT_EQ(bound, *expected);
  }
  EXPECT_GT(assigned, 1000);
}

TEST(Assignment, GoalsAreLeftOverWhereThereAreMoreThanAgents) {
  // Agents 0 and 1 share two goals; agents 2 and 3 share three.
  const Reaches reach{{{0, 1}, {1, 5}}, {{0, 1}, {1, 6}}, {{2, 1}, {3, 4}, {4, 9}}, {{2, 1}}};
  LimitMonitor limits{Limits{}};
  const auto assignment = cheapest_assignment(reach, 5, limits);
  ASSERT_TRUE(assignment);
  EXPECT_EQ(assignment->goals, (std::vector<std::size_t>{1, 0, 3, 2}));
  EXPECT_GT(assignment->prices[0], 0);
  EXPECT_GT(assignment->prices[2], 0);
  EXPECT_EQ(may_be_left_over(reach, 5), (std::vector<bool>{false, false, true, true, true}));
}

// A crowd is what Hall's theorem says: there is one exactly if nobody can be left without a goal.
TEST(Assignment, CrowdsAreWhoCanReachTooFewGoals) {
  std::mt19937 random(11);
  int num_crowds = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t num_goals = 1 + random() % 5;
    Reaches reach(1 + random() % 5);
    for (auto& own : reach)
      for (std::size_t goal = 0; goal < num_goals; ++goal)
        if (random() % 3 == 0) own.push_back({goal, 1});
    LimitMonitor limits{Limits{}};
    const auto crowd = find_crowd(reach, num_goals);
    ASSERT_EQ(crowd.empty(), cheapest_assignment(reach, num_goals, limits).has_value());
    if (crowd.empty()) continue;
    ++num_crowds;
    ASSERT_TRUE(std::is_sorted(crowd.begin(), crowd.end()));
    std::set<std::size_t> goals;
    for (const AgentId i : crowd)
      for (const Reach& to : reach[i.index()]) goals.insert(to.goal);
    ASSERT_EQ(goals.size() + 1, crowd.size());
  }
  EXPECT_GT(num_crowds, 500);
  EXPECT_EQ(describe_crowd({AgentId(4)}), "agent 4 cannot reach any of its goals");
  EXPECT_EQ(describe_crowd({AgentId(1), AgentId(4)}), "agents 1 and 4 can only end at 1 goal");
}

TEST(Assignment, EndsAtALimit) {
  Limits none;
  none.looks = 0;
  LimitMonitor limits(none);
  EXPECT_FALSE(cheapest_assignment({{{0, 1}}}, 1, limits));
}

}  // namespace
}  // namespace quadrille
