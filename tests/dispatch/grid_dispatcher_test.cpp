// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/grid_dispatcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

#include "quadrille/dispatch/grid_simulation.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::dispatch {
namespace {

using discrete::Graph;

std::shared_ptr<const Graph> hall(std::int32_t width, std::int32_t height) {
  return std::make_shared<const Graph>(Graph::grid(
      width, height, std::vector<bool>(static_cast<std::size_t>(width * height), true)));
}

/// Shelves of two by four, with aisles of one between them.
std::shared_ptr<const Graph> warehouse() {
  const std::int32_t width = 25, height = 13;
  std::vector<bool> passable;
  for (std::int32_t y = 0; y < height; ++y)
    for (std::int32_t x = 0; x < width; ++x)
      passable.push_back(y % 3 == 0 || x % 5 == 0 || x < 2 || x > width - 3);
  return std::make_shared<const Graph>(Graph::grid(width, height, passable));
}

std::vector<VertexId> places_on(const Graph& graph, std::size_t count, std::uint64_t seed) {
  support::Random random(seed);
  std::vector<VertexId> places;
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) places.emplace_back(v);
  random.shuffle(places);
  places.resize(count);
  return places;
}

GridOptions quick(std::int64_t microseconds) {
  GridOptions options;
  options.effort = Effort::microseconds(microseconds);
  options.window = 12;
  return options;
}

struct Tally {
  std::size_t num_served = 0;
  Cost cost = 0, lower_bound = 0;
};

Tally run_for(GridSimulation& simulation, std::size_t steps) {
  Tally run;
  for (std::size_t k = 0; k < steps; ++k) {
    const News news = simulation.step();
    run.num_served += news.served.size();
    EXPECT_LE(news.lower_bound, news.cost);
    run.cost += news.cost;
    run.lower_bound += news.lower_bound;
  }
  return run;
}

TEST(GridDispatcher, NobodyCollidesOrIsStuck) {
  const auto graph = warehouse();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto dispatcher = GridDispatcher::make(graph, places_on(*graph, 30 * seed, seed), quick(500));
    ASSERT_TRUE(dispatcher);
    SimulationOptions options;
    options.pause_chance = seed % 2 == 0 ? 0.05 : 0;
    options.longest_pause = 6;
    options.service = Ticks(static_cast<std::int64_t>(seed));
    options.seed = seed;
    GridSimulation simulation(*dispatcher, graph, options);
    const std::size_t steps = support::scaled(1000);
    const Tally run = run_for(simulation, steps);
    EXPECT_EQ(simulation.num_contacts(), 0U) << seed;
    EXPECT_LT(simulation.longest_stay(), 1000) << seed;
    EXPECT_GT(run.num_served, steps / 5) << seed;
  }
}

// However little time there is, everybody comes to its goals.
TEST(GridDispatcher, GoesOnWithoutEffort) {
  const auto graph = hall(9, 9);
  for (const std::int64_t effort : {0, 20}) {
    auto dispatcher = GridDispatcher::make(graph, places_on(*graph, 40, 2), quick(effort)).value();
    GridSimulation simulation(dispatcher, graph, {1, 0.02, 5, 0, true, 3});
    EXPECT_GT(run_for(simulation, support::scaled(400)).num_served, support::scaled(400));
    EXPECT_EQ(simulation.num_contacts(), 0U);
  }
  auto hasty = GridDispatcher::make(graph, places_on(*graph, 40, 2)).value();
  GridSimulation simulation(hasty, graph, {});
  Limits over;
  over.wall_s = 0;
  std::size_t num_served = 0;
  for (std::size_t k = 0; k < support::scaled(200); ++k)
    num_served += simulation.step(over).served.size();
  EXPECT_GT(num_served, support::scaled(100));
  EXPECT_EQ(simulation.num_contacts(), 0U);
}

TEST(GridDispatcher, EffortPays) {
  const auto graph = warehouse();
  std::size_t num_served[2];
  for (const std::size_t k : {0U, 1U}) {
    auto dispatcher =
        GridDispatcher::make(graph, places_on(*graph, 100, 5), quick(k == 0 ? 0 : 3000)).value();
    GridSimulation simulation(dispatcher, graph, {});
    num_served[k] = run_for(simulation, support::scaled(300)).num_served;
  }
  EXPECT_GT(2 * num_served[1], 3 * num_served[0]);
}

