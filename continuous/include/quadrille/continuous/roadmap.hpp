// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

using geometry::Length;  ///< Whole length units.
using geometry::Point;
using geometry::Ticks;  ///< Whole ticks.
using EdgeId = StrongId<struct EdgeTag>;

/// A straight move from one vertex to another.
struct Edge {
  VertexId from;
  VertexId to;
  /// How long the move takes, whoever makes it; absent: its length at the speed of the agent.
  std::optional<Ticks> duration;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// Vertices in the plane and directed edges. Immutable.
class Roadmap {
 public:
  /// Errors: out_of_range for coordinates beyond geometry::kMaxLength or durations outside
  /// [1, geometry::kMaxDuration]; invalid_instance for an edge with an end that does not exist,
  /// from a vertex to itself, or of length zero without a duration. Vertices and edges are named by
  /// their index. Parallel edges are allowed, and several vertices in the same place.
  [[nodiscard]] static Result<Roadmap> make(std::vector<Point> vertices, std::vector<Edge> edges);

  [[nodiscard]] std::size_t num_vertices() const noexcept { return positions_.size(); }
  [[nodiscard]] std::size_t num_edges() const noexcept { return edges_.size(); }
  [[nodiscard]] const Point& position(VertexId v) const { return positions_[v.index()]; }
  [[nodiscard]] const Edge& edge(EdgeId e) const { return edges_[e.index()]; }
  /// By edge id.
  [[nodiscard]] std::span<const EdgeId> out_edges(VertexId v) const { return out_.of(v); }
  [[nodiscard]] std::span<const EdgeId> in_edges(VertexId v) const { return in_.of(v); }

  [[nodiscard]] const std::vector<Point>& positions() const noexcept { return positions_; }
  [[nodiscard]] const std::vector<Edge>& edges() const noexcept { return edges_; }

 private:
  /// The edges at each vertex, one after the other.
  struct Incidence {
    std::vector<std::size_t> begin;
    std::vector<EdgeId> edges;
    [[nodiscard]] std::span<const EdgeId> of(VertexId v) const {
      return {edges.data() + begin[v.index()], edges.data() + begin[v.index() + 1]};
    }
  };
  Roadmap(std::vector<Point> positions, std::vector<Edge> edges);
  [[nodiscard]] Incidence incidence(VertexId Edge::*end) const;

  std::vector<Point> positions_;
  std::vector<Edge> edges_;
  Incidence out_, in_;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
