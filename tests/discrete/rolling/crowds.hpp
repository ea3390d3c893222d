// SPDX-License-Identifier: MIT
//
// Small grids with walls, and agents on them that walk at random without colliding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrille/discrete/graph.hpp"
#include "quadrille/discrete/plan.hpp"
#include "support/random.hpp"

namespace quadrille::discrete::test {

/// Connected, with at least eight cells.
inline Graph small_grid(support::Random& random) {
  for (;;) {
    const auto width = static_cast<std::int32_t>(random.between(3, 5)),
               height = static_cast<std::int32_t>(random.between(3, 5));
    std::vector<bool> passable;
    for (std::int32_t k = 0; k < width * height; ++k) passable.push_back(!random.percent(20));
    Graph graph = Graph::grid(width, height, passable);
    if (graph.num_vertices() < 8) continue;
    bool is_connected = true;
    const auto distances = distances_from(graph, VertexId(0));
    for (std::size_t v = 0; v < graph.num_vertices(); ++v)
      is_connected = is_connected && distances[VertexId(v)] != kUnreachable;
    if (is_connected) return graph;
  }
}

inline std::vector<VertexId> some_places(support::Random& random, const Graph& graph,
                                         std::size_t count) {
  std::vector<VertexId> places;
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) places.emplace_back(v);
  random.shuffle(places);
  places.resize(count);
  return places;
}

/// Whether all may go from one configuration to the other in one timestep.
inline bool can_follow(const Graph& graph, const std::vector<VertexId>& from,
                       const std::vector<VertexId>& to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] != to[i] && !graph.adjacent(from[i], to[i])) return false;
    for (std::size_t j = 0; j < i; ++j)
      if (to[i] == to[j] || (to[i] == from[j] && to[j] == from[i])) return false;
  }
  return true;
}

/// Paths of `length` timesteps that do not collide, of agents that like to go on.
inline std::vector<Path> random_walks(support::Random& random, const Graph& graph,
                                      std::vector<VertexId> places, std::size_t length) {
  std::vector<Path> paths;
  for (const VertexId place : places) paths.push_back({place});
  for (std::size_t t = 0; t < length; ++t) {
    std::vector<VertexId> best = places;
    std::size_t most = 0;
    for (int tries = 0; tries < 200; ++tries) {
      std::vector<VertexId> to = places;
      std::size_t num_moves = 0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const auto near = graph.neighbours(places[i]);
        if (random.percent(40) || near.empty()) continue;
        to[i] = near[random.below(near.size())];
        ++num_moves;
      }
      if (num_moves <= most || !can_follow(graph, places, to)) continue;
      most = num_moves;
      best = to;
    }
    places = best;
    for (std::size_t i = 0; i < places.size(); ++i) paths[i].push_back(places[i]);
  }
  return paths;
}

}  // namespace quadrille::discrete::test
