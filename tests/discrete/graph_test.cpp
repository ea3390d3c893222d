// SPDX-License-Identifier: MIT
#include "quadrille/discrete/graph.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace quadrille::discrete
