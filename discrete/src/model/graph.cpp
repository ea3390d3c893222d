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

namespace {

using Edge = Graph::Edge;

std::string name_of(Edge e) {
  return std::to_string(e.first.value()) + "-" + std::to_string(e.second.value());
}

Error invalid(const std::string& what, Edge edge, const std::string& why) {
  return {ErrorCode::invalid_instance, what + " " + name_of(edge) + " " + why, {}};
}

std::optional<Error> find_bad_edge(std::size_t num_vertices, const std::vector<Edge>& edges) {
  for (const Edge& edge : edges) {
    if (edge.first.index() >= num_vertices || edge.second.index() >= num_vertices)
      return invalid(
          "edge", edge,
          "names a vertex that is not among the " + std::to_string(num_vertices) + " vertices");
    if (edge.first == edge.second) return invalid("edge", edge, "is a loop");
  }
  return std::nullopt;
}

/// The same arcs the other way round, sorted.
std::vector<Edge> reversed(std::vector<Edge> arcs) {
  for (Edge& arc : arcs) std::swap(arc.first, arc.second);
  std::sort(arcs.begin(), arcs.end());
  return arcs;
}

/// In compressed rows.
void fill_rows(std::size_t num_vertices, const std::vector<Edge>& arcs,
               std::vector<std::size_t>& offsets, std::vector<VertexId>& neighbours) {
  offsets.assign(num_vertices + 1, 0);
  for (const Edge& arc : arcs) ++offsets[arc.first.index() + 1];
  for (std::size_t v = 0; v < num_vertices; ++v) offsets[v + 1] += offsets[v];
  neighbours.reserve(arcs.size());
  for (const Edge& arc : arcs) neighbours.push_back(arc.second);
}

}  // namespace

Graph::Graph(std::size_t num_vertices, const std::vector<Edge>& arcs) {
  fill_rows(num_vertices, arcs, offsets_, neighbours_);
  const std::vector<Edge> back = reversed(arcs);
  if (back != arcs) fill_rows(num_vertices, back, reverse_.offsets, reverse_.neighbours);
}

Result<Graph> Graph::make(std::size_t num_vertices, const std::vector<Edge>& edges) {
  if (auto error = find_bad_edge(num_vertices, edges)) return *error;
  std::vector<Edge> arcs;
  arcs.reserve(2 * edges.size());
  for (const Edge& edge : edges) {
    arcs.push_back(edge);
    arcs.emplace_back(edge.second, edge.first);
  }
  std::sort(arcs.begin(), arcs.end());
  const auto twice = std::adjacent_find(arcs.begin(), arcs.end());
  if (twice != arcs.end()) return invalid("edge", *twice, "is given twice");
  return Graph(num_vertices, arcs);
}

Result<Graph> Graph::make_directed(std::size_t num_vertices, const std::vector<Edge>& edges) {
  if (auto error = find_bad_edge(num_vertices, edges)) return *error;
  std::vector<Edge> arcs = edges;
  std::sort(arcs.begin(), arcs.end());
  const auto twice = std::adjacent_find(arcs.begin(), arcs.end());
  if (twice != arcs.end()) return invalid("edge", *twice, "is given twice");
  return Graph(num_vertices, arcs);
}

std::vector<Graph::Edge> Graph::arcs() const {
  std::vector<Edge> arcs;
  arcs.reserve(neighbours_.size());
  for (const VertexId v : IdRange<VertexId>(num_vertices()))
    for (const VertexId w : neighbours(v)) arcs.emplace_back(v, w);
  return arcs;
}

Result<Graph> Graph::with_one_way(const std::vector<Edge>& arcs) const {
  if (auto error = find_bad_edge(num_vertices(), arcs)) return *error;
  const std::vector<Edge> closed = reversed(arcs);
  for (const Edge& arc : arcs) {
    if (!adjacent(arc.first, arc.second)) return invalid("edge", arc, "does not exist");
    if (std::binary_search(closed.begin(), closed.end(), arc))
      return invalid("edge", arc, "is one-way in both directions");
  }
  std::vector<Edge> open = this->arcs();
  std::erase_if(
      open, [&](const Edge& arc) { return std::binary_search(closed.begin(), closed.end(), arc); });
  Graph graph(num_vertices(), open);
  graph.layout_ = layout_;
  return graph;
}

Graph Graph::undirected() const {
  std::vector<Edge> both = arcs();
  const std::vector<Edge> back = reversed(both);
  both.insert(both.end(), back.begin(), back.end());
  std::sort(both.begin(), both.end());
  both.erase(std::unique(both.begin(), both.end()), both.end());
  Graph graph(num_vertices(), both);
  graph.layout_ = layout_;
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

namespace {

/// From the nearest of the sources, along `next(v)`.
template <class Next>
IdVector<VertexId, Timestep> spread(const Graph& graph, std::span<const VertexId> sources,
                                    const Next& next) {
  IdVector<VertexId, Timestep> distance(graph.num_vertices(), kUnreachable);
  std::vector<VertexId> queue;
  queue.reserve(graph.num_vertices());
  for (const VertexId source : sources) {
    queue.push_back(source);
    distance[source] = 0;
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const VertexId v = queue[head];
    for (const VertexId w : next(v))
      if (distance[w] == kUnreachable) {
        distance[w] = distance[v] + 1;
        queue.push_back(w);
      }
  }
  return distance;
}

}  // namespace

IdVector<VertexId, Timestep> distances_from(const Graph& graph, VertexId source) {
  return spread(graph, std::span(&source, 1), [&](VertexId v) { return graph.neighbours(v); });
}

IdVector<VertexId, Timestep> distances_to_nearest(const Graph& graph, const Goals& goals) {
  return spread(graph, goals.vertices(), [&](VertexId v) { return graph.predecessors(v); });
}

std::string vertex_name(const Graph& graph, VertexId vertex) {
  if (!graph.layout()) return std::to_string(vertex.value());
  const Cell cell = graph.layout()->cell_of(vertex);
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ")";
}

}  // namespace quadrille::discrete
