// SPDX-License-Identifier: MIT
// What the tests of check_feasibility are made of: small graphs and their configuration spaces.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "quadrille/discrete/graph.hpp"

namespace quadrille::discrete::feasibility_testing {

using Edges = std::vector<std::pair<std::size_t, std::size_t>>;
/// The vertex of each agent.
using Configuration = std::vector<std::uint16_t>;
using Random = std::mt19937;

inline std::size_t below(Random& random, std::size_t bound) { return random() % bound; }

inline std::shared_ptr<const Graph> make_graph(std::size_t num_vertices, const Edges& edges) {
  std::vector<Graph::Edge> list;
  for (const auto& [a, b] : edges) list.emplace_back(VertexId(a), VertexId(b));
  return std::make_shared<const Graph>(Graph::make(num_vertices, list).value());
}

// ---------------------------------------------------------------- configuration space

/// All configurations of some agents on a small graph, split into classes that can reach each other
/// by timesteps as MAPF has them: every agent waits or moves, no two agents in a vertex, no swaps.
class ConfigurationSpace {
 public:
  ConfigurationSpace(const Graph& graph, std::size_t num_agents)
      : graph_(graph), num_agents_(num_agents) {
    Configuration prefix;
    list_all(prefix);
    class_of_.assign(all_.size(), SIZE_MAX);
    for (std::size_t root = 0; root < all_.size(); ++root)
      if (class_of_[root] == SIZE_MAX) flood(root);
  }
  [[nodiscard]] const std::vector<Configuration>& all() const { return all_; }
  [[nodiscard]] std::size_t class_of(std::size_t index) const { return class_of_[index]; }
  /// The rank of a configuration in lexicographic order.
  [[nodiscard]] std::size_t index_of(const Configuration& configuration) const {
    std::size_t index = 0, choices = graph_.num_vertices();
    std::uint64_t used = 0;
    for (const std::uint16_t v : configuration) {
      const std::uint64_t bit = std::uint64_t{1} << v;
      index = index * choices-- + v - static_cast<std::size_t>(std::popcount(used & (bit - 1)));
      used |= bit;
    }
    return index;
  }
  /// One configuration of each class.
  [[nodiscard]] const std::vector<std::size_t>& representatives() const { return representatives_; }

 private:
  void list_all(Configuration& prefix) {
    if (prefix.size() == num_agents_) {
      all_.push_back(prefix);
      return;
    }
    for (std::uint16_t v = 0; v < graph_.num_vertices(); ++v) {
      if (std::find(prefix.begin(), prefix.end(), v) != prefix.end()) continue;
      prefix.push_back(v);
      list_all(prefix);
      prefix.pop_back();
    }
  }
  void flood(std::size_t root) {
    std::vector<std::size_t> stack{root};
    class_of_[root] = representatives_.size();
    while (!stack.empty()) {
      const Configuration from = all_[stack.back()];
      stack.pop_back();
      Configuration to;
      step(from, to, stack);
    }
    representatives_.push_back(root);
  }
  /// Chooses the action of agent to.size() and of those after it in every legal way.
  void step(const Configuration& from, Configuration& to, std::vector<std::size_t>& stack) {
    const std::size_t agent = to.size();
    if (agent == num_agents_) {
      const std::size_t index = index_of(to);
      if (class_of_[index] != SIZE_MAX) return;
      class_of_[index] = representatives_.size();
      stack.push_back(index);
      return;
    }
    const auto choose = [&](std::uint16_t v) {
      for (std::size_t other = 0; other < agent; ++other)
        if (to[other] == v || (to[other] == from[agent] && from[other] == v)) return;
      to.push_back(v);
      step(from, to, stack);
      to.pop_back();
    };
    choose(from[agent]);
    for (const VertexId v : graph_.neighbours(VertexId(from[agent])))
      choose(static_cast<std::uint16_t>(v.value()));
  }

  const Graph& graph_;
  std::size_t num_agents_;
  std::vector<Configuration> all_;  // In lexicographic order.
  std::vector<std::size_t> class_of_;
  std::vector<std::size_t> representatives_;
};

// ---------------------------------------------------------------- graphs

inline bool connected(std::size_t num_vertices, const Edges& edges) {
  std::vector<std::size_t> leader(num_vertices);
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  std::size_t parts = num_vertices;
  for (const auto& [a, b] : edges) {
    const std::size_t from = leader[a], to = leader[b];
    if (from == to) continue;
    std::replace(leader.begin(), leader.end(), from, to);
    --parts;
  }
  return parts == 1;
}

/// All connected graphs with so many vertices and not more edges, one for each isomorphism class.
inline std::vector<Edges> connected_graphs(std::size_t num_vertices, int max_edges = 64) {
  Edges pairs;
  std::vector<std::vector<std::size_t>> index(num_vertices, std::vector<std::size_t>(num_vertices));
  for (std::size_t a = 0; a < num_vertices; ++a)
    for (std::size_t b = a + 1; b < num_vertices; ++b) {
      index[a][b] = index[b][a] = pairs.size();
      pairs.emplace_back(a, b);
    }
  std::vector<bool> seen(std::size_t{1} << pairs.size(), false);
  std::vector<Edges> graphs;
  for (std::size_t mask = 0; mask < seen.size(); ++mask) {
    if (seen[mask] || std::popcount(mask) > max_edges) continue;
    Edges edges;
    for (std::size_t e = 0; e < pairs.size(); ++e)
      if ((mask >> e & 1) != 0) edges.push_back(pairs[e]);
    if (!connected(num_vertices, edges)) continue;
    graphs.push_back(edges);
    std::vector<std::size_t> name(num_vertices);
    std::iota(name.begin(), name.end(), std::size_t{0});
    do {
      std::size_t image = 0;
      for (const auto& [a, b] : edges) image |= std::size_t{1} << index[name[a]][name[b]];
      seen[image] = true;
    } while (std::next_permutation(name.begin(), name.end()));
  }
  return graphs;
}

/// Hangs a new path or cycle of some vertices on a random vertex.
inline void hang(Edges& edges, std::size_t& num_vertices, std::size_t length, bool cycle,
                 Random& random) {
  const std::size_t anchor = below(random, num_vertices);
  std::size_t last = anchor;
  for (std::size_t i = 0; i < length; ++i) {
    edges.emplace_back(last, num_vertices);
    last = num_vertices++;
  }
  if (cycle && length >= 2) edges.emplace_back(last, anchor);
}

/// A random graph of paths and cycles that hang on each other, perhaps with a chord.
inline std::pair<std::size_t, Edges> random_graph(std::size_t num_vertices, Random& random) {
  std::size_t size = 1;
  Edges edges;
  const std::size_t cycles = below(random, 4);  // Of 4 pieces; 0: a tree.
  while (size < num_vertices) {
    const std::size_t length = 1 + below(random, std::min<std::size_t>(num_vertices - size, 5));
    hang(edges, size, length, below(random, 4) < cycles, random);
  }
  if (cycles > 0 && below(random, 3) == 0) {
    const std::size_t a = below(random, size), b = below(random, size);
    const auto joins = [&](const auto& e) {
      return std::minmax(e.first, e.second) == std::minmax(a, b);
    };
    if (a != b && std::none_of(edges.begin(), edges.end(), joins)) edges.emplace_back(a, b);
  }
  return {size, edges};
}

inline std::size_t num_configurations(std::size_t num_vertices, std::size_t num_agents) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < num_agents; ++i) count *= num_vertices - i;
  return count;
}

}  // namespace quadrille::discrete::feasibility_testing
