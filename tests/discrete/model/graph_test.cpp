// SPDX-License-Identifier: MIT
#include "quadrille/discrete/graph.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "model/open_maps.hpp"

namespace quadrille::discrete {
namespace {

TEST(Graph, GridNumbersPassableCellsRowByRow) {
  const Graph graph = Graph::grid(3, 2, {true, false, true, true, true, true});
  EXPECT_EQ(graph.num_vertices(), 5u);
  EXPECT_EQ(graph.num_edges(), 4u);
  EXPECT_EQ(graph.layout()->vertex_at({1, 0}), std::nullopt);
  EXPECT_EQ(graph.layout()->cell_of(VertexId(2)), (Cell{0, 1}));
  EXPECT_EQ(distances_from(graph, VertexId(0))[VertexId(1)], 4);
}

TEST(Graph, RefusesWhatIsNoSimpleGraph) {
  const VertexId a(0), b(1), c(2);
  EXPECT_TRUE(Graph::make(2, {{a, b}}).has_value());
  EXPECT_FALSE(Graph::make(2, {{a, c}}).has_value());
  EXPECT_FALSE(Graph::make(2, {{a, a}}).has_value());
  EXPECT_FALSE(Graph::make(2, {{a, b}, {b, a}}).has_value());
}

TEST(Graph, IsOpenWithoutWallsUnlessItIsSmall) {
  const auto empty = [](std::int32_t side) {
    return Graph::grid(side, side, std::vector<bool>(static_cast<std::size_t>(side * side), true));
  };
  EXPECT_FALSE(is_open(empty(10)));  // 3.6 neighbours on average: not more
  EXPECT_TRUE(is_open(empty(11)));
  std::vector<bool> one_in_five(400, true);
  for (std::size_t c = 0; c < one_in_five.size(); c += 5) one_in_five[c] = false;
  EXPECT_FALSE(is_open(Graph::grid(20, 20, one_in_five)));
}

}  // namespace
}  // namespace quadrille::discrete
