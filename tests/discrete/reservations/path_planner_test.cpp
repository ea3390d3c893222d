// SPDX-License-Identifier: MIT
#include "reservations/path_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "neighbourhoods/neighbourhoods.hpp"
#include "pibt/pibt.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/case_text.hpp"
#include "support/generators.hpp"

namespace quadrille::discrete {
namespace {

std::shared_ptr<const GoalDistances> distances_of(const Instance& instance) {
  LimitMonitor limits{Limits{}};
  return GoalDistances::make(instance, limits);
}

/// A random walk from the agent's start, with waits.
Path random_walk(support::Random& random, const Graph& graph, VertexId start) {
  Path path(1, start);
  for (std::size_t left = random.below(12); left > 0; --left) {
    const auto near = graph.neighbours(path.back());
    const std::size_t way = random.below(near.size() + 1);
    path.push_back(way == near.size() ? path.back() : near[way]);
  }
  path.resize(static_cast<std::size_t>(arrival(path)) + 1);
  return path;
}

bool collide(const Path& a, const Path& b) {
  const auto end = static_cast<Timestep>(std::max(a.size(), b.size()));
  for (Timestep t = 0; t <= end; ++t) {
    if (position(a, t) == position(b, t)) return true;
    if (position(a, t) == position(b, t + 1) && position(a, t + 1) == position(b, t)) return true;
  }
  return false;
}

/// The earliest arrival for good at a goal, timestep by timestep.
std::optional<Timestep> earliest(const Instance& instance, AgentId agent, VertexId goal,
                                 const std::vector<Path>& others, Timestep latest) {
  const Graph& graph = instance.graph();
  const VertexId start = instance.agents()[agent].start;
  const auto is_free = [&](VertexId v, Timestep t) {
    return std::none_of(others.begin(), others.end(),
                        [&](const Path& path) { return position(path, t) == v; });
  };
  std::vector<char> reached(graph.num_vertices(), 0);
  reached[start.index()] = 1;
  Timestep goal_free = 0;  // From here on.
  for (Timestep t = 0; t <= latest + 40; ++t)
    if (!is_free(goal, t)) goal_free = t + 1;
  for (Timestep t = 0; t <= latest; ++t) {
    if (reached[goal.index()] != 0 && t >= goal_free) return t;
    std::vector<char> next(graph.num_vertices(), 0);
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      if (reached[v.index()] == 0) continue;
      if (is_free(v, t + 1)) next[v.index()] = 1;
      for (const VertexId w : graph.neighbours(v))
        if (is_free(w, t + 1) && std::none_of(others.begin(), others.end(), [&](const Path& path) {
              return position(path, t) == w && position(path, t + 1) == v;
            }))
          next[w.index()] = 1;
    }
    reached = next;
  }
  return std::nullopt;
}

TEST(PathPlanner, FindsTheEarliestPathAmongOthers) {
  support::Random random(1);
  Random draws(1);
  LimitMonitor limits{Limits{}};
  int num_found = 0, num_none = 0, num_late = 0;
  for (int round = 0; round < 6000; ++round) {
    const Instance instance = random.below(3) == 0 ? support::random_graph(random, 8, 5)
                                                   : support::random_grid(random, {1, 5, 40, 2, 5});
    const auto distances = distances_of(instance);
    const AgentId agent(0);
    if ((*distances)(agent, instance.agents()[agent].start) == kUnreachable) continue;
    std::vector<Path> others;
    Reservations reservations(instance.graph().num_vertices());
    for (const AgentId other : instance.agent_ids()) {
      const Path path = random_walk(random, instance.graph(), instance.agents()[other].start);
      if (other == agent || std::any_of(others.begin(), others.end(), [&](const Path& earlier) {
            return collide(path, earlier);
          }))
        continue;
      others.push_back(path);
      reservations.add(other, path);
    }
    const auto latest = static_cast<Timestep>(random.below(30));
    const VertexId goal = instance.agents()[agent].goal();
    const auto expected = earliest(instance, agent, goal, others, latest);
    PathPlanner planner(instance, *distances, draws);
    const auto path = planner.find(agent, reservations, latest, 1'000'000, limits);
    ASSERT_EQ(path.has_value(), expected.has_value()) << support::instance_text(instance);
    ++(path ? num_found : num_none);
    if (!path) continue;
    ASSERT_EQ(arrival(*path), *expected) << support::instance_text(instance);
    ASSERT_EQ(path->size(), static_cast<std::size_t>(*expected) + 1);
    ASSERT_EQ(path->front(), instance.agents()[agent].start);
    ASSERT_EQ(path->back(), instance.agents()[agent].goal());
    for (std::size_t t = 1; t < path->size(); ++t)
      ASSERT_TRUE((*path)[t - 1] == (*path)[t] ||
                  instance.graph().adjacent((*path)[t - 1], (*path)[t]));
    for (const Path& other : others) ASSERT_FALSE(collide(*path, other));
    if (*expected > (*distances)(agent, path->front())) ++num_late;
  }
  EXPECT_GT(num_found, 1000);
  EXPECT_GT(num_none, 500);
  EXPECT_GT(num_late, 300);
}

// Of several goals that one where the arrival and the price come to least.
TEST(PathPlanner, FindsTheCheapestOfGoalsWithPrices) {
  support::Random random(2);
  Random draws(2);
  LimitMonitor limits{Limits{}};
  int num_found = 0, num_none = 0, num_farther = 0;
  for (int round = 0; round < 6000; ++round) {
    const Instance instance = support::with_more_goals(
        random, random.below(3) == 0 ? support::random_graph(random, 8, 5)
                                     : support::random_grid(random, {1, 5, 40, 2, 5}));
    GoalPrices prices(instance.graph().num_vertices(), 0);
    if (random.percent(80))
      for (Timestep& price : prices) price = static_cast<Timestep>(random.below(7));
    const auto distances = GoalDistances::make(instance, prices, limits);
    const AgentId agent(0);
    std::vector<Path> others;
    Reservations reservations(instance.graph().num_vertices());
    for (const AgentId other : instance.agent_ids()) {
      const Path path = random_walk(random, instance.graph(), instance.agents()[other].start);
      if (other == agent || std::any_of(others.begin(), others.end(), [&](const Path& earlier) {
            return collide(path, earlier);
          }))
        continue;
      others.push_back(path);
      reservations.add(other, path);
    }
    const auto latest = static_cast<Timestep>(random.below(30));
    std::optional<Timestep> expected, nearest;
    for (const VertexId goal : instance.agents()[agent].goals.vertices()) {
      const auto there = earliest(instance, agent, goal, others, latest);
      if (!there) continue;
      nearest = std::min(*there, nearest.value_or(*there));
      const Timestep cost = *there + prices[goal];
      if (cost <= latest) expected = std::min(cost, expected.value_or(cost));
    }
    const VertexId start = instance.agents()[agent].start;
    if ((*distances)(agent, start) == kUnreachable) continue;
    PathPlanner planner(instance, *distances, draws);
    const auto path = planner.find(agent, reservations, latest, 1'000'000, limits);
    ASSERT_EQ(path.has_value(), expected.has_value()) << support::instance_text(instance);
    ++(path ? num_found : num_none);
    if (!path) continue;
    ASSERT_TRUE(instance.agents()[agent].goals.contains(path->back()));
    ASSERT_EQ(arrival(*path) + prices[path->back()], *expected) << support::instance_text(instance);
    ASSERT_EQ(path->size(), static_cast<std::size_t>(arrival(*path)) + 1);
    ASSERT_EQ(path->front(), start);
    for (const Path& other : others) ASSERT_FALSE(collide(*path, other));
    if (arrival(*path) > *nearest) ++num_farther;
  }
  EXPECT_GT(num_found, 1000);
  EXPECT_GT(num_none, 300);
  EXPECT_GT(num_farther, 100);
}

TEST(PathPlanner, GivesUpWhenToldTo) {
  const Instance instance =
      Instance::make(Graph::grid(20, 1, std::vector<bool>(20, true)), {{VertexId(0), VertexId(19)}})
          .value();
  Random draws(1);
  const auto distances = distances_of(instance);
  PathPlanner planner(instance, *distances, draws);
  LimitMonitor limits{Limits{}};
  const Reservations nothing(20);
  EXPECT_FALSE(planner.find(AgentId(0), nothing, 100, 10, limits));
  EXPECT_EQ(planner.effort(), 10);
  EXPECT_FALSE(planner.find(AgentId(0), nothing, 18, 1000, limits));
  EXPECT_TRUE(planner.find(AgentId(0), nothing, 19, 1000, limits));
}

TEST(Reservations, KnowWhoIsWhereWhen) {
  Reservations reservations(3);
  const VertexId a(0), b(1), c(2);
  const Path first{a, a, b, c}, second{b, c, b};
  reservations.add(AgentId(0), first);
  EXPECT_EQ(reservations.stay_at(a, 1)->agent, AgentId(0));
  EXPECT_EQ(reservations.stay_at(a, 1)->next, b);
  EXPECT_EQ(reservations.stay_at(a, 2), nullptr);
  EXPECT_EQ(reservations.stay_at(b, 1), nullptr);
  EXPECT_EQ(reservations.stay_at(b, 2)->begin, 2);
  EXPECT_EQ(reservations.stay_at(c, 1000)->end, kForever);
  reservations.remove(first);
  for (const VertexId v : {a, b, c}) EXPECT_TRUE(reservations.stays(v).empty());
  reservations.add(AgentId(1), second);
  ASSERT_EQ(reservations.stays(b).size(), 2u);
  EXPECT_EQ(reservations.first_ending_from(b, 1), 1u);
}

/// Every configuration that PIBT makes can follow the one before, whatever the orders.
TEST(Pibt, ObeysOrdersAndTheRules) {
  support::Random random(2);
  Random draws(2);
  int num_made = 0, num_refused = 0;
  for (int round = 0; round < 4000; ++round) {
    const Instance instance = random.below(3) == 0 ? support::random_graph(random, 8, 6)
                                                   : support::random_grid(random, {2, 4, 40, 2, 8});
    const auto distances = distances_of(instance);
    const Graph& graph = instance.graph();
    std::vector<VertexId> from, to;
    std::vector<AgentId> priority;
    for (const AgentId agent : instance.agent_ids()) {
      from.push_back(instance.agents()[agent].start);
      priority.insert(
          priority.begin() + static_cast<std::ptrdiff_t>(random.below(priority.size() + 1)), agent);
    }
    std::vector<Pibt::Order> orders;
    for (std::size_t k = random.below(priority.size() + 1); k > 0; --k) {
      const AgentId agent = priority[k - 1];
      const auto near = graph.neighbours(from[agent.index()]);
      const std::size_t way = random.below(near.size() + 1);
      orders.push_back({agent, way == near.size() ? from[agent.index()] : near[way]});
    }
    Pibt pibt(instance, *distances, draws);
    const bool made = pibt.advance(from, priority, orders, to);
    ++(made ? num_made : num_refused);
    // Without orders it never fails. What follows checks that it left nothing behind as well.
    if (!made) {
      ASSERT_FALSE(orders.empty());
      orders.clear();
      ASSERT_TRUE(pibt.advance(from, priority, {}, to));
    }
    for (const auto& [agent, vertex] : orders) ASSERT_EQ(to[agent.index()], vertex);
    for (std::size_t i = 0; i < from.size(); ++i) {
      ASSERT_TRUE(from[i] == to[i] || graph.adjacent(from[i], to[i]));
      for (std::size_t j = 0; j < i; ++j) {
        ASSERT_NE(to[i], to[j]) << support::instance_text(instance);
        ASSERT_FALSE(to[i] == from[j] && to[j] == from[i]) << support::instance_text(instance);
      }
    }
  }
  EXPECT_GT(num_made, 1000);
  EXPECT_GT(num_refused, 500);
}

TEST(Neighbourhoods, HaveTheSizeAskedForAndNobodyTwice) {
  support::Random random(3);
  Random draws(3);
  const Instance instance =
      support::random_tasks(random, Graph::grid(12, 12, std::vector<bool>(144, true)), 40);
  const auto distances = distances_of(instance);
  Plan plan;
  Reservations reservations(144);
  for (const AgentId agent : instance.agent_ids()) {
    plan.paths.push_back({instance.agents()[agent].start});
    reservations.add(agent, plan.paths[agent]);
  }
  Neighbourhoods neighbourhoods(instance, *distances, plan.paths, reservations, draws);
  using Rule = Neighbourhoods::Rule;
  for (const Rule rule : {Rule::delayed, Rule::place, Rule::any})
    for (const std::size_t size : {1U, 2U, 16U, 40U, 100U}) {
      auto agents = neighbourhoods.choose(rule, size, AgentId(5));
      if (rule == Rule::delayed) {
        EXPECT_EQ(agents.front(), AgentId(5));
      } else {
        EXPECT_EQ(agents.size(), std::min<std::size_t>(size, 40));
      }
      std::sort(agents.begin(), agents.end());
      EXPECT_EQ(std::adjacent_find(agents.begin(), agents.end()), agents.end());
      EXPECT_GE(agents.size(), 1u);
      EXPECT_LE(agents.size(), size);
    }
}

}  // namespace
}  // namespace quadrille::discrete
