// SPDX-License-Identifier: MIT
#include <ostream>
#include <string>

#include "formats/json_bodies.hpp"
#include "formats/json_numbers.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/text/goals.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

std::string edge_json(const Edge& edge, const Resolution& resolution) {
  const std::string from = std::to_string(edge.from.index()), to = std::to_string(edge.to.index());
  const std::string duration =
      edge.duration ? json_number(in_input_units(*edge.duration, resolution)) : "";
  if (edge.open_to == Groups::all() && edge.shape == ShapeId() && !edge.speed_limit)
    return "[" + from + ", " + to + (edge.duration ? ", " + duration : "") + "]";
  std::string text = "{\"from\": " + from + ", \"to\": " + to;
  if (edge.duration) text += ", \"duration\": " + duration;
  if (edge.speed_limit)
    text +=
        ", \"speed_limit\": " + json_number(speed_in_input_units(*edge.speed_limit, resolution));
  if (edge.shape != ShapeId()) text += ", \"shape\": " + std::to_string(edge.shape.index());
  if (edge.open_to == Groups::all()) return text + "}";
  const char* separator = ", \"groups\": [";
  for (std::size_t g = 0; g < kMaxGroups; ++g) {
    if (!edge.open_to.contains(GroupId(g))) continue;
    text += separator + std::to_string(g);
    separator = ", ";
  }
  return text + "]}";
}

/// The member of an instance, if there are any.
std::string obstacles_json(const Instance& instance) {
  if (instance.obstacles().empty()) return "";
  const auto number = [&](auto units) {
    return json_number(in_input_units(units, instance.resolution()));
  };
  std::string text = ",\n  \"obstacles\": [";
  const char* separator = "\n    {";
  for (const MovingObstacle& obstacle : instance.obstacles()) {
    text += separator + body_json(obstacle.body, instance.resolution());
    if (obstacle.leaves) text += ", \"at_end\": \"leave\"";
    const char* between = ", \"path\": [";
    for (const MovingObstacle::Stop& stop : obstacle.path) {
      text += std::string(between) +
              "{\"at\": " + point_json(stop.at, instance.is_flat(), instance.resolution()) +
              ", \"arrive\": " + number(stop.arrive);
      if (stop.depart > stop.arrive) text += ", \"depart\": " + number(stop.depart);
      text += "}";
      between = ", ";
    }
    text += "]}";
    separator = ",\n    {";
  }
  return text + "\n  ]";
}

/// The member of a roadmap, if there are any.
std::string lane_places_json(const Instance& instance) {
  const auto number = [&](Ticks ticks) {
    return json_number(in_input_units(ticks, instance.resolution()));
  };
  std::string text;
  const char* separator = ",\n    \"lane_places\": [\n      ";
  for (const LanePlace& place : instance.roadmap().lane_places()) {
    text += separator + ("{\"vertex\": " + std::to_string(place.vertex.index())) +
            ", \"from\": " + std::to_string(place.from.index()) +
            ", \"to\": " + std::to_string(place.to.index()) +
            ", \"behind\": " + number(place.behind) + ", \"whole\": " + number(place.whole) + "}";
    separator = ",\n      ";
  }
  return text + (text.empty() ? "" : "\n    ]");
}

/// The member of a roadmap, if there are any.
std::string shapes_json(const Roadmap& roadmap) {
  std::string text;
  const char* separator = ",\n    \"shapes\": [";
  for (const ShapeId shape : roadmap.shapes()) {
    text += separator + std::to_string(shape.index());
    separator = ", ";
  }
  return text + (text.empty() ? "" : "]");
}

/// The member of a roadmap, if there are any.
std::string no_waiting_json(const Roadmap& roadmap) {
  std::string text;
  const char* separator = ",\n    \"no_waiting\": [";
  for (const VertexId v : roadmap.no_waiting()) {
    text += separator + std::to_string(v.index());
    separator = ", ";
  }
  return text + (text.empty() ? "" : "]");
}

/// The members about names, if there are any.
std::string vertex_names_json(const text::Names& names) {
  std::string text;
  const char* separator = ",\n    \"names\": [";
  for (const std::string& name : names.vertices) {
    text += separator + name;
    separator = ", ";
  }
  return text + (text.empty() ? "" : "]");
}

std::string group_names_json(const text::Names& names) {
  std::string text;
  const char* separator = ",\n  \"group_names\": [";
  for (const std::optional<std::string>& name : names.groups) {
    text += separator + (name ? text::quoted_json(*name) : "null");
    separator = ", ";
  }
  return text + (text.empty() ? "" : "]");
}

}  // namespace

std::optional<Error> write_instance_json(std::ostream& out, const std::string& file,
                                         const Instance& instance, const text::Names& names) {
  const Resolution& resolution = instance.resolution();
  const BodyList bodies(instance);
  const auto number = [&](auto units) { return json_number(in_input_units(units, resolution)); };
  out << "{\n  \"quadrille\": \"instance\",\n  \"version\": " << kInstanceJsonVersion
      << ",\n  \"resolution\": " << resolution_json(resolution);
  if (instance.now() > 0) out << ",\n  \"now\": " << number(instance.now());
  if (instance.has_whole_moves()) out << ",\n  \"whole_moves\": true";
  out << ",\n  \"roadmap\": {\n    \"vertices\": [";
  const char* separator = "\n";
  for (const Point& point : instance.roadmap().positions()) {
    out << separator << "      " << point_json(point, instance.is_flat(), resolution);
    separator = ",\n";
  }
  out << (*separator == ',' ? "\n    ],\n" : "],\n") << "    \"edges\": [";
  separator = "\n";
  for (const Edge& edge : instance.roadmap().edges()) {
    out << separator << "      " << edge_json(edge, resolution);
    separator = ",\n";
  }
  out << (*separator == ',' ? "\n    ]" : "]") << shapes_json(instance.roadmap())
      << no_waiting_json(instance.roadmap()) << lane_places_json(instance)
      << vertex_names_json(names) << "\n  }" << bodies.json() << ",\n  \"agents\": [";
  separator = "\n";
  for (const AgentId i : instance.agent_ids()) {
    const Agent& agent = instance.agent(i);
    out << separator << "    {\"start\": " << agent.start.index() << ", ";
    text::write_goals(out, agent.goals, [](VertexId v) { return v.index(); });
    out << ", " << bodies.member(i)
        << ", \"speed\": " << json_number(speed_in_input_units(agent.speed, resolution));
    if (agent.group != GroupId()) out << ", \"group\": " << agent.group.index();
    if (agent.release > 0) out << ", \"release\": " << number(agent.release);
    if (agent.deadline) out << ", \"deadline\": " << number(*agent.deadline);
    if (agent.under_way) out << ", \"at_start\": \"under_way\"";
    if (agent.leaves) out << ", \"at_goal\": \"leave\"";
    if (agent.overlaps_at_start) out << ", \"overlap_at_start\": true";
    if (const std::string* name = names.agent(i.index()))
      out << ", \"name\": " << text::quoted_json(*name);
    out << "}";
    separator = ",\n";
  }
  out << (*separator == ',' ? "\n  ]" : "]") << obstacles_json(instance) << group_names_json(names)
      << "\n}\n";
  return text::finish_output(out, file);
}

}  // namespace quadrille::continuous
