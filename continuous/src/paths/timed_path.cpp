// SPDX-License-Identifier: MIT
#include "paths/timed_path.hpp"

#include <optional>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

namespace {

/// One that is open to the class, if there is any: who is to be sent elsewhere may be on a way that
/// has been closed since.
EdgeId edge_between(const Instance& instance, ClassId c, const Stop& from, const Stop& to) {
  const auto find_in = [&](const auto& edges) -> std::optional<EdgeId> {
    for (const EdgeId e : edges)
      if (instance.roadmap().to(e) == to.vertex &&
          instance.duration(c, e) == to.arrive - from.depart)
        return e;
    return std::nullopt;
  };
  auto found = find_in(instance.out_edges(c, from.vertex));
  if (!found) found = find_in(instance.roadmap().out_edges(from.vertex));
  QUADRILLE_REQUIRE(found.has_value(), "plans move along edges");
  return *found;
}

}  // namespace

TimedPath without_stops(const Instance& instance, AgentId agent, const Path& stops) {
  TimedPath path;
  const ClassId c = instance.class_of(agent);
  path.arrival = as_ticks(cost(stops));
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    path.moves.push_back({edge_between(instance, c, stops[k], stops[k + 1]), stops[k].depart});
  }
  return path;
}

Path with_stops(const Instance& instance, AgentId agent, const TimedPath& path) {
  const ClassId c = instance.class_of(agent);
  Path stops{{instance.agent(agent).start, 0, 0}};
  for (const Move& move : path.moves) {
    stops.back().depart = move.start;
    const Ticks arrive = move.start + instance.duration(c, move.edge);
    stops.push_back({instance.roadmap().edge(move.edge).to, arrive, arrive});
  }
  return stops;
}

}  // namespace quadrille::continuous
