// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/execution/precedences.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::execution {

/// What becomes of a plan where moves are released as a whole: a follower begins its move after the
/// leader has *ended* its own (VDA 5050, checkpoints of Open-RMF, Executor::gate), and a passage
/// (TimedMove::goes_on) after all that lead one of its moves.
struct NodeOrder {
  /// Moves on a cycle, each of which has to wait for the end of the one before it, the first one
  /// for the last one: no order of whole moves keeps to the plan, and the agents concerned wait for
  /// ever. As short as any through its first move. Empty: the order has no cycle, and all agents
  /// arrive.
  std::vector<MoveId> cycle;
  /// Groups of moves that wait for each other in circles.
  std::size_t num_knots = 0;
  /// Moves in them.
  std::size_t num_knotted_moves = 0;
  /// Precedences whose moves overlap in time in the plan: what it costs to release whole moves.
  std::size_t num_overlaps = 0;

  [[nodiscard]] bool acyclic() const noexcept { return cycle.empty(); }
};

/// Time: that of the graph, moves + precedences, and for the cycle as much for each move of the
/// smallest knot, but at most 64 of them.
[[nodiscard]] NodeOrder node_order(const Precedences& precedences);

}  // namespace quadrille::execution

QUADRILLE_API_END
