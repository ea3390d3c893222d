// SPDX-License-Identifier: MIT
#include "primal/chosen_ends.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/geometry/body_index.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

/// The ends chosen on a row of places 1000 apart; empty if none were.
std::vector<std::size_t> ends_on_a_row(std::vector<Agent> agents) {
  const auto row = roadmap({{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  const Instance instance = Instance::make(row, std::move(agents)).value();
  LimitMonitor limits{Limits{}};
  Scene scene(instance, limits);
  const auto chosen = with_chosen_ends(scene);
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; chosen && i < chosen->num_agents(); ++i)
    ends.push_back(chosen->agent(AgentId(i)).goal().index());
  return ends;
}

Agent with_goals(std::size_t start, std::vector<VertexId> goals, bool leaves = false) {
  Agent made = agent(start, start, 300);
  made.goals = Goals(std::move(goals));
  made.leaves = leaves;
  return made;
}

using Ends = std::vector<std::size_t>;

TEST(ChosenEnds, TheNearestThatNobodyNeedsMore) {
  EXPECT_EQ(ends_on_a_row({with_goals(0, {VertexId(1), VertexId(3)})}), (Ends{1}));
  // The second one has no other, so the first one, who is asked, goes further.
  EXPECT_EQ(
      ends_on_a_row({with_goals(0, {VertexId(1), VertexId(3)}), with_goals(2, {VertexId(1)})}),
      (Ends{3, 1}));
  // In a chain.
  EXPECT_EQ(
      ends_on_a_row({with_goals(0, {VertexId(1), VertexId(2)}),
                     with_goals(1, {VertexId(2), VertexId(3)}), with_goals(2, {VertexId(1)})}),
      (Ends{2, 3, 1}));
}

TEST(ChosenEnds, TooFewAreNone) {
  EXPECT_EQ(ends_on_a_row({with_goals(0, {VertexId(1), VertexId(2)}),
                           with_goals(1, {VertexId(1), VertexId(2)}),
                           with_goals(3, {VertexId(1), VertexId(2)})}),
            Ends{});
}

TEST(ChosenEnds, WhoLeavesIsInNobodysWay) {
  EXPECT_EQ(ends_on_a_row(
                {with_goals(0, {VertexId(1), VertexId(3)}, true), with_goals(2, {VertexId(1)})}),
            (Ends{1, 1}));
}

// Each of its own goals, and bodies that stay do not overlap.
TEST(ChosenEnds, AreApart) {
  int num_chosen = 0, num_none = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(500); ++seed) {
    RandomOptions random;
    random.num_agents = 2 + seed % 4;
    random.num_vertices = 6 + seed % 5;
    random.goal_sets_percent = 80;
    random.leaves_percent = 30;
    const Instance instance = random_instance(seed, random);
    SCOPED_TRACE(describe(instance));
    LimitMonitor limits{Limits{}};
    Scene scene(instance, limits);
    const auto chosen = with_chosen_ends(scene);
    ++(chosen ? num_chosen : num_none);
    if (!chosen) continue;
    geometry::BodyIndex placed;
    for (const AgentId i : chosen->agent_ids()) {
      const Agent& agent = chosen->agent(i);
      ASSERT_TRUE(instance.agent(i).goals.contains(agent.goal()));
      if (agent.leaves) continue;
      const Point& at = chosen->roadmap().position(agent.goal());
      const Body& body = agent.body_as(chosen->roadmap().shape(agent.goal()));
      ASSERT_FALSE(placed.first_overlap(body, at));
      placed.add(i.index(), body, at);
    }
  }
  EXPECT_GT(num_chosen, num_none);
}

}  // namespace
}  // namespace quadrille::continuous::test
