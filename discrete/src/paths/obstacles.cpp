// SPDX-License-Identifier: MIT
#include "paths/obstacles.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

using Kind = Obstacle::Kind;

ObstacleId ObstacleTable::add(const Obstacle& obstacle) {
  obstacles_.push_back(obstacle);
  return ObstacleId(obstacles_.size() - 1);
}

ObstacleId ObstacleTable::add_point(AgentId agent, sat::Lit allowed, Visit visit) {
  return add({Kind::point, agent, allowed, visit.vertex, {}, visit.timestep, visit.timestep, 0, 0});
}

ObstacleId ObstacleTable::add_edge(AgentId agent, sat::Lit allowed, VertexId from, VertexId to,
                                   Timestep t) {
  return add({Kind::edge, agent, allowed, from, to, t, t, 0, 0});
}

ObstacleId ObstacleTable::add_range(AgentId agent, sat::Lit allowed, VertexId vertex,
                                    Timestep first, Timestep last) {
  QUADRILLE_REQUIRE(first <= last, "a range is not empty");
  return add({Kind::range, agent, allowed, vertex, {}, first, last, 0, 0});
}

ObstacleId ObstacleTable::add_end(AgentId agent, sat::Lit allowed, VertexId vertex) {
  return add({Kind::end, agent, allowed, vertex, {}, 0, kForever, 0, 0});
}

ObstacleId ObstacleTable::add_elsewhere(AgentId agent, sat::Lit allowed, VertexId vertex) {
  return add({Kind::elsewhere, agent, allowed, vertex, {}, 0, kForever, 0, 0});
}

ObstacleId ObstacleTable::add_barrier(AgentId agent, sat::Lit allowed,
                                      std::span<const Visit> visits) {
  QUADRILLE_REQUIRE(!visits.empty(), "a barrier is not empty");
  const auto begin = static_cast<std::uint32_t>(visits_.size());
  visits_.insert(visits_.end(), visits.begin(), visits.end());
  const auto end = static_cast<std::uint32_t>(visits_.size());
  return add({Kind::barrier,
              agent,
              allowed,
              visits[0].vertex,
              {},
              visits.front().timestep,
              visits.back().timestep,
              begin,
              end});
}

bool ObstacleTable::hits(ObstacleId id, const Path& path, bool leaves) const {
  const Obstacle& o = (*this)[id];
  const auto end = static_cast<Timestep>(path.size()) - 1;
  const auto is_at = [&](VertexId v, Timestep t) {
    return (t <= end || !leaves) && position(path, t) == v;
  };
  switch (o.kind) {
    case Kind::point:
      return is_at(o.vertex, o.first);
    case Kind::edge: {
      if (o.first >= end) return false;
      const auto t = static_cast<std::size_t>(o.first);
      return (path[t] == o.vertex && path[t + 1] == o.to) ||
             (path[t] == o.to && path[t + 1] == o.vertex);
    }
    case Kind::range:
      if (path.back() == o.vertex && o.last >= end && (!leaves || o.first <= end)) return true;
      for (Timestep t = o.first; t <= std::min(o.last, end); ++t)
        if (path[static_cast<std::size_t>(t)] == o.vertex) return true;
      return false;
    case Kind::barrier:
      for (const Visit& visit : visits(o))
        if (is_at(visit.vertex, visit.timestep)) return true;
      return false;
    case Kind::end:
      return path.back() == o.vertex;
    case Kind::elsewhere:
      return path.back() != o.vertex;
  }
  return false;
}

Timestep ObstacleTable::last_block(const Obstacle& o, VertexId vertex) const {
  if (o.kind == Kind::edge) return -1;
  if (o.kind == Kind::elsewhere) return o.vertex == vertex ? -1 : kForever;
  if (o.kind != Kind::barrier) return o.vertex == vertex ? o.last : -1;
  Timestep last = -1;
  for (const Visit& visit : visits(o))
    if (visit.vertex == vertex) last = std::max(last, visit.timestep);
  return last;
}

}  // namespace quadrille::discrete
