// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// A cell of a grid: x = column, y = row, (0, 0) upper left.
struct Cell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend auto operator<=>(const Cell&, const Cell&) = default;
};

/// Where the vertices of a grid graph lie. Vertices are the passable cells in row-major order.
class GridLayout {
 public:
  GridLayout() = default;
  /// `passable` has width * height entries, row by row.
  GridLayout(std::int32_t width, std::int32_t height, const std::vector<bool>& passable);

  [[nodiscard]] std::int32_t width() const noexcept { return width_; }
  [[nodiscard]] std::int32_t height() const noexcept { return height_; }
  [[nodiscard]] bool contains(Cell cell) const noexcept {
    return cell.x >= 0 && cell.x < width_ && cell.y >= 0 && cell.y < height_;
  }
  /// The vertex of a cell; nullopt if the cell is blocked or outside.
  [[nodiscard]] std::optional<VertexId> vertex_at(Cell cell) const noexcept;
  /// Requires a vertex of this grid.
  [[nodiscard]] Cell cell_of(VertexId vertex) const;
  [[nodiscard]] std::size_t num_vertices() const noexcept { return cells_.size(); }

 private:
  std::int32_t width_ = 0, height_ = 0;
  std::vector<std::int32_t> vertex_of_cell_;  // -1: blocked
  IdVector<VertexId, Cell> cells_;
};

/// A simple graph, and the grid it came from if it is one. Edges lead both ways unless something
/// else is said. Immutable.
class Graph {
 public:
  using Edge = std::pair<VertexId, VertexId>;

  /// The graph with vertices 0 .. num_vertices-1. Errors (invalid_instance): an end point out of
  /// range, a loop, an edge given twice (in either direction). O(V + E log E).
  [[nodiscard]] static Result<Graph> make(std::size_t num_vertices, const std::vector<Edge>& edges);
  /// The 4-connected graph of the passable cells. Requires passable.size() == width * height.
  [[nodiscard]] static Graph grid(std::int32_t width, std::int32_t height,
                                  const std::vector<bool>& passable);

  /// The same with arcs, each of which leads from its first vertex to its second. Errors
  /// (invalid_instance): an end point out of range, a loop, an arc given twice. O(V + E log E).
  [[nodiscard]] static Result<Graph> make_directed(std::size_t num_vertices,
                                                   const std::vector<Edge>& arcs);
  /// The same graph, but these edges lead only from their first vertex to their second. Errors
  /// (invalid_instance): no such edge, or one named in both directions. O(V + E log E).
  [[nodiscard]] Result<Graph> with_one_way(const std::vector<Edge>& arcs) const;
  /// The same graph with all edges leading both ways.
  [[nodiscard]] Graph undirected() const;

  [[nodiscard]] std::size_t num_vertices() const noexcept { return offsets_.size() - 1; }
  /// Of a directed graph: arcs.
  [[nodiscard]] std::size_t num_edges() const noexcept {
    return is_directed() ? neighbours_.size() : neighbours_.size() / 2;
  }
  /// Some edge leads one way only.
  [[nodiscard]] bool is_directed() const noexcept { return !reverse_.offsets.empty(); }
  /// Where one can go from here, in increasing order. Valid as long as the graph lives.
  [[nodiscard]] std::span<const VertexId> neighbours(VertexId vertex) const {
    return std::span(neighbours_)
        .subspan(offsets_[vertex.index()], offsets_[vertex.index() + 1] - offsets_[vertex.index()]);
  }
  /// From where one can come here; likewise.
  [[nodiscard]] std::span<const VertexId> predecessors(VertexId vertex) const {
    if (!is_directed()) return neighbours(vertex);
    const auto& offsets = reverse_.offsets;
    return std::span(reverse_.neighbours)
        .subspan(offsets[vertex.index()], offsets[vertex.index() + 1] - offsets[vertex.index()]);
  }
  /// An edge leads from `a` to `b`. O(log degree).
  [[nodiscard]] bool adjacent(VertexId a, VertexId b) const;
  [[nodiscard]] const std::optional<GridLayout>& layout() const noexcept { return layout_; }

 private:
  Graph() = default;
  /// Of these arcs, which are sorted and different.
  Graph(std::size_t num_vertices, const std::vector<Edge>& arcs);
  [[nodiscard]] std::vector<Edge> arcs() const;

  std::vector<std::size_t> offsets_;  // CSR, num_vertices + 1 entries
  std::vector<VertexId> neighbours_;
  struct Reverse {
    std::vector<std::size_t> offsets;
    std::vector<VertexId> neighbours;
  } reverse_;  // Empty: the graph is undirected.
  std::optional<GridLayout> layout_;
};

/// Distance that no vertex has: the vertex is not reachable.
inline constexpr Timestep kUnreachable = INT32_MAX;

/// Number of moves from `source` to every vertex, kUnreachable where there is no way. O(V + E).
[[nodiscard]] IdVector<VertexId, Timestep> distances_from(const Graph& graph, VertexId source);
/// The same from every vertex to the nearest of these. O(V + E).
[[nodiscard]] IdVector<VertexId, Timestep> distances_to_nearest(const Graph& graph,
                                                                const Goals& goals);

/// "(x, y)" on grids, the vertex number on other graphs. For messages.
[[nodiscard]] std::string vertex_name(const Graph& graph, VertexId vertex);

}  // namespace quadrille::discrete

QUADRILLE_API_END
