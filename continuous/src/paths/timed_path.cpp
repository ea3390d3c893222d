// SPDX-License-Identifier: MIT
#include "paths/timed_path.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

TimedPath without_stops(const Instance& instance, AgentId agent, const Path& stops) {
  TimedPath path;
  const ClassId c = instance.class_of(agent);
  path.arrival = as_ticks(cost(stops));
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const auto& edges = instance.out_edges(c, stops[k].vertex);
    const auto at = std::find_if(edges.begin(), edges.end(), [&](EdgeId e) {
      return instance.roadmap().edge(e).to == stops[k + 1].vertex &&
             instance.duration(c, e) == stops[k + 1].arrive - stops[k].depart;
    });
    QUADRILLE_REQUIRE(at != edges.end(), "plans move along edges");
    path.moves.push_back({*at, stops[k].depart});
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
