// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <map>
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

/// Sets of goals by their names: the member "goal_sets" of an instance.
using GoalSets = std::map<std::string, Goals, std::less<>>;

/// Reads a list of goals that differ, at least one, and returns whether all is well.
/// `read_vertex(node, vertex)`: reads a vertex, likewise; `name_of(vertex)`: for messages.
template <class ReadVertex, class NameOf>
bool read_goal_list(Checker& check, const Document& document, Document::Node list,
                    const ReadVertex& read_vertex, const NameOf& name_of, Goals& goals) {
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

/// Reads the member "goal_sets", an object of lists, likewise.
template <class ReadVertex, class NameOf>
bool read_goal_sets(Checker& check, const Document& document, Document::Node object,
                    const ReadVertex& read_vertex, const NameOf& name_of, GoalSets& sets) {
  if (document.kind(object) != Document::Kind::object)
    return check.fail(object, "expected lists of goals by their names");
  for (Document::Node key = document.first(object); key < document.next(object);
       key = document.next(document.first(key))) {
    const auto [at, is_new] = sets.try_emplace(std::string(document.text(key)));
    if (!is_new) return check.fail(key, "this name is given twice");
    if (!read_goal_list(check, document, document.first(key), read_vertex, name_of, at->second))
      return false;
  }
  return true;
}

/// The members "goal" and "goals" of an agent, of which it has one.
struct GoalNodes {
  std::optional<Document::Node> goal, goals;
  std::string_view plural = "goals";  ///< What the format calls the second.

  /// What is there. Requires that one is.
  [[nodiscard]] Document::Node node() const { return goal ? *goal : *goals; }
};

/// Reads a goal, a list of them, or the name of one of `sets`, likewise. `agent`: whose they are.
template <class ReadVertex, class NameOf>
bool read_goals(Checker& check, const Document& document, Document::Node agent,
                const GoalNodes& nodes, const GoalSets& sets, const ReadVertex& read_vertex,
                const NameOf& name_of, Goals& goals) {
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
  if (document.kind(*nodes.goals) != Document::Kind::string)
    return read_goal_list(check, document, *nodes.goals, read_vertex, name_of, goals);
  const auto named = sets.find(document.text(*nodes.goals));
  if (named == sets.end())
    return check.fail(*nodes.goals, ErrorCode::invalid_instance,
                      "there is no goal set '" + std::string(document.text(*nodes.goals)) + "'");
  goals = named->second;
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
