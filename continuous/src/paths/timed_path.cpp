// SPDX-License-Identifier: MIT
#include "paths/timed_path.hpp"

namespace quadrille::continuous {

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
