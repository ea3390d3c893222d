// SPDX-License-Identifier: MIT
#include "quadrille/continuous/roadmap.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace quadrille::continuous {
namespace {

std::optional<Error> check(const std::vector<Point>& positions, const Edge& edge,
                           std::size_t index) {
  const std::string name = "edge " + std::to_string(index);
  for (const VertexId end : {edge.from, edge.to})
    if (end.index() >= positions.size())
      return Error{ErrorCode::invalid_instance,
                   name + " ends at vertex " + std::to_string(end.index()) + ", but there are " +
                       std::to_string(positions.size()) + " vertices",
                   {}};
  if (edge.from == edge.to ||
      (positions[edge.from.index()] == positions[edge.to.index()] && !edge.duration))
    return Error{ErrorCode::invalid_instance,
                 name + " from vertex " + std::to_string(edge.from.index()) + " to vertex " +
                     std::to_string(edge.to.index()) + " has length zero",
                 {}};
  if (edge.open_to.is_empty())
    return Error{ErrorCode::invalid_instance, name + " is open to no group", {}};
  if (edge.duration && (*edge.duration < 1 || *edge.duration > geometry::kMaxDuration))
    return Error{ErrorCode::out_of_range,
                 name + " takes " + std::to_string(edge.duration->value()) + " ticks, not 1 .. " +
                     std::to_string(geometry::kMaxDuration.value()),
                 {}};
  return std::nullopt;
}

}  // namespace

Result<Roadmap> Roadmap::make(std::vector<Point> vertices, std::vector<Edge> edges) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!geometry::in_range(vertices[v]))
      return Error{ErrorCode::out_of_range,
                   "vertex " + std::to_string(v) + " is farther than " +
                       std::to_string(geometry::kMaxLength.value()) +
                       " length units from the origin",
                   {}};
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (auto error = check(vertices, edges[e], e)) return *error;
  return Roadmap(std::move(vertices), std::move(edges));
}

Roadmap Roadmap::with_closed(std::span<const EdgeId> closed) const {
  std::vector<Edge> edges = edges_;
  for (const EdgeId e : closed) {
    QUADRILLE_REQUIRE(e.index() < edges.size(), "an edge of the roadmap");
    edges[e.index()].open_to = Groups();
  }
  return Roadmap(positions_, std::move(edges));
}

Roadmap::Roadmap(std::vector<Point> positions, std::vector<Edge> edges)
    : positions_(std::move(positions)),
      edges_(std::move(edges)),
      is_flat_(std::all_of(positions_.begin(), positions_.end(),
                           [](const Point& point) { return point.z == 0; })),
      out_(positions_.size(), edges_, &Edge::from, std::nullopt),
      in_(positions_.size(), edges_, &Edge::to, std::nullopt) {}

EdgeLists::EdgeLists(std::size_t num_vertices, const std::vector<Edge>& edges, VertexId Edge::*end,
                     const std::optional<GroupId>& group)
    : begin_(num_vertices + 1, 0) {
  const auto is_open = [&](const Edge& edge) { return !group || edge.open_to.contains(*group); };
  for (const Edge& edge : edges)
    if (is_open(edge)) ++begin_[(edge.*end).index() + 1];
  for (std::size_t v = 0; v < num_vertices; ++v) begin_[v + 1] += begin_[v];
  edges_.resize(begin_.back());
  std::vector<std::size_t> next = begin_;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (is_open(edges[e])) edges_[next[(edges[e].*end).index()]++] = EdgeId(e);
}

}  // namespace quadrille::continuous
