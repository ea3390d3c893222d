// SPDX-License-Identifier: MIT
#include "paths/obstacle_map.hpp"

#include <algorithm>

namespace quadrille::discrete {

void ObstacleMap::load(const ObstacleTable& table, std::span<const ObstacleId> active,
                       const AgentDistances& distances) {
  if (++stamp_ == 0) {  // after 2^32 loads: all stamps are stale
    heads_.assign(heads_.size(), {});
    stamp_ = 1;
  }
  entries_.clear();
  num_slots_ = active.size();
  goals_ = distances.goals();
  goal_blocks_.clear();
  const auto all = goals_.vertices();
  earliest_rests_.clear();
  for (const VertexId goal : all) earliest_rests_.push_back(distances.may_rest_from(goal));
  const auto block_goal = [&](VertexId v, Timestep last, std::uint32_t slot) {
    if (!distances.leaves()) this->block_goal(v, last, slot);
  };
  for (std::uint32_t slot = 0; slot < active.size(); ++slot) {
    const ObstacleId id = active[slot];
    const Obstacle& o = table[id];
    if (o.kind == Obstacle::Kind::edge) {
      add_move(o.vertex, o.to, o.first, slot);
      add_move(o.to, o.vertex, o.first, slot);
    } else if (o.kind == Obstacle::Kind::barrier) {
      for (const Visit& visit : table.visits(o)) {
        add_visit(visit.vertex, visit.timestep, visit.timestep, slot);
        block_goal(visit.vertex, visit.timestep, slot);
      }
    } else if (o.kind == Obstacle::Kind::elsewhere) {
      for (const VertexId goal : all)
        if (goal != o.vertex) block_goal(goal, kForever, slot);
    } else {
      if (o.kind != Obstacle::Kind::end) add_visit(o.vertex, o.first, o.last, slot);
      block_goal(o.vertex, o.last, slot);
    }
  }
  least_cost_ = kForever;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (earliest_rests_[k] != kForever)
      least_cost_ = std::min(least_cost_, earliest_rests_[k] + distances.price(all[k]));
}

void ObstacleMap::block_goal(VertexId v, Timestep last, std::uint32_t slot) {
  if (!goals_.contains(v)) return;
  const std::size_t goal = index_of(v);
  goal_blocks_.push_back({slot, static_cast<std::uint32_t>(goal), last});
  earliest_rests_[goal] = std::max(earliest_rests_[goal], last == kForever ? kForever : last + 1);
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
