// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "paths/agent_distances.hpp"
#include "paths/obstacles.hpp"

namespace quadrille::discrete {

/// The active obstacles of one agent, laid out by place for searches. Obstacles are known by their
/// *slot*: their index in the list that was loaded. Loading costs time in the obstacles, not in the
/// map.
class ObstacleMap {
 public:
  explicit ObstacleMap(std::size_t num_vertices) : heads_(num_vertices) {}

  /// Forgets what was loaded. `distances`: of the agent, who has to rest at one of its goals, or
  /// leaves there: then nothing that comes later forbids a goal.
  void load(const ObstacleTable& table, std::span<const ObstacleId> active,
            const AgentDistances& distances);

  /// Adds to what is loaded, and is there for that agent from now on. Requires that no obstacle is
  /// about ends (Obstacle::Kind::end, elsewhere). Goal blocks are in any order then. O(more).
  void extend(const ObstacleTable& table, std::span<const ObstacleId> more,
              const AgentDistances& distances);

  [[nodiscard]] std::size_t num_slots() const noexcept { return num_slots_; }
  /// No path around the obstacles that rests at a goal costs less; kForever: there is none.
  [[nodiscard]] Timestep least_cost() const noexcept { return least_cost_; }
  /// From when on this goal stays allowed, by rules too; kForever: never.
  [[nodiscard]] Timestep earliest_rest(VertexId goal) const {
    return earliest_rests_[goals_.is_single() ? 0 : index_of(goal)];
  }
  /// That a slot forbids to rest in a goal, from any timestep up to `last` on.
  struct GoalBlock {
    std::uint32_t slot;
    std::uint32_t goal;  ///< Its index in the set.
    Timestep last;
  };
  /// By increasing slot.
  [[nodiscard]] std::span<const GoalBlock> goal_blocks() const noexcept { return goal_blocks_; }

  /// Calls `tell(slot)` for each slot that forbids being in `v` at `t`.
  template <class Tell>
  void for_each_at(VertexId v, Timestep t, const Tell& tell) const {
    for_each_visit(v, [&](Timestep first, Timestep last, std::uint32_t slot) {
      if (first <= t && t <= last) tell(slot);
    });
  }
  /// Calls `tell(slot)` for each slot that forbids moving from `v` to `w` at `t`.
  template <class Tell>
  void for_each_on(VertexId v, VertexId w, Timestep t, const Tell& tell) const {
    for_each_move(v, w, [&](Timestep then, std::uint32_t slot) {
      if (then == t) tell(slot);
    });
  }

  /// Calls `tell(first, last, slot)` for each span of time in which a slot forbids being in `v`.
  template <class Tell>
  void for_each_visit(VertexId v, const Tell& tell) const {
    const Head& head = heads_[v];
    if (head.stamp != stamp_) return;
    for (int e = head.visits; e >= 0; e = entries_[static_cast<std::size_t>(e)].next) {
      const Entry& entry = entries_[static_cast<std::size_t>(e)];
      tell(entry.first, entry.last, entry.slot);
    }
  }
  /// Calls `tell(t, slot)` for each slot that forbids moving from `v` to `w` at some `t`.
  template <class Tell>
  void for_each_move(VertexId v, VertexId w, const Tell& tell) const {
    const Head& head = heads_[v];
    if (head.stamp != stamp_) return;
    for (int e = head.moves; e >= 0; e = entries_[static_cast<std::size_t>(e)].next) {
      const Entry& entry = entries_[static_cast<std::size_t>(e)];
      if (entry.to == w) tell(entry.first, entry.slot);
    }
  }

 private:
  struct Head {
    std::uint32_t stamp = 0;
    int visits = -1, moves = -1;  // first entries
  };
  struct Entry {
    Timestep first, last;
    VertexId to;  // of moves
    std::uint32_t slot;
    int next;
  };
  /// Forgets what was said about goals.
  void aim(const AgentDistances& distances);
  void add(const ObstacleTable& table, const Obstacle& o, std::uint32_t slot,
           const AgentDistances& distances);
  void find_least_cost(const AgentDistances& distances);
  Head& head(VertexId v);
  void add_visit(VertexId v, Timestep first, Timestep last, std::uint32_t slot);
  void add_move(VertexId v, VertexId w, Timestep t, std::uint32_t slot);
  void block_goal(VertexId v, Timestep last, std::uint32_t slot);
  /// Of a goal in the set.
  [[nodiscard]] std::size_t index_of(VertexId goal) const {
    const auto all = goals_.vertices();
    return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), goal) - all.begin());
  }

  std::uint32_t stamp_ = 0;
  IdVector<VertexId, Head> heads_;
  std::vector<Entry> entries_;
  std::size_t num_slots_ = 0;
  Goals goals_;
  std::vector<GoalBlock> goal_blocks_;
  std::vector<Timestep> earliest_rests_;  // by goal
  Timestep least_cost_ = 0;
};

}  // namespace quadrille::discrete
