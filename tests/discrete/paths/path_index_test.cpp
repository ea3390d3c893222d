// SPDX-License-Identifier: MIT
#include "paths/path_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "discrete/paths/count_collisions.hpp"
#include "paths/path_finder.hpp"
#include "support/distances.hpp"

namespace quadrille::discrete {
namespace {

using Kind = Encounter::Kind;

/// Collisions of two paths by their definition, as (timestep, is it a swap).
std::vector<std::pair<Timestep, bool>> collide(const Path& a, const Path& b) {
  std::vector<std::pair<Timestep, bool>> found;
  const auto end = static_cast<Timestep>(std::max(a.size(), b.size()));
  for (Timestep t = 0; t < end; ++t) {
    if (position(a, t) == position(b, t)) found.emplace_back(t, false);
    if (position(a, t) != position(a, t + 1) && position(a, t) == position(b, t + 1) &&
        position(b, t) == position(a, t + 1))
      found.emplace_back(t, true);
  }
  return found;
}

Path random_walk(const Graph& graph, const Agent& task, std::mt19937& random) {
  const auto goals = task.goals.vertices();
  const auto to_goal = distances_from(graph, goals[random() % goals.size()]);
  Path path{task.start};
  for (int t = 0; t < 6; ++t) {
    const auto steps = graph.neighbours(path.back());
    const std::size_t choice = random() % (steps.size() + 1);
    path.push_back(choice == steps.size() ? path.back() : steps[choice]);
  }
  while (to_goal[path.back()] > 0)
    for (const VertexId w : graph.neighbours(path.back()))
      if (to_goal[w] < to_goal[path.back()]) {
        path.push_back(w);
        break;
      }
  path.resize(static_cast<std::size_t>(arrival(path)) + 1);
  return path;
}

TEST(PathIndex, ListsAllCollisionsWhateverWasReplacedBefore) {
  std::mt19937 random(7);
  const Graph graph = Graph::grid(3, 3, std::vector<bool>(9, true));
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<VertexId> starts, goals;
    for (std::size_t v = 0; v < 9; ++v) starts.push_back(VertexId(v));
    goals = starts;
    std::shuffle(starts.begin(), starts.end(), random);
    std::shuffle(goals.begin(), goals.end(), random);
    std::vector<Agent> tasks;
    // Now and then several have the same two goals.
    for (std::size_t i = 0; i < 4; ++i)
      tasks.push_back({starts[i], trial % 3 == 0 && random() % 2 == 0 ? Goals({goals[0], goals[1]})
                                                                      : Goals(goals[i])});
    const Instance instance = Instance::make(graph, tasks).value();
    PathIndex index(instance);
    for (const AgentId i : instance.agent_ids())
      index.replace(i, random_walk(graph, tasks[i.index()], random));
    for (int change = 0; change < 5; ++change) {
      for (std::size_t many = random() % 3; many > 0; --many) {
        const AgentId i(random() % 4);
        index.replace(i, random_walk(graph, tasks[i.index()], random));
      }
      std::vector<std::tuple<AgentId, AgentId, Timestep, bool>> expected, found;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
          for (const auto& [t, swap] : collide(index.path(AgentId(i)), index.path(AgentId(j))))
            expected.emplace_back(AgentId(i), AgentId(j), t, swap);
      for (const Encounter& e : index.collisions()) {
        found.emplace_back(std::min(e.first, e.second), std::max(e.first, e.second), e.timestep,
                           e.kind == Kind::swap);
        if (e.kind == Kind::rest) {
          EXPECT_LE(index.cost(e.first), e.timestep);
        }
      }
      for (const AgentId i : instance.agent_ids()) {
        EXPECT_EQ(test::count_collisions(index, i, index.path(i)), index.num_collisions(i));
        // Of a path that is not there yet.
        const Path other = random_walk(graph, tasks[i.index()], random);
        int collisions = 0;
        for (const AgentId j : instance.agent_ids())
          if (j != i) collisions += static_cast<int>(collide(other, index.path(j)).size());
        EXPECT_EQ(test::count_collisions(index, i, other), collisions);
      }
      std::sort(expected.begin(), expected.end());
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected);
    }
  }
}

TEST(PathFinder, FindsAWayAroundOthersWithinTheCap) {
  const Graph graph = Graph::grid(3, 2, std::vector<bool>(6, true));
  // Agent 0 goes along the upper row, agent 1 rests in its middle.
  const Instance instance =
      Instance::make(graph, {{VertexId(0), VertexId(2)}, {VertexId(1), VertexId(1)}}).value();
  PathIndex index(instance);
  index.replace(AgentId(0), {VertexId(0), VertexId(1), VertexId(2)});
  index.replace(AgentId(1), {VertexId(1)});
  EXPECT_EQ(index.num_collisions(AgentId(0)), 1);
  const auto table = support::distances_of(instance);
  const AgentDistances distances(instance, *table, AgentId(0));
  ObstacleMap map(6);
  map.load({}, {}, distances);
  PathFinder finder(6);
  Path path;
  EXPECT_FALSE(finder.find_quietest({AgentId(0), distances, map, 3, &index}, 1, path));
  ASSERT_TRUE(finder.find_quietest({AgentId(0), distances, map, 4, &index}, 1, path));
  EXPECT_EQ(path, (Path{VertexId(0), VertexId(3), VertexId(4), VertexId(5), VertexId(2)}));
}

}  // namespace
}  // namespace quadrille::discrete
