// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "formats/document.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// An array of edges, each `[place, place]`, of a graph; whether they exist is not looked at.
[[nodiscard]] bool read_edges(Checker& checker, const Document& document, const Graph& graph,
                              Document::Node node, std::vector<Graph::Edge>& edges);

/// Reads the rules of an instance in JSON. On failure the checker has an error.
class RulesReader {
 public:
  /// All outlive the reader.
  RulesReader(Checker& checker, const Document& document, const Graph& graph, Timestep now)
      : check_(checker), document_(document), graph_(graph), now_(now) {}

  /// Of one agent; each may be absent.
  struct OfAgent {
    std::optional<Document::Node> release, deadline, at_goal, waypoints, heading;
  };
  [[nodiscard]] bool read_agent(const OfAgent& nodes, Agent& agent);
  [[nodiscard]] bool read_obstacles(Document::Node node, std::vector<Blockage>& blockages);
  [[nodiscard]] bool read_robust(Document::Node node, Timestep& robust);
  [[nodiscard]] bool read_turn(Document::Node node, Timestep& turn);
  /// False: an agent has a heading although turns take no time.
  [[nodiscard]] bool headings_mean_something(const Rules& rules);

 private:
  using Node = Document::Node;
  bool read_time(Node node, Timestep& time);
  bool read_place(Node node, VertexId& vertex);
  bool read_heading(Node node, Heading& heading);
  bool read_obstacle(Node node, std::vector<Blockage>& blockages);
  /// A body that goes from stop to stop.
  bool read_way(Node path, bool leaves, std::vector<Blockage>& blockages);
  struct Stop {
    VertexId vertex;
    Timestep arrive = 0, depart = 0;
  };
  bool read_stop(Node node, Stop& stop);

  Checker& check_;
  const Document& document_;
  const Graph& graph_;
  const Timestep now_;
  std::optional<Node> heading_;  // the first one that was read
};

/// `[x, y]` or a number.
[[nodiscard]] std::string place_in_json(const Graph& graph, VertexId vertex);
/// The keys, each after a comma; nothing where there are no rules.
void write_one_way(std::ostream& out, const Graph& graph);
void write_rules(std::ostream& out, const Graph& graph, const Rules& rules);
void write_agent_rules(std::ostream& out, const Graph& graph, const Agent& agent);

}  // namespace quadrille::discrete
