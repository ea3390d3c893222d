// SPDX-License-Identifier: MIT
#include "quadrille/discrete/timed_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/environment.hpp"
#include "support/generators.hpp"

namespace quadrille::discrete {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;

/// On a row of four cells: waits, goes to the third, back to the second.
TimedPlan there_and_back() {
  const auto instance =
      Instance::make(Graph::grid(4, 1, std::vector<bool>(4, true)), {{VertexId(0), VertexId(1)}});
  const Path path{VertexId(0), VertexId(0), VertexId(1), VertexId(2),
                  VertexId(2), VertexId(1), VertexId(1)};
  return TimedPlan::make(*instance, {{path}}).value();
}

TEST(DiscreteTimedPlan, StopsWaitsAndCosts) {
  const TimedPlan plan = there_and_back();
  const TimedPath& path = plan[AgentId(0)];
  EXPECT_EQ(
      path.stops(),
      (std::vector<Stop>{
          {VertexId(0), 0, 1}, {VertexId(1), 2, 2}, {VertexId(2), 3, 4}, {VertexId(1), 5, 5}}));
  EXPECT_EQ(path.waits(), (std::vector<Wait>{{VertexId(0), 0, 1}, {VertexId(2), 3, 4}}));
  EXPECT_EQ(path.cost(), 5);
  EXPECT_EQ(path.free_cost(), 1);
  EXPECT_EQ(path.delay(), 4);
  EXPECT_EQ(plan.sum_of_costs(), 5);
  EXPECT_EQ(plan.makespan(), 5);
  EXPECT_EQ(plan.delay(), 4);
}

TEST(DiscreteTimedPlan, Positions) {
  const TimedPlan plan = there_and_back();
  const TimedPath& path = plan[AgentId(0)];
  const VertexId a(0), b(1), c(2);
  EXPECT_EQ(path.at(-1), (Position{a, a, 0}));
  EXPECT_EQ(path.at(1), (Position{a, a, 0}));
  EXPECT_EQ(path.at(1.25), (Position{a, b, 0.25}));
  EXPECT_EQ(path.at(2), (Position{b, b, 0}));
  EXPECT_EQ(path.at(2.5), (Position{b, c, 0.5}));
  EXPECT_EQ(path.at(3.5), (Position{c, c, 0}));
  EXPECT_EQ(path.at(4.5), (Position{c, b, 0.5}));
  EXPECT_EQ(path.at(1e9), (Position{b, b, 0}));
  const Graph grid = Graph::grid(4, 1, std::vector<bool>(4, true));
  EXPECT_EQ(grid_point(grid, path.at(2.5)), (GridPoint{1.5, 0}));
  const Graph other = Graph::make(2, {{a, b}}).value();
  EXPECT_EQ(grid_point(other, {a, b, 0.5}), std::nullopt);
}

TEST(DiscreteTimedPlan, SamplesEndWithTheFirstOneAtTheGoal) {
  const TimedPlan plan = there_and_back();
  const TimedPath& path = plan[AgentId(0)];
  EXPECT_EQ(path.samples(1).size(), 6u);
  EXPECT_EQ(path.samples(2).size(), 11u);
  EXPECT_EQ(path.samples(0.3).size(), 3u);
  EXPECT_EQ(path.samples(1, 10).size(), 11u);
  EXPECT_EQ(path.samples(0.3).back(), (Sample{2 / 0.3, {VertexId(1), VertexId(1), 0}}));
}

TEST(DiscreteTimedPlan, RefusesWhatIsNoPlan) {
  const auto instance =
      Instance::make(Graph::grid(3, 1, std::vector<bool>(3, true)), {{VertexId(0), VertexId(2)}});
  const auto made = TimedPlan::make(*instance, {{Path{VertexId(0), VertexId(2)}}});
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code, ErrorCode::invalid_plan);
}

TEST(DiscreteTimedPlan, RandomWalksAreWhereThePathSays) {
  for (std::uint32_t seed = 0; seed < scaled(500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Instance drawn = random.percent(50)
                               ? support::random_grid(random, {.min_agents = 1, .max_agents = 1})
                               : support::random_graph(random, 8, 1);
    const Graph& graph = drawn.graph();
    Path path{drawn.agents()[AgentId(0)].start};
    for (std::size_t steps = random.below(30); steps > 0; --steps) {
      const auto next = graph.neighbours(path.back());
      const bool stays = next.empty() || random.percent(30);
      path.push_back(stays ? path.back() : next[random.below(next.size())]);
    }
    const auto instance = Instance::make(drawn.shared_graph(), {{path.front(), path.back()}});
    const Plan plan{{path}};
    const TimedPlan timed = TimedPlan::make(*instance, plan).value();
    const TimedPath& one = timed[AgentId(0)];
    EXPECT_EQ(one.cost(), arrival(path));
    EXPECT_EQ(one.free_cost(), distances_from(graph, path.front())[path.back()]);
    Cost waited = 0;
    for (const Wait& wait : one.waits()) waited += wait.until - wait.from;
    Cost repeated = 0;
    for (Timestep t = 0; t < arrival(path); ++t)
      repeated += position(path, t) == position(path, t + 1) ? 1 : 0;
    EXPECT_EQ(waited, repeated);
    // At quarters of steps: at a vertex, or on the way from one to the next.
    for (const Sample& sample : one.samples(4, static_cast<double>(one.cost() + 2))) {
      const auto step = static_cast<Timestep>(std::floor(sample.time));
      const VertexId from = position(path, step), to = position(path, step + 1);
      const double share = sample.time - step;
      EXPECT_EQ(sample.position.from, from);
      EXPECT_EQ(sample.position.to, share == 0 ? from : to);
      EXPECT_EQ(sample.position.share, from == to ? 0 : share);
      EXPECT_EQ(one.at(sample.time), sample.position);
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete
