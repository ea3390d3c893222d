// SPDX-License-Identifier: MIT
#include "verify/rules.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace quadrille::discrete {
namespace {

using Kind = Violation::Kind;
using Tell = std::function<void(Kind, Timestep, const std::string&)>;

std::string name_of(const Graph& graph, VertexId v) {
  return v.index() < graph.num_vertices() ? vertex_name(graph, v)
                                          : "vertex " + std::to_string(v.value());
}

void check_waypoints(const Graph& graph, const Agent& agent, const Path& path, const Tell& tell) {
  std::size_t visited = 0;
  const std::size_t end = length_while_there(agent, path);
  for (std::size_t t = 0; t < end; ++t)
    while (visited < agent.waypoints.size() && path[t] == agent.waypoints[visited]) ++visited;
  if (visited == agent.waypoints.size()) return;
  tell(Kind::waypoint, static_cast<Timestep>(end) - 1,
       "does not visit its waypoint " + name_of(graph, agent.waypoints[visited]) +
           (visited == 0 ? "" : " after the one before it"));
}

/// Turns begin as soon as they can: on the grid, by coordinates.
void check_turns(const Instance& instance, const Agent& agent, const Path& path, std::size_t end,
                 const Tell& tell) {
  const Timestep turn = instance.rules().turn;
  const GridLayout& layout = *instance.graph().layout();
  std::size_t since = 0;
  Heading heading = agent.heading;
  for (std::size_t t = 1; t < end; ++t) {
    if (path[t] == path[t - 1]) continue;
    const bool are_cells =
        path[t].index() < layout.num_vertices() && path[t - 1].index() < layout.num_vertices();
    const Cell from = are_cells ? layout.cell_of(path[t - 1]) : Cell{};
    const Cell to = are_cells ? layout.cell_of(path[t]) : Cell{};
    Heading then = heading;
    if (to.x - from.x == 1) then = Heading::east;
    if (to.x - from.x == -1) then = Heading::west;
    if (to.y - from.y == 1) then = Heading::south;
    if (to.y - from.y == -1) then = Heading::north;
    const int apart = std::abs(static_cast<int>(then) - static_cast<int>(heading));
    const Timestep needed = (apart == 3 ? 1 : apart) * turn;
    if (static_cast<Timestep>(t - 1 - since) < needed)
      tell(Kind::turn, static_cast<Timestep>(t) - 1,
           "moves " + std::string(to_string(then)) + ", but has faced " +
               std::string(to_string(heading)) + " " + std::to_string(t - 1 - since) +
               " timesteps before, and needs " + std::to_string(needed) + " to turn");
    since = t;
    heading = then;
  }
}

/// One blockage and all of a path, the rest at its end included.
void check_blockage(const Graph& graph, const Blockage& b, std::int64_t now, bool leaves,
                    const Path& path, std::size_t end, const Tell& tell) {
  for (std::size_t t = 0; t < end; ++t) {
    const std::int64_t time = now + static_cast<std::int64_t>(t);
    if (time < b.first || (b.last && time > *b.last)) continue;
    const auto at = static_cast<Timestep>(t);
    if (!b.to) {
      if (path[t] == b.vertex)
        tell(Kind::obstacle, at, "is at " + name_of(graph, b.vertex) + ", which is blocked");
    } else if (t + 1 < end && path[t] != path[t + 1] &&
               ((path[t] == b.vertex && path[t + 1] == *b.to) ||
                (path[t] == *b.to && path[t + 1] == b.vertex))) {
      tell(Kind::obstacle, at,
           "moves from " + name_of(graph, path[t]) + " to " + name_of(graph, path[t + 1]) +
               " along an edge that is blocked");
    }
  }
  if (leaves || b.to || path.back() != b.vertex) return;
  // At rest from here on.
  const std::int64_t rest = std::max<std::int64_t>(b.first, now + static_cast<std::int64_t>(end));
  if (b.last && *b.last < rest) return;
  tell(Kind::obstacle, static_cast<Timestep>(rest - now),
       "rests at " + name_of(graph, b.vertex) + ", which is blocked");
}

}  // namespace

std::size_t length_while_there(const Agent& agent, const Path& path) {
  std::size_t length = path.size();
  if (agent.leaves)
    while (length > 1 && path[length - 1] == path[length - 2]) --length;
  return length;
}

void check_own_rules(const Instance& instance, const Agent& agent, const Path& path,
                     const Tell& tell) {
  const std::int64_t now = instance.now();
  const std::size_t end = length_while_there(agent, path);
  std::int64_t arrival = 0;
  for (std::size_t t = 1; t < end; ++t) {
    if (path[t] == path[t - 1]) continue;
    arrival = static_cast<std::int64_t>(t);
    if (now + arrival - 1 < agent.release)
      tell(Kind::too_early, static_cast<Timestep>(t) - 1,
           "moves before its release at timestep " + std::to_string(agent.release));
  }
  if (agent.deadline && now + arrival > *agent.deadline)
    tell(Kind::too_late, static_cast<Timestep>(arrival),
         "arrives after its deadline at timestep " + std::to_string(*agent.deadline));
  check_waypoints(instance.graph(), agent, path, tell);
  if (instance.rules().turn > 0) check_turns(instance, agent, path, end, tell);
  for (const Blockage& blockage : instance.rules().blockages)
    check_blockage(instance.graph(), blockage, now, agent.leaves, path, end, tell);
}

}  // namespace quadrille::discrete
