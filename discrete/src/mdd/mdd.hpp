// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// The time-expanded graph of one agent, cut to what paths of bounded cost can use: its multi-value
/// decision diagram (MDD) for every bound at once (Sharon et al. 2013, AIJ, section 3).
///
/// With d the agent's distance and h(v) the distance from v to its goal, or to the nearest one of
/// several, the *slack* of (v, t) is
/// t + h(v) - d: a path through (v, t) arrives at d + slack or later. The MDD for delay K has the
/// pairs that are reachable from the start and have a slack of at most K. Layer K is what it has
/// more than the MDD for K-1: at most one timestep per vertex. Vertices are found as layers are
/// asked for. 8 bytes per vertex of the graph, and more for those found.
class Mdd {
 public:
  /// Requires a reachable goal. O(V + E).
  Mdd(const Graph& graph, const Agent& task);

  [[nodiscard]] const Agent& task() const noexcept { return task_; }
  /// O(log goals).
  [[nodiscard]] bool is_goal(VertexId v) const { return task_.goals.contains(v); }
  /// Cost of the cheapest path, d.
  [[nodiscard]] Timestep distance() const noexcept { return to_goal_[task_.start]; }
  /// h(v); kUnreachable if there is none.
  [[nodiscard]] Timestep to_goal(VertexId v) const { return to_goal_[v]; }

  /// Finds the vertices of all layers up to `slack` and returns how many layer `slack` has: those
  /// of rank 0 .. size-1. A vertex has the same rank in all layers that it is in. Linear in what is
  /// new.
  std::size_t reach(const Graph& graph, Timestep slack);
  [[nodiscard]] VertexId vertex(std::size_t rank) const { return found_[rank]; }
  /// Rank of a vertex; kNoRank if it is in no layer that was asked for.
  [[nodiscard]] std::uint32_t rank(VertexId v) const { return rank_[v]; }
  static constexpr std::uint32_t kNoRank = UINT32_MAX;

  /// Timestep of a vertex in layer `slack`.
  [[nodiscard]] Timestep timestep(VertexId v, Timestep slack) const {
    return distance() + slack - to_goal_[v];
  }
  /// Slack of (v, t); negative if (v, t) is not on any path. Requires a reachable v.
  [[nodiscard]] Timestep slack(VertexId v, Timestep t) const {
    return t + to_goal_[v] - distance();
  }

  /// The most that one step adds to the slack: 2, or more where edges lead one way.
  [[nodiscard]] Timestep largest_step() const noexcept { return largest_step_; }

 private:
  Agent task_;
  IdVector<VertexId, Timestep> to_goal_;
  IdVector<VertexId, std::uint32_t> rank_;
  std::vector<VertexId> found_;  // by smallest slack
  // Vertices to look at, by smallest slack known so far, with their distance from the start.
  std::vector<std::vector<std::pair<VertexId, Timestep>>> frontier_;
  Timestep reached_ = -1, largest_step_ = 2;
};

}  // namespace quadrille::discrete
