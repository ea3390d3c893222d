// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/pebbles/board.hpp"
#include "quadrille/pebbles/exchange.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::pebbles {

/// Leads the agents on a graph to their goals, in polynomial time: one after the other to a vertex
/// of its own, farthest from a root first; who is in its way makes room, or is exchanged with it.
/// The technique of Push and Swap (Luna and Bekris, "Push and swap: fast cooperative path-finding
/// with completeness guarantees", IJCAI 2011), complete for the rules with rotations:
/// docs/complete.md. Without them, a way is not always found where there is one.
class Settling {
 public:
  enum class State {
    working,  ///< `step` can go on.
    found,    ///< `shifts` lead all agents to their goals.
    given_up  ///< There is no way, or it is one of the exceptions of docs/complete.md.
  };

  /// `starts`, `goals`: by agent, all different.
  Settling(LocalGraph graph, std::vector<Local> starts, std::vector<Local> goals,
           Rotations rotations = Rotations::allowed);
  Settling(const Settling&) = delete;
  Settling& operator=(const Settling&) = delete;

  /// Settles one agent, or begins or ends; stops on the way when a limit is met. Requires
  /// State::working.
  State step(LimitMonitor& limits);
  [[nodiscard]] std::int64_t effort() const { return effort_ + exchanger_.effort(); }

  [[nodiscard]] const LocalGraph& graph() const noexcept { return graph_; }
  [[nodiscard]] const std::vector<Local>& starts() const noexcept { return starts_; }
  /// Without loops, once a way is found.
  [[nodiscard]] const std::vector<Shift>& shifts() const noexcept { return board_.shifts(); }

 private:
  void gather_goals();
  [[nodiscard]] std::vector<Local> way_to(Local from, Local to);
  bool settle(Local v, LimitMonitor& limits);
  State finish();
  void shorten_if_long();

  const LocalGraph graph_;
  const std::vector<Local> starts_;
  const Rotations rotations_;
  Board board_, goal_;
  Exchanger exchanger_;
  const Local num_free_;
  const std::vector<Local> order_;
  std::vector<Local> rank_;  // In the order.
  Local next_;               // Vertices of this rank and more are settled.
  bool has_begun_ = false;
  std::size_t long_;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::pebbles

QUADRILLE_API_END