// Two robots break down in an aisle: those behind them find another way.
TEST(GridDispatcher, GoesAroundRobotsThatStopForEver) {
  const auto graph = hall(7, 7);
  std::vector<VertexId> places = places_on(*graph, 10, 4);
  auto dispatcher = GridDispatcher::make(graph, places, quick(2000)).value();
  support::Random random(4);
  const std::vector<AgentId> broken{AgentId(0), AgentId(1)};
  std::size_t num_served = 0;
  std::vector<std::size_t> served(10, 0);
  for (std::size_t t = 0; t < support::scaled(600); ++t) {
    for (std::size_t i = 0; i < 10; ++i) {
      if (dispatcher.num_tasks(AgentId(i)) > 0) continue;
      VertexId goal = places[0];
      while (goal == places[0] || goal == places[1]) goal = VertexId(random.below(49));
      EXPECT_FALSE(dispatcher.assign(AgentId(i), {goal}));
    }
    for (const AgentId robot : dispatcher.tick(broken).served) ++served[robot.index()];
    EXPECT_EQ(dispatcher.place(AgentId(0)), places[0]);
    EXPECT_EQ(dispatcher.place(AgentId(1)), places[1]);
  }
  for (std::size_t i = 2; i < 10; ++i) num_served += served[i];
  EXPECT_GT(num_served, support::scaled(600) / 2);
}

TEST(GridDispatcher, ServesForAsLongAsItShould) {
  const auto graph = hall(5, 4);
  for (std::uint64_t seed = 1; seed <= support::scaled(40); ++seed) {
    support::Random random(seed);
    auto dispatcher =
        GridDispatcher::make(graph, places_on(*graph, 9, seed), quick(seed % 3 == 0 ? 0 : 300))
            .value();
    std::vector<Task> tasks(9);
    std::vector<std::size_t> at_goal(9, 0);  // timesteps on end
    for (std::size_t t = 0; t < 60; ++t) {
      for (std::size_t i = 0; i < 9; ++i)
        if (dispatcher.num_tasks(AgentId(i)) == 0) {
          tasks[i] = {VertexId(random.below(20)),
                      Ticks(static_cast<std::int64_t>(random.below(4)))};
          EXPECT_FALSE(dispatcher.assign(AgentId(i), tasks[i]));
        }
      std::vector<VertexId> before;
      for (std::size_t i = 0; i < 9; ++i) before.push_back(dispatcher.place(AgentId(i)));
      std::vector<AgentId> held;
      for (std::size_t i = 0; i < 9; ++i)
        if (random.percent(5)) held.emplace_back(i);
      for (const AgentId robot : dispatcher.tick(held).served) {
        const std::size_t i = robot.index();
        EXPECT_GE(Ticks(static_cast<std::int64_t>(at_goal[i])), tasks[i].service) << seed;
        EXPECT_TRUE(tasks[i].goals.contains(before[i])) << seed;
        at_goal[i] = 0;
      }
      for (std::size_t i = 0; i < 9; ++i) {
        const bool stays = dispatcher.place(AgentId(i)) == before[i];
        at_goal[i] = stays && tasks[i].goals.contains(before[i]) ? at_goal[i] + 1 : 0;
      }
    }
  }
}

TEST(GridDispatcher, OnePlaceIsForOneAtATime) {
  const auto graph = hall(4, 3);
  auto dispatcher = GridDispatcher::make(graph, places_on(*graph, 4, 3)).value();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FALSE(dispatcher.assign(AgentId(i), {VertexId(5), 4}));
    EXPECT_FALSE(dispatcher.assign(AgentId(i), {VertexId(2 * i), 0}));
  }
  std::vector<AgentId> served;
  for (int step = 0; step < 60; ++step)
    for (const AgentId robot : dispatcher.tick().served) served.push_back(robot);
  EXPECT_EQ(served.size(), 8U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(dispatcher.num_tasks(AgentId(i)), 0U);
}

TEST(GridDispatcher, WhoIsUrgentGoesFirst) {
  // A street with a place to give way: who is urgent has the straight way.
  const auto graph = std::make_shared<const Graph>(
      Graph::grid(5, 2, {true, true, true, true, true, false, false, true, false, false}));
  for (const bool is_second_urgent : {false, true}) {
    auto dispatcher = GridDispatcher::make(graph, {VertexId(0), VertexId(4)}, quick(0)).value();
    EXPECT_FALSE(dispatcher.assign(AgentId(0), {VertexId(4)}));
    EXPECT_FALSE(dispatcher.assign(
        AgentId(1), {VertexId(0), 0, is_second_urgent ? std::optional(Ticks(4)) : std::nullopt}));
    std::vector<AgentId> served;
    for (int step = 0; step < 40; ++step)
      for (const AgentId robot : dispatcher.tick().served) served.push_back(robot);
    ASSERT_EQ(served.size(), 2U);
    EXPECT_EQ(served.front(), AgentId(is_second_urgent ? 1 : 0));
  }
}

