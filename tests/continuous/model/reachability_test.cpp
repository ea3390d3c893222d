// SPDX-License-Identifier: MIT
#include "model/reachability.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::continuous {
namespace {

using support::Random;

Roadmap random_roadmap(Random& random, std::size_t size) {
  std::vector<Point> places;
  for (std::size_t v = 0; v < size; ++v)
    places.push_back({Length(static_cast<std::int64_t>(10 * v)), 0});
  std::vector<Edge> edges;
  for (std::size_t n = random.below(2 * size); n > 0; --n) {
    const VertexId from(random.below(size)), to(random.below(size));
    Groups open_to = Groups::all();
    if (random.percent(40)) open_to = {GroupId(random.below(2))};
    if (from != to) edges.push_back({from, to, {}, open_to});
  }
  return Roadmap::make(places, edges).value();
}

/// Warshall's closure.
std::vector<std::vector<bool>> closure(const Roadmap& roadmap, GroupId group) {
  const std::size_t n = roadmap.num_vertices();
  std::vector<std::vector<bool>> leads(n, std::vector<bool>(n, false));
  for (std::size_t v = 0; v < n; ++v) leads[v][v] = true;
  for (const Edge& edge : roadmap.edges())
    if (edge.open_to.contains(group)) leads[edge.from.index()][edge.to.index()] = true;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t v = 0; v < n; ++v)
      for (std::size_t w = 0; w < n; ++w)
        if (leads[v][k] && leads[k][w]) leads[v][w] = true;
  return leads;
}

TEST(Reachability, IsTheClosureOfTheOpenEdges) {
  Random random(3);
  std::size_t num_ways = 0, num_none = 0;
  for (std::size_t round = 0; round < support::scaled(500); ++round) {
    const std::size_t size = random.between(1, 14);
    const Roadmap roadmap = random_roadmap(random, size);
    for (const GroupId group : {GroupId(0), GroupId(1)}) {
      const auto leads = closure(roadmap, group);
      Reachability reachability(roadmap, group);
      for (std::size_t v = 0; v < size; ++v)
        for (std::size_t w = 0; w < size; ++w) {
          ASSERT_EQ(reachability.leads(VertexId(v), VertexId(w)), leads[v][w]) << v << " " << w;
          ++(leads[v][w] ? num_ways : num_none);
        }
    }
  }
  EXPECT_GT(num_ways, 1000U);
  EXPECT_GT(num_none, 1000U);
}

}  // namespace
}  // namespace quadrille::continuous
