// SPDX-License-Identifier: MIT
#include "rolling/visit_order.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "discrete/rolling/crowds.hpp"
#include "support/environment.hpp"

namespace quadrille::discrete {
namespace {

using test::can_follow;
using test::random_walks;
using test::small_grid;
using test::some_places;

/// Without waits.
Path visits(const Path& path) {
  Path visits;
  for (const VertexId v : path)
    if (visits.empty() || visits.back() != v) visits.push_back(v);
  return visits;
}

std::vector<VertexId> configuration(const std::vector<Path>& paths, std::size_t t) {
  std::vector<VertexId> places;
  for (const Path& path : paths) places.push_back(path[t]);
  return places;
}

TEST(VisitOrder, NobodyIsLateIfNobodyIsHeldUp) {
  const std::vector<Path> paths{{VertexId(0), VertexId(1), VertexId(2)},
                                {VertexId(1), VertexId(2), VertexId(3)}};
  EXPECT_EQ(retimed(4, paths, [](AgentId, VertexId, Timestep) { return false; }), paths);
}

TEST(VisitOrder, WhoFollowsWaits) {
  // The first one is held up for a step, the second one goes behind it; the third one has to pass
  // before the first in vertex 2.
  const std::vector<Path> paths{{VertexId(1), VertexId(1), VertexId(2), VertexId(3), VertexId(3)},
                                {VertexId(0), VertexId(0), VertexId(1), VertexId(2), VertexId(2)},
                                {VertexId(5), VertexId(2), VertexId(4), VertexId(4), VertexId(4)}};
  const auto is_held = [](AgentId i, VertexId, Timestep t) { return i == AgentId(2) && t < 2; };
  const auto late = retimed(6, paths, is_held);
  EXPECT_EQ(late[2], (Path{VertexId(5), VertexId(5), VertexId(5), VertexId(2), VertexId(4)}));
  EXPECT_EQ(late[0], (Path{VertexId(1), VertexId(1), VertexId(1), VertexId(1), VertexId(2)}));
  EXPECT_EQ(late[1], (Path{VertexId(0), VertexId(0), VertexId(0), VertexId(0), VertexId(1)}));
}

TEST(VisitOrder, CirclesTurn) {
  const std::vector<Path> paths{{VertexId(0), VertexId(0), VertexId(1)},
                                {VertexId(1), VertexId(1), VertexId(2)},
                                {VertexId(2), VertexId(2), VertexId(0)}};
  const auto late = retimed(3, paths, [](AgentId, VertexId, Timestep) { return false; });
  EXPECT_EQ(configuration(late, 1), configuration(paths, 2));
}

// Random paths, and random pauses: nobody collides, who is held stays, all do what they would have
// done, and in a step without pauses somebody goes on, as long as there is something left to do.
TEST(VisitOrder, NobodyCollidesOrIsStuckWhoeverIsHeldUp) {
  support::Random random(7);
  for (std::size_t round = 0; round < support::scaled(3000); ++round) {
    const Graph graph = small_grid(random);
    const std::size_t num_agents = random.between(2, graph.num_vertices() - 1);
    const std::size_t length = random.between(1, 9);
    const auto paths = random_walks(random, graph, some_places(random, graph, num_agents), length);
    std::vector<std::vector<bool>> held(length, std::vector<bool>(num_agents, false));
    std::vector<bool> is_calm(length, true);
    for (std::size_t t = 0; t < length; ++t)
      for (std::size_t i = 0; i < num_agents && t % 3 != 2; ++i)
        if (random.percent(15)) {
          held[t][i] = true;
          is_calm[t] = false;
        }
    const auto late = retimed(graph.num_vertices(), paths, [&](AgentId i, VertexId, Timestep t) {
      return static_cast<bool>(held[static_cast<std::size_t>(t)][i.index()]);
    });
    for (std::size_t t = 0; t < length; ++t) {
      ASSERT_TRUE(can_follow(graph, configuration(late, t), configuration(late, t + 1))) << round;
      bool has_moved = false, has_all = true;
      for (std::size_t i = 0; i < num_agents; ++i) {
        ASSERT_TRUE(!held[t][i] || late[i][t] == late[i][t + 1]) << round;
        has_moved = has_moved || late[i][t] != late[i][t + 1];
        const Path done(late[i].begin(), late[i].begin() + static_cast<std::ptrdiff_t>(t) + 1);
        has_all = has_all && visits(done) == visits(paths[i]);
      }
      ASSERT_TRUE(!is_calm[t] || has_moved || has_all) << round;
    }
    for (std::size_t i = 0; i < num_agents; ++i) {
      const Path asked = visits(paths[i]), done = visits(late[i]);
      ASSERT_LE(done.size(), asked.size());
      EXPECT_TRUE(std::equal(done.begin(), done.end(), asked.begin())) << round;
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete
