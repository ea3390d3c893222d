// SPDX-License-Identifier: MIT
#include "formats/json_bodies.hpp"

#include <utility>
#include <variant>

#include "formats/json_numbers.hpp"

namespace quadrille::continuous {

bool BodyReader::read_list(Node list) {
  if (!check_.array(list, "bodies")) return false;
  for (Node b = document_.first(list); b < document_.next(list); b = document_.next(b)) {
    if (!check_.array(b, "shapes")) return false;
    std::vector<Body>& bodies = bodies_.emplace_back();
    for (Node s = document_.first(b); s < document_.next(b); s = document_.next(s)) {
      Keys keys;
      if (!check_.members(s,
                          {{"radius", &keys.radius, false}, {"polygon", &keys.polygon, false}}) ||
          !read(s, keys, bodies.emplace_back()))
        return false;
    }
    if (bodies.empty()) return check_.fail(b, "a body has one shape or more");
  }
  return true;
}

bool BodyReader::read(Node object, const Keys& keys, Agent& agent) {
  if (!keys.body) return read(object, keys, agent.body);
  if (keys.radius || keys.polygon)
    return check_.fail(*keys.body, "an agent has a body of the list, a radius, or a polygon");
  std::int64_t number = 0;
  if (!check_.integer(*keys.body, 0, INT64_MAX, number)) return false;
  if (number >= std::ssize(bodies_))
    return check_.fail(
        *keys.body, ErrorCode::invalid_instance,
        "there is no body " + std::to_string(number) + " among " + std::to_string(bodies_.size()));
  const std::vector<Body>& bodies = bodies_[static_cast<std::size_t>(number)];
  agent.body = bodies.front();
  agent.shapes.assign(bodies.begin() + 1, bodies.end());
  return true;
}

bool BodyReader::read(Node object, const Keys& keys, Body& body) {
  if (keys.radius && keys.polygon)
    return check_.fail(*keys.polygon, "an agent has a radius or a polygon, not both");
  if (keys.polygon) return read_polygon(*keys.polygon, body);
  if (!keys.radius) return check_.fail(object, "one of the keys 'radius' and 'polygon' is missing");
  Disc disc;
  if (!read_radius(*keys.radius, disc.radius)) return false;
  body = disc;
  return true;
}

bool BodyReader::read_polygon(Node node, Body& body) {
  if (!check_.array(node, "corners")) return false;
  std::vector<Point> corners;
  for (Node c = document_.first(node); c < document_.next(node); c = document_.next(c)) {
    if (!check_.array(c, "coordinates", 2)) return false;
    const Node x = document_.first(c);
    Point corner;
    if (!read_corner(x, corner.x) || !read_corner(document_.next(x), corner.y)) return false;
    corners.push_back(corner);
  }
  auto polygon = ConvexPolygon::make(std::move(corners));
  if (!polygon)
    return check_.fail(node, polygon.error().code,
                       polygon.error().message + ", in whole length units");
  body = std::move(polygon).value();
  return true;
}

bool BodyReader::read_corner(Node node, Length& length) {
  double value = 0;
  if (!check_.number(node, value)) return false;
  const auto units = quantise_corner(value, resolution_);
  if (!units)
    return check_.fail(node, ErrorCode::out_of_range,
                       "the coordinate is too large for the resolution");
  length = *units;
  return true;
}

bool BodyReader::read_radius(Node node, Length& radius) {
  double value = 0;
  if (!check_.number(node, value)) return false;
  const auto units = quantise_radius(value, resolution_);
  if (!units)
    return check_.fail(node, ErrorCode::out_of_range,
                       "the radius is less than one length unit, or too large: " + decimal(value));
  radius = *units;
  return true;
}

std::string body_json(const Body& body, const Resolution& resolution) {
  if (const auto* disc = std::get_if<Disc>(&body))
    return "\"radius\": " + json_number(radius_in_input_units(disc->radius, resolution));
  std::string text = "\"polygon\": [";
  const char* separator = "";
  for (const Point& corner : std::get<ConvexPolygon>(body).vertices()) {
    text += std::string(separator) + "[" +
            json_number(corner_in_input_units(corner.x, resolution)) + ", " +
            json_number(corner_in_input_units(corner.y, resolution)) + "]";
    separator = ", ";
  }
  return text + "]";
}

BodyList::BodyList(const Instance& instance) : instance_(instance) {
  for (const AgentId i : instance.agent_ids()) {
    const ClassId c = instance.class_of(i);
    if (instance.agent(i).shapes.empty() || numbers_.contains(c)) continue;
    std::size_t k = 0;  // classes that differ in speed only have one body
    while (k < classes_.size() && instance.bodies(classes_[k]) != instance.bodies(c)) ++k;
    if (k == classes_.size()) classes_.push_back(c);
    numbers_.emplace(c, k);
  }
}

std::string BodyList::member(AgentId agent) const {
  const auto number = numbers_.find(instance_.class_of(agent));
  if (number == numbers_.end())
    return body_json(instance_.agent(agent).body, instance_.resolution());
  return "\"body\": " + std::to_string(number->second);
}

std::string BodyList::json() const {
  std::string text;
  const char* separator = ",\n  \"bodies\": [\n    [";
  for (const ClassId c : classes_) {
    const char* between = "\n      {";
    text += separator;
    for (const Body& body : instance_.bodies(c)) {
      text += between + body_json(body, instance_.resolution()) + "}";
      between = ",\n      {";
    }
    text += "\n    ]";
    separator = ",\n    [";
  }
  return text + (text.empty() ? "" : "\n  ]");
}

}  // namespace quadrille::continuous
