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
  aim(distances);
  for (std::uint32_t slot = 0; slot < active.size(); ++slot)
    add(table, table[active[slot]], slot, distances);
  find_least_cost(distances);
}

void ObstacleMap::extend(const ObstacleTable& table, std::span<const ObstacleId> more,
                         const AgentDistances& distances) {
  aim(distances);
  if (!distances.leaves())
    for (const VertexId goal : goals_.vertices())
      for_each_visit(
          goal, [&](Timestep, Timestep last, std::uint32_t slot) { block_goal(goal, last, slot); });
  for (const ObstacleId id : more)
    add(table, table[id], static_cast<std::uint32_t>(num_slots_++), distances);
  find_least_cost(distances);
}

void ObstacleMap::aim(const AgentDistances& distances) {
  goals_ = distances.goals();
  goal_blocks_.clear();
  earliest_rests_.clear();
  for (const VertexId goal : goals_.vertices())
    earliest_rests_.push_back(distances.may_rest_from(goal));
}

void ObstacleMap::add(const ObstacleTable& table, const Obstacle& o, std::uint32_t slot,
                      const AgentDistances& distances) {
  const auto block_goal = [&](VertexId v, Timestep last) {
    if (!distances.leaves()) this->block_goal(v, last, slot);
  };
  if (o.kind == Obstacle::Kind::edge) {
    add_move(o.vertex, o.to, o.first, slot);
    add_move(o.to, o.vertex, o.first, slot);
  } else if (o.kind == Obstacle::Kind::barrier) {
    for (const Visit& visit : table.visits(o)) {
      add_visit(visit.vertex, visit.timestep, visit.timestep, slot);
      block_goal(visit.vertex, visit.timestep);
    }
  } else if (o.kind == Obstacle::Kind::elsewhere) {
    for (const VertexId goal : goals_.vertices())
      if (goal != o.vertex) block_goal(goal, kForever);
  } else {
    if (o.kind != Obstacle::Kind::end) add_visit(o.vertex, o.first, o.last, slot);
    block_goal(o.vertex, o.last);
  }
}

void ObstacleMap::find_least_cost(const AgentDistances& distances) {
  const auto all = goals_.vertices();
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
