// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::execution {

/// Time of a plan: ticks in the continuous domain, timesteps in the discrete one; absolute.
using geometry::Ticks;

/// One move of one agent's path: from a vertex to another one. Waits are what lies between moves.
struct MoveId {
  AgentId agent;
  std::uint32_t move = 0;  ///< Counted from 0 along the path.
  friend auto operator<=>(const MoveId&, const MoveId&) = default;
};

/// What the plan says of a move.
struct TimedMove {
  VertexId from;
  VertexId to;
  Ticks begin = 0;
  Ticks end = 0;  ///< Later than `begin`.
  /// It ends where nobody may wait, and the next move begins then: both are one *passage*, which an
  /// agent does not begin before it may end it.
  bool goes_on = false;
  friend bool operator==(const TimedMove&, const TimedMove&) = default;
};

/// Two moves that collide at some times, and which of them goes first. The *clock* of an agent is
/// the time of the plan that it has got to; it stands while the agent is held up. The rule: until
/// the leader's clock has reached the end of its move, the follower's clock is at most
/// max(begin of its own move, the leader's clock + slack); once that allows it to end its move, it
/// is free. A follower whose move is one of a passage stays where that begins until it is free.
/// docs/execution.md proves that agents whose clocks obey this never collide.
struct Precedence {
  MoveId leader;
  MoveId follower;
  Ticks slack = 0;  ///< Not negative. Exact: one more, and the two moves can collide.
  friend bool operator==(const Precedence&, const Precedence&) = default;
};

/// The order in which the agents of a plan pass the places that they share, whatever delays them.
struct Precedences {
  Ticks now = 0;  ///< When the plan begins, with all clocks at this time.
  IdVector<AgentId, std::vector<TimedMove>> moves;  ///< In order; empty for an agent that stays.
  /// By follower, then leader; each pair of moves at most once, and of two leading moves of one
  /// agent for the same follower only those that the other one does not imply.
  std::vector<Precedence> list;

  [[nodiscard]] std::size_t num_agents() const noexcept { return moves.size(); }
  /// Requires a move of the plan.
  [[nodiscard]] const TimedMove& at(const MoveId& id) const { return moves[id.agent][id.move]; }
  /// The first move of the passage that the move is in; without one the move itself. Linear in the
  /// moves of the passage.
  [[nodiscard]] MoveId entry(MoveId id) const {
    while (id.move > 0 && moves[id.agent][id.move - 1].goes_on) --id.move;
    return id;
  }
  /// Whether the move is one of several of a passage.
  [[nodiscard]] bool is_in_passage(const MoveId& id) const {
    return at(id).goes_on || entry(id) != id;
  }
  /// When the agent ends its last move; `now` if it has none.
  [[nodiscard]] Ticks end(AgentId agent) const {
    return moves[agent].empty() ? now : moves[agent].back().end;
  }
  /// Whether the follower may begin its move, or its passage, in the plan before the leader has
  /// ended its own move.
  [[nodiscard]] bool overlaps(const Precedence& precedence) const {
    return at(entry(precedence.follower)).begin < at(precedence.leader).end;
  }
  friend bool operator==(const Precedences&, const Precedences&) = default;
};

/// Of a plan on a roadmap. The slack of two moves is what is left between their offset in the plan
/// and the nearest offset at which they collide (geometry::BodyPair::unsafe_offsets). Errors:
/// invalid_plan, with the first violation, if `verify` finds any, or if agents would wait for each
/// other for ever in front of vertices where nobody may wait, which are named; invalid_instance if
/// there are moving obstacles, which wait for nobody, or agents that overlap at their starts.
/// Releases and deadlines are not looked at. Time: quadratic in the number of different moves near
/// each other, and in how often each is made.
[[nodiscard]] Result<Precedences> precedences(const continuous::Instance& instance,
                                              const continuous::Plan& plan);

/// Of a plan with timesteps: each agent that comes to a vertex follows the one that left it last,
/// or that vanished there. Releases and deadlines are not looked at. What else could collide, swaps
/// and earlier visitors, follows from these. Clocks are whole timesteps, and in one timestep all
/// moves are made at the same time, so that agents may follow each other in a circle. Errors:
/// invalid_plan, out_of_range (blockages, robust plans). O(size of the plan * log).
[[nodiscard]] Result<Precedences> precedences(const discrete::Instance& instance,
                                              const discrete::Plan& plan);

}  // namespace quadrille::execution

QUADRILLE_API_END
