// SPDX-License-Identifier: MIT
#include "quadrille/discrete/graph.hpp"

#include <algorithm>

namespace quadrille::discrete {

GridLayout::GridLayout(std::int32_t width, std::int32_t height, const std::vector<bool>& passable)
    : width_(width), height_(height) {
  QUADRILLE_REQUIRE(width >= 0 && height >= 0, "a grid has a size");
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  QUADRILLE_REQUIRE(passable.size() == columns * rows, "one entry per cell");
  vertex_of_cell_.assign(passable.size(), -1);
  for (std::int32_t y = 0; y < height; ++y)
    for (std::int32_t x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
      if (!passable[at]) continue;
      vertex_of_cell_[at] = static_cast<std::int32_t>(cells_.size());
      cells_.push_back({x, y});
    }
}

std::optional<VertexId> GridLayout::vertex_at(Cell cell) const noexcept {
  if (!contains(cell)) return std::nullopt;
  const auto at = static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(cell.x);
  if (vertex_of_cell_[at] < 0) return std::nullopt;
  return VertexId(static_cast<std::size_t>(vertex_of_cell_[at]));
}

Cell GridLayout::cell_of(VertexId vertex) const {
  QUADRILLE_REQUIRE(vertex.index() < cells_.size(), "a vertex of this grid");
  return cells_[vertex];
}

Result<Graph> Graph::make(std::size_t num_vertices, const std::vector<Edge>& edges) {
  const auto name = [](Edge e) {
    return std::to_string(e.first.value()) + "-" + std::to_string(e.second.value());
  };
  std::vector<Edge> arcs;
  arcs.reserve(2 * edges.size());
  for (const Edge& edge : edges) {
    if (edge.first.index() >= num_vertices || edge.second.index() >= num_vertices)
      return Error{ErrorCode::invalid_instance,
                   "edge " + name(edge) + " names a vertex that is not among the " +
                       std::to_string(num_vertices) + " vertices",
                   {}};
    if (edge.first == edge.second)
      return Error{ErrorCode::invalid_instance, "edge " + name(edge) + " is a loop", {}};
    arcs.push_back(edge);
    arcs.emplace_back(edge.second, edge.first);
  }
  std::sort(arcs.begin(), arcs.end());
  const auto twice = std::adjacent_find(arcs.begin(), arcs.end());
  if (twice != arcs.end())
    return Error{ErrorCode::invalid_instance, "edge " + name(*twice) + " is given twice", {}};

  Graph graph;
  graph.offsets_.assign(num_vertices + 1, 0);
  for (const Edge& arc : arcs) ++graph.offsets_[arc.first.index() + 1];
  for (std::size_t v = 0; v < num_vertices; ++v) graph.offsets_[v + 1] += graph.offsets_[v];
  graph.neighbours_.reserve(arcs.size());
  for (const Edge& arc : arcs) graph.neighbours_.push_back(arc.second);
  return graph;
}

Graph Graph::grid(std::int32_t width, std::int32_t height, const std::vector<bool>& passable) {
  GridLayout layout(width, height, passable);
  Graph graph;
  graph.offsets_.assign(1, 0);
  for (const VertexId v : IdRange<VertexId>(layout.num_vertices())) {
    const Cell c = layout.cell_of(v);
    // In row-major order these are increasing vertex ids.
    for (const Cell next :
         {Cell{c.x, c.y - 1}, Cell{c.x - 1, c.y}, Cell{c.x + 1, c.y}, Cell{c.x, c.y + 1}})
      if (const auto w = layout.vertex_at(next)) graph.neighbours_.push_back(*w);
    graph.offsets_.push_back(graph.neighbours_.size());
  }
  graph.layout_ = std::move(layout);
  return graph;
}

bool Graph::adjacent(VertexId a, VertexId b) const {
  const auto near = neighbours(a);
  return std::binary_search(near.begin(), near.end(), b);
}

IdVector<VertexId, Timestep> distances_from(const Graph& graph, VertexId source) {
  return distances_to_nearest(graph, source);
}

IdVector<VertexId, Timestep> distances_to_nearest(const Graph& graph, const Goals& goals) {
  IdVector<VertexId, Timestep> distance(graph.num_vertices(), kUnreachable);
  std::vector<VertexId> queue;
  queue.reserve(graph.num_vertices());
  for (const VertexId goal : goals.vertices()) {
    queue.push_back(goal);
    distance[goal] = 0;
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const VertexId v = queue[head];
    for (const VertexId w : graph.neighbours(v))
      if (distance[w] == kUnreachable) {
        distance[w] = distance[v] + 1;
        queue.push_back(w);
      }
  }
  return distance;
}

std::string vertex_name(const Graph& graph, VertexId vertex) {
  if (!graph.layout()) return std::to_string(vertex.value());
  const Cell cell = graph.layout()->cell_of(vertex);
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ")";
}

}  // namespace quadrille::discrete
