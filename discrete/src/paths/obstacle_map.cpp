// SPDX-License-Identifier: MIT
#include "paths/obstacle_map.hpp"

#include <algorithm>

namespace quadrille::discrete {

void ObstacleMap::load(const ObstacleTable& table, std::span<const ObstacleId> active,
                       VertexId goal) {
  if (++stamp_ == 0) {  // after 2^32 loads: all stamps are stale
    heads_.assign(heads_.size(), {});
    stamp_ = 1;
  }
  entries_.clear();
  last_at_goal_.clear();
  earliest_rest_ = 0;
  for (const ObstacleId id : active) {
    const auto slot = static_cast<std::uint32_t>(last_at_goal_.size());
    const Obstacle& o = table[id];
    if (o.kind == Obstacle::Kind::edge) {
      add_move(o.vertex, o.to, o.first, slot);
      add_move(o.to, o.vertex, o.first, slot);
    } else if (o.kind == Obstacle::Kind::barrier) {
      for (const Visit& visit : table.visits(o))
        add_visit(visit.vertex, visit.timestep, visit.timestep, slot);
    } else {
      add_visit(o.vertex, o.first, o.last, slot);
    }
    const Timestep last = table.last_block(o, goal);
    last_at_goal_.push_back(last);
    earliest_rest_ = std::max(earliest_rest_, last == kForever ? kForever : last + 1);
  }
}

ObstacleMap::Head& ObstacleMap::head(VertexId v) {
  Head& head = heads_[v];
  if (head.stamp != stamp_) head = {stamp_, -1, -1};
  return head;
}

void ObstacleMap::add_visit(VertexId v, Timestep first, Timestep last, std::uint32_t slot) {
  Head& at = head(v);
  entries_.push_back({first, last, {}, slot, at.visits});
  at.visits = static_cast<int>(entries_.size()) - 1;
}

void ObstacleMap::add_move(VertexId v, VertexId w, Timestep t, std::uint32_t slot) {
  Head& at = head(v);
  entries_.push_back({t, t, w, slot, at.moves});
  at.moves = static_cast<int>(entries_.size()) - 1;
}

}  // namespace quadrille::discrete
