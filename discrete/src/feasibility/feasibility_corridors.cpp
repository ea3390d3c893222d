// SPDX-License-Identifier: MIT
// Components with a free vertex that are neither a path nor a cycle.
//
// Junctions are the blocks with cycles, and the other vertices of degree >= 3. A corridor is what
// lies between two junctions that are joined by a path of bridges, or between a junction and a dead
// end; a junction that is a single vertex belongs to each of its corridors. With f free vertices, a
// corridor of at least f vertices is long: agents keep their order in it, all but those that
// can be drawn out at an end. Junctions joined by shorter corridors form a cluster, whose agents
// can be rearranged at will. Two arrangements are reachable from each other exactly if every agent
// belongs to the same cluster, or has the same place in the same long corridor.
#include <algorithm>
#include <utility>

#include "feasibility/feasibility_parts.hpp"

namespace quadrille::discrete::feasibility {
namespace {

struct Corridor {
  Local upper;        ///< The vertex above `first`, part of a junction.
  Local first, stop;  ///< The vertices between the junctions are first .. stop-1.
  Local lower;        ///< The vertex below `stop`-1, part of a junction; kNone: a dead end.
  Local length;       ///< Number of vertices, junctions that are single vertices included.
};

/// To what an agent belongs.
struct Home {
  Local corridor = kNone;  ///< A long corridor, or kNone: a cluster.
  Local index = 0;         ///< The place in the corridor, >= 1, or the cluster.
  friend bool operator==(const Home&, const Home&) = default;
};

class Corridors {
 public:
  explicit Corridors(const Component& component);
  /// The home of each agent.
  [[nodiscard]] std::vector<Home> homes(const Arrangement& arrangement) const;
  /// Why an agent whose homes differ cannot have them both.
  [[nodiscard]] Obstruction explain(Local agent, const Arrangement& start,
                                    const Arrangement& goal) const;

 private:
  [[nodiscard]] bool single(Local v) const { return !component_.on_cycle[v]; }
  [[nodiscard]] bool at_junction(Local v) const {
    return component_.on_cycle[v] || component_.degree(v) >= 3;
  }
  void follow_corridor(Local first);
  template <class Visit>
  void for_each_vertex(const Corridor& corridor, const Visit& visit) const;
  [[nodiscard]] Local place(const Corridor& corridor, const Arrangement& arrangement,
                            Local v) const;
  /// The places in a long corridor are 0: above, 1 .. num_places: inside, num_places + 1: below.
  [[nodiscard]] Local num_places(const Corridor& corridor) const {
    return corridor.length - num_free_;
  }
  [[nodiscard]] Obstruction obstruction(const Corridor& corridor, Local a, Local b) const;

