// SPDX-License-Identifier: MIT
#include "quadrille/continuous/roadmap.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "quadrille/continuous/under_way.hpp"

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

/// With all vertices and edges in order.
std::optional<Error> check(const std::vector<Point>& positions, const std::vector<Edge>& edges,
                           const LanePlace& place) {
  const std::string name = "vertex " + std::to_string(place.vertex.index());
  const auto refuse = [&](const std::string& why) {
    return Error{ErrorCode::invalid_instance, name + " is in the middle of a move, but " + why, {}};
  };
  for (const VertexId v : {place.vertex, place.from, place.to})
    if (v.index() >= positions.size())
      return refuse("there is no vertex " + std::to_string(v.index()));
  if (place.from == place.vertex || place.to == place.vertex || place.from == place.to)
    return refuse("that is not one between two other vertices");
  if (place.behind < 0 || place.behind >= place.whole || place.whole > geometry::kMaxDuration)
    return refuse(std::to_string(place.behind.value()) + " of " +
                  std::to_string(place.whole.value()) + " ticks lie behind it");
  std::size_t num_out = 0;
  for (const Edge& edge : edges) {
    if (edge.to == place.vertex) return refuse("an edge leads to it");
    if (edge.from != place.vertex) continue;
    ++num_out;
    if (edge.to != place.to || edge.duration != place.whole - place.behind)
      return refuse("the edge from it is not the rest of the move");
  }
  if (num_out != 1) return refuse("there is not one edge that leads on");
  if (positions[place.vertex.index()] != nearest_point(positions[place.from.index()],
                                                       positions[place.to.index()], place.behind,
                                                       place.whole))
    return refuse("its coordinates are not those of that place");
  return std::nullopt;
}

}  // namespace

Result<Roadmap> Roadmap::make(std::vector<Point> vertices, std::vector<Edge> edges,
                              std::vector<LanePlace> lane_places) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!geometry::in_range(vertices[v]))
      return Error{ErrorCode::out_of_range,
                   "vertex " + std::to_string(v) + " is farther than " +
                       std::to_string(geometry::kMaxLength.value()) +
                       " length units from the origin",
                   {}};
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (auto error = check(vertices, edges[e], e)) return *error;
  std::sort(lane_places.begin(), lane_places.end(),
            [](const LanePlace& a, const LanePlace& b) { return a.vertex < b.vertex; });
  for (std::size_t k = 0; k < lane_places.size(); ++k) {
    const VertexId v = lane_places[k].vertex;
    if (auto error = check(vertices, edges, lane_places[k])) return *error;
    const bool is_told_twice = k > 0 && lane_places[k - 1].vertex == v;
    const auto is_an_end = [&](const LanePlace& other) { return other.from == v || other.to == v; };
    if (is_told_twice || std::any_of(lane_places.begin(), lane_places.end(), is_an_end))
      return Error{ErrorCode::invalid_instance,
                   "vertex " + std::to_string(v.index()) + " is in the middle of " +
                       (is_told_twice ? "two moves" : "a move, and another one has it as an end"),
                   {}};
  }
  return Roadmap(std::move(vertices), std::move(edges), std::move(lane_places));
}

Roadmap Roadmap::with_closed(std::span<const EdgeId> closed) const {
  std::vector<Edge> edges = edges_;
  for (const EdgeId e : closed) {
    QUADRILLE_REQUIRE(e.index() < edges.size(), "an edge of the roadmap");
    edges[e.index()].open_to = Groups();
  }
  return Roadmap(positions_, std::move(edges), lane_places_);
}

geometry::Motion Roadmap::motion(VertexId from, VertexId to, Ticks duration) const {
  const geometry::Place place = this->place(from);
  const Point& end = position(to);
  // A turn is a move on the spot, a part of it too.
  if (place.from == place.to || place.behind == 0) return {place.from, end, duration};
  return {place.from, end, duration, place.behind};
}

const LanePlace* Roadmap::lane_place(VertexId v) const {
  if (lane_places_.empty()) return nullptr;
  const auto at = std::lower_bound(lane_places_.begin(), lane_places_.end(), v,
                                   [](const LanePlace& p, VertexId w) { return p.vertex < w; });
  return at != lane_places_.end() && at->vertex == v ? &*at : nullptr;
}

Roadmap::Roadmap(std::vector<Point> positions, std::vector<Edge> edges,
                 std::vector<LanePlace> lane_places)
    : positions_(std::move(positions)),
      edges_(std::move(edges)),
      lane_places_(std::move(lane_places)),
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