// Edges are closed and opened again all the time, also so that goals are cut off.
TEST(GridDispatcher, NobodyTakesEdgesThatAreClosed) {
  const auto graph = warehouse();
  std::vector<Graph::Edge> edges;
  for (const VertexId v : IdRange<VertexId>(graph->num_vertices()))
    for (const VertexId w : graph->neighbours(v))
      if (v < w) edges.emplace_back(v, w);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    support::Random random(seed);
    auto dispatcher =
        GridDispatcher::make(graph, places_on(*graph, 40, seed), quick(seed == 1 ? 0 : 500))
            .value();
    SimulationOptions options{1, 0.02, 4, 2, true, seed};
    GridSimulation simulation(dispatcher, graph, options);
    std::set<Graph::Edge> closed;
    const auto open_one = [&] {
      const std::vector<Graph::Edge> all(closed.begin(), closed.end());
      const Graph::Edge edge = random.pick(all);
      EXPECT_FALSE(dispatcher.open(edge.second, edge.first));
      closed.erase(edge);
    };
    std::size_t num_served = 0, num_waiting = 0;
    const auto step = [&] {
      std::vector<VertexId> before;
      for (std::size_t i = 0; i < 40; ++i) before.push_back(dispatcher.place(AgentId(i)));
      const News news = simulation.step();
      num_served += news.served.size();
      num_waiting += news.num_waiting;
      for (std::size_t i = 0; i < 40; ++i) {
        const VertexId a = before[i], b = dispatcher.place(AgentId(i));
        EXPECT_FALSE(closed.contains({std::min(a, b), std::max(a, b)})) << seed;
      }
    };
    for (std::size_t t = 0; t < support::scaled(400); ++t) {
      if (t % 5 == 0) {
        const Graph::Edge edge = random.pick(edges);
        const auto error = dispatcher.close(edge.first, edge.second);
        EXPECT_EQ(error.has_value(), closed.contains(edge));
        closed.insert(edge);
        if (closed.size() > 40) open_one();
      }
      step();
    }
    EXPECT_GT(num_served, support::scaled(400) / 10) << seed;
    EXPECT_GT(num_waiting, 0U);
    while (!closed.empty()) open_one();
    for (int t = 0; t < 200; ++t) step();
    EXPECT_EQ(simulation.num_contacts(), 0U) << seed;
    EXPECT_LT(simulation.longest_stay(), static_cast<Timestep>(support::scaled(400)) + 200);
  }
}

TEST(GridDispatcher, GoalsBehindClosedEdgesWait) {
  const auto graph = hall(4, 1);
  auto dispatcher = GridDispatcher::make(graph, {VertexId(0)}).value();
  EXPECT_FALSE(dispatcher.assign(AgentId(0), {VertexId(3)}));
  static_cast<void>(dispatcher.tick());
  EXPECT_FALSE(dispatcher.close(VertexId(2), VertexId(1)));
  for (int t = 0; t < 5; ++t) {
    const News news = dispatcher.tick();
    EXPECT_EQ(news.num_waiting, 1U);
    EXPECT_EQ(news.cost, 0);
    EXPECT_LE(dispatcher.place(AgentId(0)), VertexId(1));
  }
  EXPECT_FALSE(dispatcher.assign(AgentId(0), {VertexId(0)}));
  EXPECT_FALSE(dispatcher.open(VertexId(1), VertexId(2)));
  std::size_t served = 0;
  for (int t = 0; t < 10; ++t) served += dispatcher.tick().served.size();
  EXPECT_EQ(served, 2U);
  EXPECT_EQ(dispatcher.place(AgentId(0)), VertexId(0));
  EXPECT_EQ(dispatcher.close(VertexId(0), VertexId(2))->message,
            "there is no edge between vertices 0 and 2");
  EXPECT_EQ(dispatcher.open(VertexId(0), VertexId(1))->message,
            "the edge between (0, 0) and (1, 0) is not closed");
}

