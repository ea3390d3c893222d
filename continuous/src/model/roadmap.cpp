// SPDX-License-Identifier: MIT
#include "quadrille/continuous/roadmap.hpp"

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
  if (edge.duration && (*edge.duration < 1 || *edge.duration > geometry::kMaxDuration))
    return Error{ErrorCode::out_of_range,
                 name + " takes " + std::to_string(edge.duration->count()) + " ticks, not 1 .. " +
                     std::to_string(geometry::kMaxDuration.count()),
                 {}};
  return std::nullopt;
}

}  // namespace

Result<Roadmap> Roadmap::make(std::vector<Point> vertices, std::vector<Edge> edges) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!geometry::in_range(vertices[v]))
      return Error{ErrorCode::out_of_range,
                   "vertex " + std::to_string(v) + " is farther than " +
                       std::to_string(geometry::kMaxLength.count()) +
                       " length units from the origin",
                   {}};
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (auto error = check(vertices, edges[e], e)) return *error;
  return Roadmap(std::move(vertices), std::move(edges));
}

Roadmap::Roadmap(std::vector<Point> positions, std::vector<Edge> edges)
    : positions_(std::move(positions)),
      edges_(std::move(edges)),
      out_(incidence(&Edge::from)),
      in_(incidence(&Edge::to)) {}

Roadmap::Incidence Roadmap::incidence(VertexId Edge::*end) const {
  Incidence result{std::vector<std::size_t>(positions_.size() + 1, 0),
                   std::vector<EdgeId>(edges_.size())};
  for (const Edge& edge : edges_) ++result.begin[(edge.*end).index() + 1];
  for (std::size_t v = 0; v < positions_.size(); ++v) result.begin[v + 1] += result.begin[v];
  std::vector<std::size_t> next = result.begin;
  for (std::size_t e = 0; e < edges_.size(); ++e)
    result.edges[next[(edges_[e].*end).index()]++] = EdgeId(e);
  return result;
}

}  // namespace quadrille::continuous
