// SPDX-License-Identifier: MIT
#include "quadrille/continuous/instance.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous {
namespace {

/// A square of places, 10 units apart, with edges to the right and left neighbours and to those
/// above and below.
Roadmap square(std::size_t side) {
  std::vector<Point> places;
  std::vector<Edge> edges;
  for (std::size_t v = 0; v < side * side; ++v) {
    places.push_back({Length(10 * static_cast<std::int64_t>(v % side)),
                      Length(10 * static_cast<std::int64_t>(v / side))});
    const auto join = [&](std::size_t w) {
      edges.push_back({VertexId(v), VertexId(w), {}, Groups::all()});
      edges.push_back({VertexId(w), VertexId(v), {}, Groups::all()});
    };
    if (v % side + 1 < side) join(v + 1);
    if (v + side < side * side) join(v + side);
  }
  return Roadmap::make(places, edges).value();
}

std::vector<Agent> all_places_taken(std::size_t count, Length radius) {
  std::vector<Agent> agents;
  for (std::size_t v = 0; v < count; ++v)
    agents.push_back({VertexId(v), VertexId((v + 7) % count), Disc{radius}});
  return agents;
}

// Looks at all pairs and a search for each agent took 14 seconds here.
TEST(Instance, TwentyThousandBodiesAreCheckedSoon) {
  const std::size_t count = support::scaled(20'000);
  std::size_t side = 1;
  while (side * side < count) ++side;
  const double begin = thread_cpu_seconds();
  const auto instance = Instance::make(square(side), all_places_taken(count, 5));
  EXPECT_LT(thread_cpu_seconds() - begin, 3);
  ASSERT_TRUE(instance.has_value()) << instance.error().to_string();
}

TEST(Instance, NamesTheFirstAgentThatOverlapsAnEarlierOne) {
  std::vector<Agent> agents = all_places_taken(60, 5);
  agents[50].body = Disc{Length(16)};  // meets 30, 40, 41 and others
  const auto starts = Instance::make(square(10), agents);
  ASSERT_FALSE(starts.has_value());
  EXPECT_EQ(starts.error().message, "the starts of agents 30 and 50 overlap");
  agents[50] = {VertexId(50), agents[20].goals, Disc{5}};
  agents[45].goals = agents[25].goals;
  const auto goals = Instance::make(square(10), agents);
  ASSERT_FALSE(goals.has_value());
  EXPECT_EQ(goals.error().message, "the goals of agents 25 and 45 overlap");
  agents[45].leaves = agents[20].leaves = true;
  EXPECT_TRUE(Instance::make(square(10), agents).has_value());
}

TEST(Instance, NamesTheAgentAtWhoseStartAnObstacleIs) {
  MovingObstacle obstacle{Disc{6}, {{{55, 40}, 0, 10}}, false};
  const auto refused = Instance::make(square(10), all_places_taken(60, 5), {}, {}, {obstacle});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message, "obstacle 0 is at the start of agent 45");
  obstacle.path.front().arrive = 1;
  EXPECT_TRUE(Instance::make(square(10), all_places_taken(60, 5), {}, {}, {obstacle}).has_value());
}

}  // namespace
}  // namespace quadrille::continuous
