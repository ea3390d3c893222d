// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/execution/precedences.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::execution {

/// For systems that release whole moves, such as VDA 5050 with its base and horizon: which moves of
/// each agent may be released, given how many of its moves each agent has ended. Once released, a
/// move stays so, and the moves of a passage are released together. As long as agents make no move
/// before it is released, they do not collide; all arrive if the order of whole moves has no cycle:
/// look at `cycle` before robots set out.
class Releaser {
 public:
  /// Time: that of node_order (node_order.hpp).
  explicit Releaser(const Precedences& order);

  /// Moves that are never released, because each has to wait for the end of the one before it, the
  /// first one for the last one: whoever has one of them to make stops there for ever, and so does
  /// who waits for them. NodeOrder::cycle; empty if all arrive.
  [[nodiscard]] const std::vector<MoveId>& cycle() const noexcept { return cycle_; }

  /// How many moves of the agent, from the first on, are released.
  [[nodiscard]] std::uint32_t released(AgentId agent) const { return released_[agent]; }
  /// The first `count` moves of the agent have ended. Never goes back; at most as many as were
  /// released (what an agent did without release may have collided, and is refused).
  void end_moves(AgentId agent, std::uint32_t count);
  /// The agents that got moves released since the last call, by id. Time of all calls together:
  /// moves + precedences.
  [[nodiscard]] std::vector<AgentId> take_news();

 private:
  struct Gate {
    AgentId leader;
    std::uint32_t needed = 0;  ///< So many moves of the leader have to have ended.
  };
  /// Releases what can be released now.
  void advance(AgentId agent);

  IdVector<AgentId, std::vector<std::vector<Gate>>> gates_;  // By move.
  IdVector<AgentId, std::vector<AgentId>> followers_;        // Of each agent, each once.
  IdVector<AgentId, std::uint32_t> released_, ended_;
  IdVector<AgentId, bool> is_news_;
  std::vector<MoveId> cycle_;
};

}  // namespace quadrille::execution

QUADRILLE_API_END
