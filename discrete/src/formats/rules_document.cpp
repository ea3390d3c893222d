// SPDX-License-Identifier: MIT
#include "formats/rules_document.hpp"

#include <ostream>

#include "formats/instance_document.hpp"
#include "formats/text_input.hpp"
#include "quadrille/text/choice.hpp"

namespace quadrille::discrete {

using Node = Document::Node;

bool read_edges(Checker& check, const Document& document, const Graph& graph, Node node,
                std::vector<Graph::Edge>& edges) {
  if (!check.array(node, "edges")) return false;
  for (Node e = document.first(node); e < document.next(node); e = document.next(e)) {
    Graph::Edge edge;
    if (!check.array(e, "places", 2)) return false;
    const Node from = document.first(e), to = document.next(from);
    if (!read_place(check, document, graph, from, ErrorCode::invalid_instance, edge.first) ||
        !read_place(check, document, graph, to, ErrorCode::invalid_instance, edge.second))
      return false;
    edges.push_back(edge);
  }
  return true;
}

bool RulesReader::read_time(Node node, Timestep& time) {
  std::int64_t number = 0;
  if (!check_.integer(node, 0, std::int64_t{now_} + kMaxRuleTime - 1, number)) return false;
  time = static_cast<Timestep>(number);
  return true;
}

bool RulesReader::read_place(Node node, VertexId& vertex) {
  return discrete::read_place(check_, document_, graph_, node, ErrorCode::invalid_instance, vertex);
}

bool RulesReader::read_agent(const OfAgent& nodes, Agent& agent) {
  if ((nodes.release && !read_time(*nodes.release, agent.release)) ||
      (nodes.deadline && !read_time(*nodes.deadline, agent.deadline.emplace())) ||
      (nodes.at_goal &&
       !text::read_choice(check_, *nodes.at_goal, "stay", "leave", agent.leaves)) ||
      (nodes.heading && !read_heading(*nodes.heading, agent.heading)))
    return false;
  if (!nodes.waypoints) return true;
  if (!check_.array(*nodes.waypoints, "places")) return false;
  for (Node p = document_.first(*nodes.waypoints); p < document_.next(*nodes.waypoints);
       p = document_.next(p))
    if (!read_place(p, agent.waypoints.emplace_back())) return false;
  return true;
}

bool RulesReader::read_robust(Node node, Timestep& robust) {
  std::int64_t number = 0;
  if (!check_.integer(node, 0, kMaxRuleTime - 1, number)) return false;
  robust = static_cast<Timestep>(number);
  return true;
}

bool RulesReader::read_turn(Node node, Timestep& turn) {
  std::int64_t number = 0;
  if (!graph_.layout())
    return check_.fail(node, ErrorCode::invalid_instance, "turns take time on a grid only");
  if (!check_.integer(node, 1, kMaxTurn, number)) return false;
  turn = static_cast<Timestep>(number);
  return true;
}

bool RulesReader::headings_mean_something(const Rules& rules) {
  return rules.turn > 0 || !heading_ ||
         check_.fail(*heading_, "agents have headings only where there is the key 'turn'");
}

bool RulesReader::read_heading(Node node, Heading& heading) {
  if (!heading_) heading_ = node;
  std::string_view name;
  if (!check_.text(node, name)) return false;
  for (const Heading known : kHeadings)
    if (to_string(known) == name) {
      heading = known;
      return true;
    }
  return check_.fail(node, "expected 'east', 'south', 'west' or 'north', found " + in_quotes(name));
}

bool RulesReader::read_obstacles(Node node, std::vector<Blockage>& blockages) {
  if (!check_.array(node, "obstacles")) return false;
  for (Node o = document_.first(node); o < document_.next(node); o = document_.next(o))
    if (!read_obstacle(o, blockages)) return false;
  return true;
}

bool RulesReader::read_obstacle(Node node, std::vector<Blockage>& blockages) {
  std::optional<Node> vertex, edge, first, last, path, at_end;
  if (!check_.members(node, {{"vertex", &vertex, false},
                             {"edge", &edge, false},
                             {"first", &first, false},
                             {"last", &last, false},
                             {"path", &path, false},
                             {"at_end", &at_end, false}}))
    return false;
  if (vertex.has_value() + edge.has_value() + path.has_value() != 1)
    return check_.fail(node, "expected one of the keys 'vertex', 'edge' and 'path'");
  if (path) {
    bool leaves = false;
    if (first || last) return check_.fail(node, "the stops of a 'path' have times of their own");
    return (!at_end || text::read_choice(check_, *at_end, "stay", "leave", leaves)) &&
           read_way(*path, leaves, blockages);
  }
  if (at_end) return check_.fail(*at_end, "only a 'path' has an end");
  Blockage blockage;
  if (first && !read_time(*first, blockage.first)) return false;
  if (last && !read_time(*last, blockage.last.emplace())) return false;
  if (blockage.last && *blockage.last < blockage.first)
    return check_.fail(node, ErrorCode::invalid_instance, "it ends before it begins");
  if (edge) {
    if (!check_.array(*edge, "places", 2)) return false;
    const Node from = document_.first(*edge);
    if (!read_place(from, blockage.vertex) ||
        !read_place(document_.next(from), blockage.to.emplace()))
      return false;
    if (!graph_.adjacent(blockage.vertex, *blockage.to) &&
        !graph_.adjacent(*blockage.to, blockage.vertex))
      return check_.fail(*edge, ErrorCode::invalid_instance, "there is no such edge");
  } else if (!read_place(*vertex, blockage.vertex)) {
    return false;
  }
  blockages.push_back(blockage);
  return true;
}

bool RulesReader::read_stop(Node node, Stop& stop) {
  std::optional<Node> vertex, arrive, depart;
  if (!check_.members(node,
                      {{"vertex", &vertex}, {"arrive", &arrive}, {"depart", &depart, false}}) ||
      !read_place(*vertex, stop.vertex) || !read_time(*arrive, stop.arrive))
    return false;
  stop.depart = stop.arrive;
  if (depart && !read_time(*depart, stop.depart)) return false;
  if (stop.depart < stop.arrive)
    return check_.fail(node, ErrorCode::invalid_instance, "it departs before it arrives");
  return true;
}

bool RulesReader::read_way(Node path, bool leaves, std::vector<Blockage>& blockages) {
  if (!check_.array(path, "stops")) return false;
  if (document_.first(path) >= document_.next(path))
    return check_.fail(path, ErrorCode::invalid_instance, "a path has at least one stop");
  std::optional<Stop> before;
  for (Node s = document_.first(path); s < document_.next(path); s = document_.next(s)) {
    Stop stop;
    if (!read_stop(s, stop)) return false;
    if (before) {
      if (stop.arrive != before->depart + 1)
        return check_.fail(s, ErrorCode::invalid_instance,
                           "it departs at timestep " + std::to_string(before->depart) +
                               " and has to arrive at the next one");
      if (!graph_.adjacent(before->vertex, stop.vertex) &&
          !graph_.adjacent(stop.vertex, before->vertex))
        return check_.fail(s, ErrorCode::invalid_instance, "no edge leads here from the last stop");
      blockages.push_back({before->vertex, stop.vertex, before->depart, before->depart});
    }
    const bool is_last = document_.next(s) >= document_.next(path);
    blockages.push_back({stop.vertex, std::nullopt, stop.arrive,
                         is_last && !leaves ? std::nullopt : std::optional(stop.depart)});
    before = stop;
  }
  return true;
}

std::string place_in_json(const Graph& graph, VertexId vertex) {
  if (!graph.layout()) return std::to_string(vertex.value());
  const Cell cell = graph.layout()->cell_of(vertex);
  return "[" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + "]";
}

namespace {

std::string edge_in_json(const Graph& graph, VertexId from, VertexId to) {
  return "[" + place_in_json(graph, from) + ", " + place_in_json(graph, to) + "]";
}

}  // namespace

void write_one_way(std::ostream& out, const Graph& graph) {
  if (!graph.is_directed()) return;
  const char* begin = ",\n    \"one_way\": [\n      ";
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    for (const VertexId w : graph.neighbours(v)) {
      if (graph.adjacent(w, v)) continue;
      out << begin << edge_in_json(graph, v, w);
      begin = ",\n      ";
    }
  out << "\n    ]";
}

void write_rules(std::ostream& out, const Graph& graph, const Rules& rules) {
  if (rules.robust > 0) out << ",\n  \"robust\": " << rules.robust;
  if (rules.turn > 0) out << ",\n  \"turn\": " << rules.turn;
  if (rules.blockages.empty()) return;
  const char* begin = ",\n  \"obstacles\": [\n    ";
  for (const Blockage& b : rules.blockages) {
    out << begin
        << (b.to ? "{\"edge\": " + edge_in_json(graph, b.vertex, *b.to)
                 : "{\"vertex\": " + place_in_json(graph, b.vertex))
        << ", \"first\": " << b.first;
    if (b.last) out << ", \"last\": " << *b.last;
    out << '}';
    begin = ",\n    ";
  }
  out << "\n  ]";
}

void write_agent_rules(std::ostream& out, const Graph& graph, const Agent& agent) {
  if (agent.release > 0) out << ", \"release\": " << agent.release;
  if (agent.deadline) out << ", \"deadline\": " << *agent.deadline;
  if (agent.leaves) out << ", \"at_goal\": \"leave\"";
  if (agent.heading != Heading::east) out << ", \"heading\": \"" << to_string(agent.heading) << '"';
  if (agent.waypoints.empty()) return;
  const char* begin = ", \"waypoints\": [";
  for (const VertexId v : agent.waypoints) {
    out << begin << place_in_json(graph, v);
    begin = ", ";
  }
  out << ']';
}

}  // namespace quadrille::discrete
