// SPDX-License-Identifier: MIT
// Random small tasks with obstacles, and their cheapest paths by a search over the time-expanded
// graph.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "paths/obstacles.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/graph.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// A small graph, a task on it and obstacles of all kinds. Goals may have prices.
struct Trial {
  std::optional<Graph> graph;
  Agent task;
  std::optional<GoalPrices> prices;
  ObstacleTable table;
  std::vector<ObstacleId> active;
};

inline Trial random_trial(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  Trial trial;
  if (below(2) == 0) {
    const auto width = static_cast<std::int32_t>(1 + below(4));
    trial.graph =
        Graph::grid(width, 3, std::vector<bool>(static_cast<std::size_t>(3 * width), true));
  } else {
    const std::size_t n = 2 + below(8);
    std::vector<Graph::Edge> edges;
    for (std::size_t v = 1; v < n; ++v) edges.emplace_back(VertexId(below(v)), VertexId(v));
    if (n > 2 && std::find(edges.begin(), edges.end(), Graph::Edge(VertexId(0), VertexId(n - 1))) ==
                     edges.end())
      edges.emplace_back(VertexId(0), VertexId(n - 1));
    trial.graph = Graph::make(n, edges).value();
  }
  const std::size_t n = trial.graph->num_vertices();
  const auto vertex = [&] { return VertexId(below(n)); };
  const auto time = [&] { return static_cast<Timestep>(below(8)); };
  trial.task = {vertex(), vertex()};
  if (below(3) == 0) trial.task.goals = Goals({vertex(), vertex(), vertex()});
  const AgentId agent(0);
  for (std::size_t k = below(14); k > 0; --k) {
    const std::size_t kind = below(8);
    if (kind < 2) {
      trial.active.push_back(trial.table.add_point(agent, {}, {vertex(), 1 + time()}));
    } else if (kind < 4) {
      const VertexId u = vertex();
      const auto neighbours = trial.graph->neighbours(u);
      if (!neighbours.empty())
        trial.active.push_back(
            trial.table.add_edge(agent, {}, u, neighbours[below(neighbours.size())], time()));
    } else if (kind == 4) {
      const Timestep first = 1 + time();
      const Timestep last = below(4) == 0 && below(4) == 0 ? kForever : first + time() / 2;
      trial.active.push_back(trial.table.add_range(agent, {}, vertex(), first, last));
    } else if (kind == 5) {
      trial.active.push_back(trial.table.add_end(agent, {}, vertex()));
    } else if (kind == 6) {
      const auto goals = trial.task.goals.vertices();
      if (below(3) == 0)
        trial.active.push_back(trial.table.add_elsewhere(agent, {}, goals[below(goals.size())]));
    } else {
      std::vector<Visit> visits;
      for (std::size_t v = 1 + below(3); v > 0; --v) visits.push_back({vertex(), 1 + time()});
      trial.active.push_back(trial.table.add_barrier(agent, {}, visits));
    }
  }
  return trial;
}

inline bool allows(const Trial& trial, std::span<const ObstacleId> obstacles, VertexId from,
                   VertexId to, Timestep arrival) {
  return std::none_of(obstacles.begin(), obstacles.end(), [&](ObstacleId id) {
    const Obstacle& o = trial.table[id];
    if (o.kind == Obstacle::Kind::edge)
      return o.first == arrival - 1 &&
             ((o.vertex == from && o.to == to) || (o.vertex == to && o.to == from));
    if (o.kind == Obstacle::Kind::end || o.kind == Obstacle::Kind::elsewhere) return false;
    if (o.kind != Obstacle::Kind::barrier)
      return o.vertex == to && o.first <= arrival && arrival <= o.last;
    const auto visits = trial.table.visits(o);
    return std::find(visits.begin(), visits.end(), Visit{to, arrival}) != visits.end();
  });
}

/// The same with more goals, which have prices.
inline Trial random_priced_trial(unsigned seed) {
  Trial trial = random_trial(seed);
  std::mt19937 random(seed + 1'000'000);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::size_t n = trial.graph->num_vertices();
  std::vector<VertexId> goals{trial.task.goals.vertices().front()};
  for (std::size_t k = below(4); k > 0; --k) goals.emplace_back(below(n));
  trial.task.goals = Goals(goals);
  trial.prices.emplace(n, 0);
  const std::size_t dearest = 1 + below(9);
  for (const VertexId goal : goals) (*trial.prices)[goal] = static_cast<Timestep>(below(dearest));
  return trial;
}

/// The least cost around the obstacles, nullopt if it is more than `limit`.
inline std::optional<Timestep> least_cost(const Trial& trial, std::span<const ObstacleId> obstacles,
                                          Timestep limit) {
  constexpr Timestep kHorizon = 40;  // later than all finite obstacles
  std::vector<IdVector<VertexId, bool>> reached(
      kHorizon + 1, IdVector<VertexId, bool>(trial.graph->num_vertices(), false));
  reached[0][trial.task.start] = true;
  for (std::size_t t = 0; t < kHorizon; ++t)
    for (const VertexId v : IdRange<VertexId>(trial.graph->num_vertices())) {
      if (!reached[t][v]) continue;
      const auto step = [&](VertexId w) {
        if (allows(trial, obstacles, v, w, static_cast<Timestep>(t) + 1)) reached[t + 1][w] = true;
      };
      step(v);
      for (const VertexId w : trial.graph->neighbours(v)) step(w);
    }
  std::optional<Timestep> least;
  for (const VertexId goal : trial.task.goals.vertices()) {
    if (!allows(trial, obstacles, goal, goal, kHorizon)) continue;
    if (std::any_of(obstacles.begin(), obstacles.end(), [&](ObstacleId id) {
          const Obstacle& o = trial.table[id];
          return (o.kind == Obstacle::Kind::end && o.vertex == goal) ||
                 (o.kind == Obstacle::Kind::elsewhere && o.vertex != goal);
        }))
      continue;
    Timestep from = kHorizon;  // the goal is allowed from then on
    while (from > 0 && allows(trial, obstacles, goal, goal, from)) --from;
    const Timestep price = trial.prices ? (*trial.prices)[goal] : 0;
    const Timestep last = std::min(limit, least.value_or(limit)) - price;
    for (Timestep t = from == 0 ? 0 : from + 1; t <= last; ++t)
      if (reached[static_cast<std::size_t>(t)][goal]) {
        least = t + price;
        break;
      }
  }
  return least;
}

inline void expect_path(const Trial& trial, const Path& path) {
  ASSERT_EQ(path.front(), trial.task.start);
  ASSERT_TRUE(trial.task.goals.contains(path.back()));
  for (std::size_t t = 1; t < path.size(); ++t)
    ASSERT_TRUE(path[t] == path[t - 1] || trial.graph->adjacent(path[t - 1], path[t]));
  for (const ObstacleId id : trial.active) ASSERT_FALSE(trial.table.hits(id, path));
}

}  // namespace quadrille::discrete
