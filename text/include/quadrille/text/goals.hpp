// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/text/document.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// The members "goal" and "goals" of an agent, of which it has one.
struct GoalNodes {
  std::optional<Document::Node> goal, goals;
  std::string_view plural = "goals";  ///< What the format calls the second.

  /// What is there. Requires that one is.
  [[nodiscard]] Document::Node node() const { return goal ? *goal : *goals; }
};

/// Reads a goal, or a list of them that differ, and returns whether all is well. `agent`: whose
/// they are. `read_vertex(node, vertex)`: reads a vertex, likewise; `name_of(vertex)`: for
/// messages.
template <class ReadVertex, class NameOf>
bool read_goals(Checker& check, const Document& document, Document::Node agent,
                const GoalNodes& nodes, const ReadVertex& read_vertex, const NameOf& name_of,
                Goals& goals) {
  if (!nodes.goal && !nodes.goals) return check.fail(agent, "the key 'goal' is missing");
  if (nodes.goal && nodes.goals)
    return check.fail(*nodes.goals,
                      "expected either 'goal' or '" + std::string(nodes.plural) + "'");
  if (nodes.goal) {
    VertexId only;
    if (!read_vertex(*nodes.goal, only)) return false;
    goals = only;
    return true;
  }
  const Document::Node list = *nodes.goals;
  if (!check.array(list, "goals")) return false;
  std::vector<std::pair<VertexId, Document::Node>> read;
  for (Document::Node g = document.first(list); g < document.next(list); g = document.next(g)) {
    VertexId vertex;
    if (!read_vertex(g, vertex)) return false;
    read.emplace_back(vertex, g);
  }
  if (read.empty())
    return check.fail(list, ErrorCode::invalid_instance, "there is no goal in the list");
  std::vector<VertexId> vertices;
  vertices.reserve(read.size());
  std::stable_sort(read.begin(), read.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [vertex, place] : read) {
    if (!vertices.empty() && vertices.back() == vertex)
      return check.fail(place, ErrorCode::invalid_instance,
                        "the goal " + name_of(vertex) + " is given twice");
    vertices.push_back(vertex);
  }
  goals = Goals(std::move(vertices));
  return true;
}

/// Writes the member that `read_goals` reads: `"goal": v` or `"goals": [v, ...]`. `place(vertex)`:
/// something to write.
template <class Place>
void write_goals(std::ostream& out, const Goals& goals, const Place& place) {
  out << (goals.is_single() ? "\"goal\": " : "\"goals\": [");
  for (const VertexId& goal : goals.vertices())
    out << (&goal == goals.vertices().data() ? "" : ", ") << place(goal);
  if (!goals.is_single()) out << ']';
}

}  // namespace quadrille::text

QUADRILLE_API_END