// Robots that wait for nothing but what they follow: clocks go on as the order allows.
TEST(GridDispatcher, WhoObeysTheOrderCollidesWithNobody) {
  const auto graph = hall(6, 5);
  for (std::uint64_t seed = 1; seed <= support::scaled(40); ++seed) {
    auto dispatcher = GridDispatcher::make(graph, places_on(*graph, 16, seed), quick(300)).value();
    GridSimulation simulation(dispatcher, graph, {1, 0.05, 4, 1, true, seed});
    static_cast<void>(run_for(simulation, 15));
    const execution::Precedences order = dispatcher.order();
    std::vector<std::size_t> at(16, 0);  // moves that are done
    std::vector<VertexId> place;
    for (std::size_t i = 0; i < 16; ++i) place.push_back(dispatcher.place(AgentId(i)));
    support::Random random(seed);
    for (int step = 0; step < 600; ++step) {
      const std::size_t i = random.below(16);
      const auto& moves = order.moves[AgentId(i)];
      if (at[i] == moves.size()) continue;
      const bool waits = std::any_of(order.list.begin(), order.list.end(), [&](const auto& p) {
        return p.follower.agent == AgentId(i) && p.follower.move == at[i] &&
               at[p.leader.agent.index()] <= p.leader.move;
      });
      if (waits) continue;
      EXPECT_EQ(moves[at[i]].from, place[i]);
      place[i] = moves[at[i]++].to;
      for (std::size_t j = 0; j < 16; ++j) EXPECT_TRUE(i == j || place[i] != place[j]) << seed;
    }
    EXPECT_GT(std::accumulate(at.begin(), at.end(), std::size_t{0}), 10U) << seed;
  }
}

TEST(GridDispatcher, SaysTheSameAgain) {
  const auto graph = warehouse();
  std::vector<discrete::Path> paths[2];
  for (auto& end : paths) {
    auto dispatcher = GridDispatcher::make(graph, places_on(*graph, 60, 6), quick(1000)).value();
    GridSimulation simulation(dispatcher, graph, {1, 0.03, 4, 1, true, 6});
    static_cast<void>(run_for(simulation, 60));
    for (std::size_t i = 0; i < 60; ++i) end.push_back(dispatcher.path(AgentId(i)));
  }
  EXPECT_EQ(paths[0], paths[1]);
}

TEST(GridDispatcher, CancelledTasksAreForgotten) {
  const auto graph = hall(5, 1);
  auto dispatcher = GridDispatcher::make(graph, {VertexId(0)}).value();
  EXPECT_FALSE(dispatcher.assign(AgentId(0), {VertexId(4)}));
  static_cast<void>(dispatcher.tick());
  EXPECT_FALSE(dispatcher.cancel(AgentId(0)));
  EXPECT_EQ(dispatcher.num_tasks(AgentId(0)), 0U);
  EXPECT_EQ(dispatcher.tick().cost, 0);
  EXPECT_EQ(dispatcher.cancel(AgentId(1))->message, "there is no robot 1");
}

TEST(GridDispatcher, RefusesWhatMakesNoSense) {
  const auto graph = std::make_shared<const Graph>(Graph::grid(4, 1, {true, true, false, true}));
  const auto message = [&](std::vector<VertexId> places, const GridOptions& options = {}) {
    return GridDispatcher::make(graph, std::move(places), options).error().message;
  };
  EXPECT_EQ(message({VertexId(1), VertexId(1)}), "robots 0 and 1 are both at (1, 0)");
  EXPECT_EQ(message({VertexId(3)}), "robot 0 is at vertex 3, but there are 3 vertices");
  GridOptions none;
  none.window = 0;
  EXPECT_EQ(message({}, none), "a window has at least one timestep");
  const auto directed =
      std::make_shared<const Graph>(Graph::make_directed(2, {{VertexId(0), VertexId(1)}}).value());
  EXPECT_EQ(GridDispatcher::make(directed, {}).error().message,
            "fleets on graphs with one-way edges are not supported");
  auto dispatcher = GridDispatcher::make(graph, {VertexId(0)}).value();
  EXPECT_EQ(dispatcher.assign(AgentId(1), {VertexId(0)})->message, "there is no robot 1");
  EXPECT_EQ(dispatcher.assign(AgentId(0), {VertexId(9)})->message,
            "robot 0 is sent to vertex 9, but there are 3 vertices");
  EXPECT_EQ(dispatcher.assign(AgentId(0), {VertexId(2)})->message,
            "there is no way for robot 0 from (0, 0) to where it is sent");
  EXPECT_EQ(dispatcher.assign(AgentId(0), {VertexId(1), -1})->message,
            "the task of robot 0 has a time that is negative or too long");
}

}  // namespace
}  // namespace quadrille::dispatch
