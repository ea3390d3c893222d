// SPDX-License-Identifier: MIT
#include "feasibility/bottleneck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace quadrille::continuous::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Ends = std::pair<std::size_t, std::size_t>;

/// Vertices far apart, roads that can be used both ways, and agents that are small.
Instance make(std::size_t num_vertices, const std::vector<Ends>& roads,
              const std::vector<Ends>& tasks) {
  std::vector<Point> points;
  for (std::size_t v = 0; v < num_vertices; ++v)
    points.push_back({Length(static_cast<std::int64_t>(100 * v)),
                      Length(static_cast<std::int64_t>(100 * v * v))});
  std::vector<Edge> edges;
  for (const auto& [v, w] : roads) {
    edges.push_back({VertexId(v), VertexId(w), {}});
    edges.push_back({VertexId(w), VertexId(v), {}});
  }
  std::vector<Agent> agents;
  for (const auto& [start, goal] : tasks) {
    Agent agent;
    agent.start = VertexId(start);
    agent.goals = VertexId(goal);
    agents.push_back(agent);
  }
  return Instance::make(std::make_shared<const Roadmap>(Roadmap::make(points, edges).value()),
                        agents)
      .value();
}

// 0 - 1 - 2 - 3, and 4 beside 2.
const std::vector<Ends> kRoads{{0, 1}, {1, 2}, {2, 3}, {1, 4}, {4, 3}};

TEST(Bottleneck, IsWhatAllWaysPass) {
  const Instance instance = make(5, kRoads, {{0, 3}, {2, 4}});
  EXPECT_THAT(inevitable_vertices(instance, AgentId(0)),
              ElementsAre(VertexId(0), VertexId(1), VertexId(3)));
  EXPECT_THAT(inevitable_vertices(instance, AgentId(1)), ElementsAre(VertexId(2), VertexId(4)));
  EXPECT_THAT(find_bottleneck(instance, {AgentId(0), AgentId(1)}), IsEmpty());
  EXPECT_EQ(describe_bottleneck(instance, {AgentId(0), AgentId(1)}, {}), "");
}

TEST(Bottleneck, SaysWhoGoesWhere) {
  const Instance instance = make(5, kRoads, {{0, 3}, {3, 0}, {1, 2}});
  const auto describe = [&](const std::vector<AgentId>& agents) {
    return describe_bottleneck(instance, agents, find_bottleneck(instance, agents));
  };
  EXPECT_EQ(describe({AgentId(0), AgentId(1)}),
            "both have to pass vertices 0, 1 and 3, in opposite directions");
  EXPECT_EQ(describe({AgentId(0), AgentId(2)}), "both have to pass vertex 1");
  EXPECT_EQ(describe({AgentId(0), AgentId(1), AgentId(2)}), "all of them have to pass vertex 1");
  // In the order of the first one.
  EXPECT_THAT(find_bottleneck(instance, {AgentId(1), AgentId(0)}),
              ElementsAre(VertexId(3), VertexId(1), VertexId(0)));
  EXPECT_THAT(find_bottleneck(instance, {AgentId(1), AgentId(2)}), ElementsAre(VertexId(1)));
}

}  // namespace
}  // namespace quadrille::continuous::test
