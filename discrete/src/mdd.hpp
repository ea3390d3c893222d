// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// The time-expanded graph of one agent, cut to what paths of bounded cost can use: its multi-value
/// decision diagram (MDD) for every bound at once (Sharon et al. 2013, AIJ, section 3).
///
/// With d the agent's distance and h(v) the distance from v to its goal, the *slack* of (v, t) is
/// t + h(v) - d: a path through (v, t) arrives at d + slack or later. The MDD for delay K has the
/// pairs that are reachable from the start and have a slack of at most K. Layer K is what it has
/// more than the MDD for K-1: at most one timestep per vertex. Immutable; O(V) memory.
class Mdd {
 public:
  /// Requires a reachable goal. O(V + E + V log V).
  Mdd(const Graph& graph, const Task& task);

  [[nodiscard]] const Task& task() const noexcept { return task_; }
  /// Cost of the cheapest path, d.
  [[nodiscard]] Timestep distance() const noexcept { return to_goal_[task_.start]; }
  /// h(v); kUnreachable if there is none.
  [[nodiscard]] Timestep to_goal(VertexId v) const { return to_goal_[v]; }
  /// Number of vertices in layer `slack`, which are those of rank 0 .. size-1: every vertex has the
  /// same rank in all layers that it is in.
  [[nodiscard]] std::size_t layer_size(Timestep slack) const;
  [[nodiscard]] VertexId vertex(std::size_t rank) const { return by_detour_[rank]; }
  /// Rank of a vertex; SIZE_MAX if it is in no layer.
  [[nodiscard]] std::size_t rank(VertexId v) const { return rank_[v]; }
  /// Timestep of a vertex in layer `slack`.
  [[nodiscard]] Timestep timestep(VertexId v, Timestep slack) const {
    return distance() + slack - to_goal_[v];
  }
  /// Slack of (v, t); negative if (v, t) is not on any path. Requires a reachable v.
  [[nodiscard]] Timestep slack(VertexId v, Timestep t) const {
    return t + to_goal_[v] - distance();
  }

 private:
  Task task_;
  IdVector<VertexId, Timestep> to_goal_;
  std::vector<VertexId> by_detour_;  // by smallest slack, then by id
  std::vector<Timestep> detours_;    // of by_detour_, increasing
  IdVector<VertexId, std::size_t> rank_;
};

}  // namespace quadrille::discrete
