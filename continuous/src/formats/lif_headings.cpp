// SPDX-License-Identifier: MIT
#include "formats/lif_headings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {

bool LifHeadings::add_stand(Node theta, VertexId vertex) {
  if (!options_.has_headings) {
    builder_.not_used("'theta' of a node");
    return true;
  }
  double heading = 0;
  if (!check_.number(theta, heading)) return false;
  if (!(std::abs(heading) <= 2 * std::numbers::pi))
    return check_.fail(theta, ErrorCode::out_of_range, "theta is in radians, from -pi to pi");
  builder_.headings().stands.push_back({vertex, heading});
  return true;
}

void LifHeadings::count_unused(const Edge& edge) {
  const auto count = [&](const std::optional<Node>& node, const char* name) {
    if (node) builder_.not_used("'" + std::string(name) + "' of an edge");
  };
  // Robots without headings may turn wherever they are: not rotationAllowed.
  count(edge.orientation, "vehicleOrientation");
  count(edge.type, "orientationType");
  count(edge.at_start, "rotationAtStartNodeAllowed");
  count(edge.at_end, "rotationAtEndNodeAllowed");
  count(edge.most, "maxRotationSpeed");
}

bool LifHeadings::add_edge(const Edge& edge, VertexId from, VertexId to) {
  if (!options_.has_headings) {
    count_unused(edge);
    return true;
  }
  return read_heading(edge, from, to) && read_turns(edge, from, to);
}

bool LifHeadings::read_heading(const Edge& edge, VertexId from, VertexId to) {
  bool is_global = false;
  if (edge.type) {
    std::string_view type;
    if (!check_.text(*edge.type, type)) return false;
    if (type != "GLOBAL" && type != "TANGENTIAL")
      return check_.fail(*edge.type,
                         "expected GLOBAL or TANGENTIAL, found " + text::in_quotes(type));
    is_global = type == "GLOBAL";
  }
  if (!edge.orientation) {
    ++num_ahead_;
    return true;
  }
  double degrees = 0;
  if (!check_.number(*edge.orientation, degrees)) return false;
  if (!(std::abs(degrees) <= 360))
    return check_.fail(*edge.orientation, ErrorCode::out_of_range,
                       "an orientation is in degrees, from 0 to 360");
  double heading = degrees * std::numbers::pi / 180;
  if (!is_global) heading += builder_.direction(from, to);
  builder_.headings().lanes.push_back({from, to, heading});
  return true;
}

bool LifHeadings::read_directions(const std::optional<Node>& node, HeadingRules::Turns& turns) {
  if (!node) return true;
  std::string_view text;
  if (!check_.text(*node, text)) return false;
  if (text != "NONE" && text != "CCW" && text != "CW" && text != "BOTH")
    return check_.fail(*node, "expected NONE, CCW, CW or BOTH, found " + text::in_quotes(text));
  turns.counter_clockwise = text == "CCW" || text == "BOTH";
  turns.clockwise = text == "CW" || text == "BOTH";
  return true;
}

bool LifHeadings::read_turns(const Edge& edge, VertexId from, VertexId to) {
  double most = 0;
  if (edge.most) {
    if (!check_.number(*edge.most, most)) return false;
    if (!(most > 0))
      return check_.fail(*edge.most, ErrorCode::out_of_range, "a rotation speed is positive");
  }
  if (edge.on_edge) {
    bool may_turn = false;
    if (!check_.boolean(*edge.on_edge, may_turn)) return false;
    if (may_turn) builder_.not_used("rotation on an edge");
  }
  for (const auto& [vertex, directions] : {std::pair(from, edge.at_start), {to, edge.at_end}}) {
    HeadingRules::Turns turns{vertex};
    if (!read_directions(directions, turns)) return false;
    if (edge.most) turns.most = most * options_.resolution.time;
    allowed_[vertex].insert({turns.counter_clockwise, turns.clockwise});
    const bool is_free = turns.counter_clockwise && turns.clockwise && !edge.most;
    if (!is_free) builder_.headings().turns.push_back(turns);
  }
  return true;
}

void LifHeadings::finish() {
  if (num_ahead_ > 0)
    builder_.note("robots face ahead on edges without an orientation (" +
                  std::to_string(num_ahead_) + (num_ahead_ == 1 ? " edge)" : " edges)"));
  std::string nodes;
  for (const auto& [vertex, directions] : allowed_)
    if (directions.size() > 1)
      nodes += (nodes.empty() ? "" : ", ") + text::in_quotes(builder_.id(vertex));
  if (!nodes.empty())
    builder_.note("robots turn only as all edges allow that begin or end there at " + nodes);
}

}  // namespace quadrille::continuous
