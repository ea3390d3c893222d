// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/pebbles/board.hpp"
#include "quadrille/pebbles/exchange.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::pebbles {

/// Moves many agents at once, while one after the other is settled. What it does proves nothing:
/// nobody is sure to arrive.
class Crowd {
 public:
  virtual ~Crowd() = default;
  /// One timestep. The first `num_settled` agents of the order are at their places, and stay there.
  virtual void advance(Board& board, std::size_t num_settled) = 0;
  /// Of an agent to its place, as if it were alone.
  [[nodiscard]] virtual Local distance(Local agent, Local from) const = 0;
  [[nodiscard]] virtual std::int64_t effort() const = 0;
};
/// Null when a limit was met. `places`: by agent. `order`: all agents, those who are settled first
/// come first.
using MakeCrowd = std::function<std::unique_ptr<Crowd>(
    std::span<const Local> places, std::span<const Local> order, LimitMonitor& limits)>;

/// Leads the agents on a graph to their goals, in polynomial time: one after the other to a vertex
/// of its own, farthest from a root first; who is in its way makes room, or is exchanged with it.
/// All the others may move on at the same time, see Crowd.
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
           Rotations rotations = Rotations::allowed, MakeCrowd make_crowd = {});
  Settling(const Settling&) = delete;
  Settling& operator=(const Settling&) = delete;

  /// Settles one agent or lets all move on, or begins or ends; stops on the way when a limit is
  /// met. Requires State::working.
  State step(LimitMonitor& limits);
  [[nodiscard]] std::int64_t effort() const {
    return effort_ + exchanger_.effort() + (crowd_ ? crowd_->effort() : 0);
  }

  [[nodiscard]] const LocalGraph& graph() const noexcept { return graph_; }
  [[nodiscard]] const std::vector<Local>& starts() const noexcept { return starts_; }
  /// Without loops, once a way is found.
  [[nodiscard]] const std::vector<Shift>& shifts() const noexcept { return board_.shifts(); }

 private:
  void gather_goals();
  [[nodiscard]] std::vector<Local> way_to(Local from, Local to);
  void begin_crowd(LimitMonitor& limits);
  [[nodiscard]] bool is_crowd_of_use();
  void watch();
  void pass_settled();
  bool settle(Local v, int most_steps, LimitMonitor& limits);
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
  MakeCrowd make_crowd_;
  std::unique_ptr<Crowd> crowd_;
  // Of the crowd, with the agent that is to be settled next.
  int num_idle_ = 0;  // Timesteps since it was as near as never before.
  int num_helps_ = 0;
  Local least_distance_ = kNoLocal;
  std::size_t long_;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::pebbles

QUADRILLE_API_END
