// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/graph.hpp"

namespace quadrille::discrete {

/// Breadth-first searches on one graph, many of them, against the direction of one-way edges. Where
/// no vertex has more than four neighbours, as on grids, they go without branches through a copy of
/// the graph.
class BreadthFirst {
 public:
  /// `graph` outlives the object. O(V + E).
  explicit BreadthFirst(const Graph& graph);

  /// From all vertices to the nearest of some, which are different. False if a limit was met. O(V +
  /// E).
  bool run(std::span<const VertexId> sources, LimitMonitor* limits = nullptr);
  bool run(VertexId source, LimitMonitor* limits = nullptr) {
    return run(std::span<const VertexId>(&source, 1), limits);
  }
  /// Only to those that are at most `moves` away. O(number of these), from the second call on.
  void run_within(VertexId source, Timestep moves);

  /// By vertex, kUnreachable where the last search did not come; and one entry more, without
  /// meaning.
  [[nodiscard]] const std::vector<Timestep>& distances() const noexcept { return distances_; }
  /// The vertices where the last search came, nearest first. Valid until the next one.
  [[nodiscard]] std::span<const std::uint32_t> order() const {
    return std::span(queue_).first(num_reached_);
  }

 private:
  void begin(std::span<const VertexId> sources);
  template <class Neighbours>
  bool spread(Timestep most, LimitMonitor* limits, const Neighbours& neighbours);

  const Graph& graph_;
  std::vector<std::array<std::uint32_t, 4>> near_;  // Filled up with V. Empty: too many neighbours.
  std::vector<Timestep> distances_;
  std::vector<std::uint32_t> queue_;
  std::size_t num_reached_ = 0;
};

}  // namespace quadrille::discrete
