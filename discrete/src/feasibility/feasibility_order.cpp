// SPDX-License-Identifier: MIT
// Paths and cycles: the order of the agents never changes.
#include <algorithm>
#include <utility>

#include "feasibility/feasibility_parts.hpp"

namespace quadrille::discrete::feasibility {
namespace {

/// The agents on these vertices, in the order of the vertices.
std::vector<Local> agents_along(std::span<const Local> vertices, const Arrangement& arrangement) {
  std::vector<Local> agents;
  for (const Local v : vertices)
    if (arrangement.occupied(v)) agents.push_back(arrangement.agent_at[v]);
  return agents;
}

void rotate_to_front(std::vector<Local>& agents, Local first) {
  std::rotate(agents.begin(), std::find(agents.begin(), agents.end(), first), agents.end());
}

std::string both(const Component& component, Local a, Local b) {
  return "agents " + component.agent_name(std::min(a, b)) + " and " +
         component.agent_name(std::max(a, b));
}

}  // namespace

std::optional<Obstruction> check_path(const Component& component, const Arrangement& start,
                                      const Arrangement& goal) {
  std::vector<Local> path(component.size());
  for (Local v = 0; v < component.size(); ++v) path[v] = v;
  const auto first = agents_along(path, start), last = agents_along(path, goal);
  const auto [a, b] = std::mismatch(first.begin(), first.end(), last.begin());
  if (a == first.end()) return std::nullopt;
  // Both orders agree before this place, so *a precedes *b at the start and follows it at the end.
  return Obstruction{both(component, *a, *b) + " cannot pass each other: the component of " +
                         component.name_of(start.vertex_of[std::min(*a, *b)]) +
                         " is a corridor without junctions",
                     {*a, *b},
                     std::move(path),
                     Invariant::Kind::corridor,
                     {}};
}

std::optional<Obstruction> check_cycle(const Component& component, std::span<const Local> cycle,
                                       const Arrangement& start, const Arrangement& goal) {
  auto first = agents_along(cycle, start), last = agents_along(cycle, goal);
  if (first.size() < 3) return std::nullopt;  // Two agents on a cycle have only one order.
  // Told from an agent that is at its goal already, the reason is about those that are to move.
  const Local fixed = *std::min_element(first.begin(), first.end(), [&](Local a, Local b) {
    const auto moves = [&](Local c) { return start.vertex_of[c] != goal.vertex_of[c]; };
    return std::pair(moves(a), a) < std::pair(moves(b), b);
  });
  rotate_to_front(first, fixed);
  rotate_to_front(last, fixed);
  const auto [a, b] = std::mismatch(first.begin(), first.end(), last.begin());
  if (a == first.end()) return std::nullopt;
  return Obstruction{both(component, *a, *b) + " cannot change their order relative to agent " +
                         component.agent_name(fixed) + ": none of them can leave the cycle of " +
                         component.name_of(start.vertex_of[std::min(*a, *b)]) +
                         ", on which the cyclic order never changes",
                     {*a, *b, fixed},
                     {cycle.begin(), cycle.end()},
                     Invariant::Kind::cycle,
                     {}};
}

}  // namespace quadrille::discrete::feasibility
