// SPDX-License-Identifier: MIT
#include "formats/roadmap_builder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

/// Requires at least one id.
std::optional<std::size_t> number_in(std::string_view id, bool has_letter, std::size_t count) {
  if (has_letter) {
    if (!id.starts_with('n')) return std::nullopt;
    id.remove_prefix(1);
  }
  const auto number = text::parse_natural(id, static_cast<std::int64_t>(count) - 1);
  // One name for each vertex: not n01.
  if (number.fault != text::NumberFault::none || (id.size() > 1 && id.front() == '0'))
    return std::nullopt;
  return static_cast<std::size_t>(number.value);
}

}  // namespace

Result<VertexId> VertexNames::find(std::string_view text, std::size_t num_vertices) const {
  const auto none = [&](const std::string& why) {
    return Error{ErrorCode::invalid_instance, why, {}};
  };
  std::optional<VertexId> found;
  const auto is_number = [](std::string_view name) {
    return text::parse_natural(name, INT64_MAX).fault == text::NumberFault::none;
  };
  // Who has numbers as ids means these.
  if (!are_ids || std::none_of(of_vertices.begin(), of_vertices.end(), is_number)) {
    const auto number = text::parse_natural(text, INT64_MAX);
    if (number.fault == text::NumberFault::none &&
        number.value < static_cast<std::int64_t>(num_vertices))
      return VertexId(static_cast<std::size_t>(number.value));
  }
  bool is_unique = true;
  const auto add = [&](VertexId vertex) {
    is_unique = is_unique && (!found || *found == vertex);
    found = vertex;
  };
  for (std::size_t v = 0; v < of_vertices.size(); ++v)
    if (!text.empty() && of_vertices[v] == text) add(VertexId(v));
  if (found && are_ids) return *found;
  for (const auto& [name, vertex] : places)
    if (name == text) add(vertex);
  if (!found) return none("there is no vertex " + text::in_quotes(text));
  if (!is_unique) return none("several vertices are called " + text::in_quotes(text));
  return *found;
}

std::optional<RoadmapBuilder::Fault> RoadmapBuilder::add_vertex(std::string id,
                                                                const std::array<double, 3>& at) {
  Point point;
  for (std::size_t axis = 0; axis < at.size(); ++axis) {
    const auto units = quantise_coordinate(at[axis], options_.resolution);
    if (!units)
      return Fault{ErrorCode::out_of_range, why_no_coordinate(at[axis], options_.resolution)};
    (axis == 0 ? point.x : axis == 1 ? point.y : point.z) = *units;
  }
  const VertexId vertex(positions_.size());
  if (!by_id_.emplace(id, vertex).second)
    return Fault{ErrorCode::invalid_instance, "another node has the id " + text::in_quotes(id)};
  positions_.push_back(point);
  ids_.push_back(std::move(id));
  return std::nullopt;
}

std::optional<VertexId> RoadmapBuilder::find(const std::string& id) const {
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) return std::nullopt;
  return found->second;
}

std::optional<RoadmapBuilder::Fault> RoadmapBuilder::add_edge(const std::string& from,
                                                              const std::string& to,
                                                              std::optional<double> speed_limit) {
  const auto source = find(from), target = find(to);
  if (!source || !target)
    return Fault{ErrorCode::invalid_instance,
                 std::string("the ") + (source ? "target " : "source ") +
                     text::in_quotes(source ? to : from) + " of an edge is no node"};
  return add_edge(*source, *target, speed_limit);
}

std::optional<RoadmapBuilder::Fault> RoadmapBuilder::add_edge(VertexId from, VertexId to,
                                                              std::optional<double> speed_limit) {
  if (from == to) return Fault{ErrorCode::invalid_instance, "an edge from a node to itself"};
  Edge edge{from, to, std::nullopt};
  // Sampling planners leave such edges in published files. Every move takes time here.
  if (positions_[from.index()] == positions_[to.index()]) {
    edge.duration = Ticks{1};
    ++num_zero_length_edges_;
  } else if (speed_limit && *speed_limit != 0) {
    const auto most = quantise_speed(*speed_limit, options_.resolution);
    if (!most) return Fault{ErrorCode::out_of_range, "the speed is not supported"};
    if (!travel_time(positions_[from.index()], positions_[to.index()],
                     std::min(*most, options_.speed)))
      return Fault{ErrorCode::out_of_range, "the edge takes too long at this speed"};
    edge.speed_limit = most;
  }
  edges_.push_back(edge);
  return std::nullopt;
}

double RoadmapBuilder::direction(VertexId from, VertexId to) const {
  const Point &a = positions_[from.index()], &b = positions_[to.index()];
  return std::atan2(static_cast<double>((b.y - a.y).value()),
                    static_cast<double>((b.x - a.x).value()));
}

void RoadmapBuilder::add_place(std::string name, VertexId vertex) {
  places_.emplace_back(std::move(name), vertex);
}

std::optional<std::vector<std::size_t>> RoadmapBuilder::numbers() const {
  if (ids_.empty()) return std::nullopt;
  const bool has_letter = ids_.front().starts_with('n');
  std::vector<std::size_t> number_of;
  std::vector<bool> is_taken(ids_.size(), false);
  for (const std::string& id : ids_) {
    const auto number = number_in(id, has_letter, ids_.size());
    if (!number || is_taken[*number]) return std::nullopt;
    is_taken[*number] = true;
    number_of.push_back(*number);
  }
  return number_of;
}

void RoadmapBuilder::renumber(const std::vector<std::size_t>& number_of) {
  std::vector<Point> positions(positions_.size());
  std::vector<std::string> ids(ids_.size());
  for (std::size_t v = 0; v < number_of.size(); ++v) {
    positions[number_of[v]] = positions_[v];
    ids[number_of[v]] = std::move(ids_[v]);
  }
  positions_ = std::move(positions);
  ids_ = std::move(ids);
  for (Edge& edge : edges_)
    for (VertexId* const end : {&edge.from, &edge.to}) *end = VertexId(number_of[end->index()]);
  for (VertexId& vertex : no_waiting_) vertex = VertexId(number_of[vertex.index()]);
  for (auto& [name, vertex] : places_) vertex = VertexId(number_of[vertex.index()]);
  const auto set = [&](VertexId& vertex) { vertex = VertexId(number_of[vertex.index()]); };
  for (HeadingRules::Lane& lane : headings_.lanes)
    for (VertexId* const end : {&lane.from, &lane.to}) set(*end);
  for (HeadingRules::Heading& told : headings_.stands) set(told.place);
  for (HeadingRules::Turns& told : headings_.turns) set(told.place);
}

Result<MapFile> RoadmapBuilder::finish(const std::string& file) && {
  const auto number_of = numbers();
  if (number_of) renumber(*number_of);
  auto roadmap =
      Roadmap::make(std::move(positions_), std::move(edges_), {}, {}, std::move(no_waiting_));
  if (!roadmap) return Error{roadmap.error().code, roadmap.error().message, {file, 0}};
  for (const auto& [what, count] : not_used_)
    notes_.push_back(what + " is not used (" + std::to_string(count) +
                     (count == 1 ? " time)" : " times)"));
  return MapFile{std::move(roadmap).value(), num_zero_length_edges_,
                 VertexNames{std::move(ids_), !number_of, std::move(places_)}, std::move(notes_),
                 std::move(headings_)};
}

}  // namespace quadrille::continuous