  const Component& component_;
  Local num_free_;
  std::vector<Corridor> long_corridors_;
  std::vector<Local> cluster_;  ///< By vertex. Of no meaning inside long corridors.
};

Corridors::Corridors(const Component& component)
    : component_(component),
      num_free_(component.size() - static_cast<Local>(component.agents.size())),
      cluster_(component.size(), kNone) {
  // In preorder, a junction is met before the corridors below it. The root is at a junction.
  cluster_[0] = 0;
  for (Local v = 1; v < component.size(); ++v) {
    const Local block = component.block[v];
    if (block != v)
      cluster_[v] = cluster_[block];
    else if (at_junction(component.parent[v]))
      follow_corridor(v);
  }
}

/// Follows the bridge above `first` and what comes after it to the next junction or dead end.
void Corridors::follow_corridor(Local first) {
  Corridor corridor{component_.parent[first], first, first, kNone, 0};
  // The only child of a vertex is the next vertex of the preorder.
  Local v = first;
  while (!at_junction(v) && component_.degree(v) == 2) ++v;
  if (at_junction(v)) corridor.lower = v;
  corridor.stop = corridor.lower == kNone ? v + 1 : v;
  corridor.length = corridor.stop - first + (single(corridor.upper) ? 1 : 0) +
                    (corridor.lower != kNone && single(corridor.lower) ? 1 : 0);
  const Local cluster = cluster_[corridor.upper];
  const bool is_long = corridor.length >= num_free_;
  if (is_long) long_corridors_.push_back(corridor);
  for (Local w = first; w < corridor.stop; ++w) cluster_[w] = cluster;
  if (corridor.lower != kNone) cluster_[corridor.lower] = is_long ? corridor.lower : cluster;
}

template <class Visit>
void Corridors::for_each_vertex(const Corridor& corridor, const Visit& visit) const {
  if (single(corridor.upper)) visit(corridor.upper);
  for (Local v = corridor.first; v < corridor.stop; ++v) visit(v);
  if (corridor.lower != kNone && single(corridor.lower)) visit(corridor.lower);
}

/// The place of the agent at vertex `v`, anywhere in the component. No move changes it: an agent
/// that leaves at an end needs a free vertex there, and then it counted as drawn out already.
Local Corridors::place(const Corridor& corridor, const Arrangement& arrangement, Local v) const {
  const auto [upper, first, stop, lower, length] = corridor;
  const bool upper_inside = single(upper), lower_inside = lower != kNone && single(lower);
  const Local below_begin = lower_inside ? lower + 1 : stop;
  const Local below_end = lower == kNone ? stop : component_.subtree_end[lower];
  const Local above_inside = upper_inside && arrangement.occupied(upper) ? 1 : 0;
  const Local end_inside = lower_inside ? lower + 1 : stop;

  if (v >= below_begin && v < below_end) return num_places(corridor) + 1;
  if (!(v >= first && v < end_inside) && !(upper_inside && v == upper)) return 0;

  const Local agents_below = arrangement.count(below_begin, below_end);
  const Local agents_inside = above_inside + arrangement.count(first, end_inside);
  const auto num_agents = static_cast<Local>(component_.agents.size());
  const Local vertices_above = component_.size() - length - (below_end - below_begin);
  const Local free_above = vertices_above - (num_agents - agents_below - agents_inside);

  const Local rank = v == upper ? 0 : above_inside + arrangement.count(first, v);
  if (rank < free_above) return 0;
  return std::min(rank - free_above, num_places(corridor)) + 1;
}

std::vector<Home> Corridors::homes(const Arrangement& arrangement) const {
  std::vector<Home> homes;
  homes.reserve(component_.agents.size());
  for (const Local v : arrangement.vertex_of) homes.push_back({kNone, cluster_[v]});
  for (Local index = 0; index < long_corridors_.size(); ++index) {
    const Corridor& corridor = long_corridors_[index];
    const Local below = num_places(corridor) + 1;
    for_each_vertex(corridor, [&](Local v) {
      if (!arrangement.occupied(v)) return;
      const Local where = place(corridor, arrangement, v);
      // A junction that is a single vertex lies in several corridors. At most one of them, that
      // with all free vertices in it or beyond, has more to say than that the agent is at its end.
      if ((v == corridor.upper && where == 0) || (v == corridor.lower && where == below)) return;
      Home& home = homes[arrangement.agent_at[v]];
      if (where == 0)
        home = {kNone, cluster_[corridor.upper]};
      else if (where == below)
        home = {kNone, cluster_[corridor.lower]};
      else
        home = {index, where};
    });
  }
  return homes;
}

Obstruction Corridors::explain(Local agent, const Arrangement& start,
                               const Arrangement& goal) const {
  for (const Corridor& corridor : long_corridors_) {
    const auto place_of = [&](const Arrangement& arrangement, Local a) {
      return place(corridor, arrangement, arrangement.vertex_of[a]);
    };
    const Local from = place_of(start, agent), to = place_of(goal, agent);
    if (from == to) continue;
    // As many agents are beyond each place at the start as at the end, so that somebody has to
    // come the other way.
    for (Local other = 0; other < component_.agents.size(); ++other) {
      const Local other_from = place_of(start, other), other_to = place_of(goal, other);
      if (from < to ? other_from > from && other_to < to : other_from < from && other_to > to)
        return obstruction(corridor, agent, other);
    }
  }
  QUADRILLE_REQUIRE(false, "different homes are told apart by a long corridor");
  return {};
}

Obstruction Corridors::obstruction(const Corridor& corridor, Local a, Local b) const {
  std::vector<Local> vertices;
  for_each_vertex(corridor, [&](Local v) { vertices.push_back(v); });
  const Local first = vertices.front(), last = vertices.back();
  // Of one vertex that is a fork below a rich block, the others are on the other side.
  Local beyond = kNone;
  if (first == last) beyond = first == corridor.lower ? corridor.upper : corridor.lower;
  std::string where = " at " + component_.name_of(first);
  if (first != last)
    where =
        " in the corridor from " + component_.name_of(first) + " to " + component_.name_of(last);
  return {"agents " + component_.agent_name(std::min(a, b)) + " and " +
              component_.agent_name(std::max(a, b)) + " cannot pass each other" + where +
              ": that takes " + std::to_string(corridor.length + 1) +
              " free vertices, and the component has " + std::to_string(num_free_),
          {a, b},
          std::move(vertices),
          Invariant::Kind::corridor,
          {},
          beyond};
}

}  // namespace

std::optional<Obstruction> check_corridors(const Component& component, const Arrangement& start,
                                           const Arrangement& goal) {
  const Corridors corridors(component);
  const std::vector<Home> first = corridors.homes(start), last = corridors.homes(goal);
  for (Local agent = 0; agent < component.agents.size(); ++agent)
    if (first[agent] != last[agent]) return corridors.explain(agent, start, goal);
  return std::nullopt;
}

}  // namespace quadrille::discrete::feasibility
