// SPDX-License-Identifier: MIT
#include "quadrille/continuous/roadmap.hpp"

#include <algorithm>
#include <map>
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
  if (edge.speed_limit && edge.duration)
    return Error{ErrorCode::invalid_instance, name + " has a duration and a speed limit", {}};
  if (edge.speed_limit && (*edge.speed_limit < 1 || *edge.speed_limit > kMaxSpeed))
    return Error{ErrorCode::out_of_range, name + " has a speed limit that is not supported", {}};
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

/// With all vertices and edges in order.
std::optional<Error> check_shapes(std::size_t num_vertices, const std::vector<Edge>& edges,
                                  const std::vector<LanePlace>& lane_places,
                                  const std::vector<ShapeId>& shapes) {
  const auto refuse = [](const std::string& why) {
    return Error{ErrorCode::invalid_instance, why, {}};
  };
  if (!shapes.empty() && shapes.size() != num_vertices)
    return refuse("there are " + std::to_string(shapes.size()) + " shapes for " +
                  std::to_string(num_vertices) + " vertices");
  const auto is_plain = [](const Edge& edge) { return edge.shape == ShapeId(); };
  if (shapes.empty() && std::all_of(edges.begin(), edges.end(), is_plain)) return std::nullopt;
  for (std::size_t v = 0; v < shapes.size(); ++v)
    if (shapes[v].index() > kMaxShapes)
      return Error{
          ErrorCode::out_of_range,
          "vertex " + std::to_string(v) + " has a shape above " + std::to_string(kMaxShapes),
          {}};
  std::map<std::pair<VertexId, VertexId>, ShapeId> known;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    if (edge.shape.index() > kMaxShapes)
      return Error{ErrorCode::out_of_range,
                   "edge " + std::to_string(e) + " has a shape above " + std::to_string(kMaxShapes),
                   {}};
    if (known.try_emplace({edge.from, edge.to}, edge.shape).first->second != edge.shape)
      return refuse("edge " + std::to_string(e) + " has another shape than one before it between " +
                    "the same vertices");
    const auto starts = [&](const LanePlace& place) { return place.vertex == edge.from; };
    const ShapeId there = shapes.empty() ? ShapeId() : shapes[edge.from.index()];
    if (there != edge.shape && std::any_of(lane_places.begin(), lane_places.end(), starts))
      return refuse("vertex " + std::to_string(edge.from.index()) +
                    " is in the middle of a move, but has not the shape of the rest of it");
  }
  return std::nullopt;
}

/// With all vertices and places in order, and sorted.
std::optional<Error> check_no_waiting(std::size_t num_vertices,
                                      const std::vector<LanePlace>& lane_places,
                                      const std::vector<VertexId>& no_waiting) {
  const auto refuse = [](VertexId v, const std::string& why) {
    return Error{ErrorCode::invalid_instance,
                 "nobody may wait at vertex " + std::to_string(v.index()) + ", but " + why,
                 {}};
  };
  for (std::size_t k = 0; k < no_waiting.size(); ++k) {
    const VertexId v = no_waiting[k];
    if (v.index() >= num_vertices)
      return refuse(v, "there are " + std::to_string(num_vertices) + " vertices");
    if (k > 0 && no_waiting[k - 1] == v) return refuse(v, "that is told twice");
    const auto is_there = [&](const LanePlace& place) { return place.vertex == v; };
    if (std::any_of(lane_places.begin(), lane_places.end(), is_there))
      return refuse(v, "it is in the middle of a move");
  }
  return std::nullopt;
}

}  // namespace

Result<Roadmap> Roadmap::make(std::vector<Point> vertices, std::vector<Edge> edges,
                              std::vector<LanePlace> lane_places, std::vector<ShapeId> shapes,
                              std::vector<VertexId> no_waiting) {
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
  if (auto error = check_shapes(vertices.size(), edges, lane_places, shapes)) return *error;
  std::sort(no_waiting.begin(), no_waiting.end());
  if (auto error = check_no_waiting(vertices.size(), lane_places, no_waiting)) return *error;
  return Roadmap(std::move(vertices), std::move(edges), std::move(lane_places), std::move(shapes),
                 std::move(no_waiting));
}

ShapeId Roadmap::shape(VertexId from, VertexId to) const {
  if (num_shapes_ == 1) return {};
  for (const EdgeId e : out_edges(from))
    if (edge(e).to == to) return edge(e).shape;
  QUADRILLE_REQUIRE(false, "an edge between the two");
  return {};
}

Roadmap Roadmap::with_closed(std::span<const EdgeId> closed) const {
  std::vector<Edge> edges = edges_;
  for (const EdgeId e : closed) {
    QUADRILLE_REQUIRE(e.index() < edges.size(), "an edge of the roadmap");
    edges[e.index()].open_to = Groups();
  }
  return Roadmap(positions_, std::move(edges), lane_places_, shapes_, no_waiting_);
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
                 std::vector<LanePlace> lane_places, std::vector<ShapeId> shapes,
                 std::vector<VertexId> no_waiting)
    : positions_(std::move(positions)),
      edges_(std::move(edges)),
      lane_places_(std::move(lane_places)),
      shapes_(std::move(shapes)),
      no_waiting_(std::move(no_waiting)),
      is_flat_(std::all_of(positions_.begin(), positions_.end(),
                           [](const Point& point) { return point.z == 0; })),
      out_(positions_.size(), edges_, &Edge::from, std::nullopt),
      in_(positions_.size(), edges_, &Edge::to, std::nullopt) {
  ends_.reserve(edges_.size());
  for (const Edge& edge : edges_) ends_.push_back({edge.from, edge.to});
  if (!no_waiting_.empty()) is_no_waiting_.assign(positions_.size(), 0);
  for (const VertexId v : no_waiting_) is_no_waiting_[v.index()] = 1;
  for (const ShapeId shape : shapes_) num_shapes_ = std::max(num_shapes_, shape.index() + 1);
  for (const Edge& edge : edges_) num_shapes_ = std::max(num_shapes_, edge.shape.index() + 1);
}

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
