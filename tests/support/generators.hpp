// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrille/discrete/instance.hpp"
#include "support/random.hpp"

namespace quadrille::discrete::support {

using quadrille::support::Random;

/// One graph of each isomorphism class of the connected graphs with n vertices. Requires n <= 6.
[[nodiscard]] std::vector<Graph> connected_graphs(std::size_t n);

/// All tuples of `length` different numbers below `bound`, in lexicographic order.
[[nodiscard]] std::vector<std::vector<std::size_t>> arrangements(std::size_t bound,
                                                                 std::size_t length);

/// Tasks at random, different starts and different goals, anywhere in the graph: the instance may
/// be infeasible. Requires num_agents <= number of vertices.
[[nodiscard]] Instance random_tasks(Random& random, Graph graph, std::size_t num_agents);

/// The same with goals added: for most agents a few more, or for all the same set, or so that two
/// sets are alike. May be infeasible, also because agents have too few goals among them.
[[nodiscard]] Instance with_more_goals(Random& random, const Instance& instance);

/// The same with goals by group: agents fall into groups at random, and all of a group share a set
/// that has fewer, as many or more goals than the group has agents, which sets of other groups may
/// overlap. May be infeasible.
[[nodiscard]] Instance with_group_goals(Random& random, const Instance& instance);

/// What random grids may look like. Sizes, shares and numbers are drawn uniformly.
struct GridShape {
  std::size_t min_side = 1, max_side = 6;
  std::size_t max_obstacles_percent = 40;
  std::size_t min_agents = 2, max_agents = 4;  ///< Never more than passable cells.
};
[[nodiscard]] Instance random_grid(Random& random, const GridShape& shape);

/// A random tree with some more edges, or now and then a few of them side by side, of 2 to
/// `max_vertices` vertices.
[[nodiscard]] Instance random_graph(Random& random, std::size_t max_vertices,
                                    std::size_t max_agents);

}  // namespace quadrille::discrete::support
