// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/pebbles/board.hpp"

namespace quadrille::pebbles {

/// Its vertices in order.
using Cycle = std::vector<Local>;

/// Everybody on a cycle goes on to its next vertex, or back. Requires that no vertex is free.
void turn_once(const Cycle& cycle, bool forwards, Board& board);

/// Vertices that are all occupied, and the edges between them but for bridges of the component:
/// 2-edge-connected, with more than one cycle.
class FullBlock {
 public:
  FullBlock(const LocalGraph& graph, std::vector<Local> vertices);

  /// Who is where `goal` does not have them is put there. False: see rearrange_full_component.
  bool sort(const Board& goal, Board& board, LimitMonitor& limits, std::int64_t& effort);

 private:
  /// A rotation of one of the block's cycles.
  struct Turn {
    std::uint32_t cycle = 0;
    bool forwards = true;
    [[nodiscard]] Turn back() const { return {cycle, !forwards}; }
  };
  /// Two or three places. Of three with an exchange, who is at one goes to the next one, from the
  /// last to the first.
  struct Places {
    std::array<Local, 3> at{kNoLocal, kNoLocal, kNoLocal};
    std::size_t count = 2;
    [[nodiscard]] std::span<Local> used() { return std::span(at).first(count); }
    [[nodiscard]] std::span<const Local> used() const { return std::span(at).first(count); }
  };
  struct Exchange {
    Places places;
    std::vector<Turn> turns;
  };

  static constexpr std::uint32_t kUnreached = 0, kBase = UINT32_MAX;

  template <class Visit>
  void for_each_neighbour(Local v, const Visit& visit) const {
    for (const Local w : graph_.neighbours(v))
      if (index_[w] != kNoLocal && !graph_.is_bridge(v, w)) visit(w);
  }
  [[nodiscard]] std::optional<Cycle> cycle_through(Local a, Local b, Local without) const;
  std::uint32_t add_cycle(Cycle cycle);
  [[nodiscard]] std::optional<Cycle> find_ear(const Cycle& cycle) const;
  [[nodiscard]] bool find_base();
  [[nodiscard]] Exchange transposition_of(const Cycle& cycle, const Cycle& ear);
  [[nodiscard]] std::optional<Exchange> find_three_cycle() const;
  [[nodiscard]] bool is_odd(const Board& goal, const Board& board) const;

  [[nodiscard]] Local after(Turn turn, Local place) const;
  [[nodiscard]] std::size_t state_of(const Places& places) const;
  bool explore(LimitMonitor& limits, std::int64_t& effort);
  [[nodiscard]] bool has_reached(const Places& places) const {
    return reached_by_[state_of(places)] != kUnreached;
  }
  void exchange(Places places, Board& board, std::int64_t& effort) const;

  bool exchange_nearby(Local from, Local to, Board& board, LimitMonitor& limits,
                       std::int64_t& effort);
  [[nodiscard]] std::optional<FullBlock> theta_of(Local a, Local b, LimitMonitor& limits,
                                                  std::int64_t& effort) const;
  [[nodiscard]] std::vector<Local> way_beside(Local from, Local to) const;
  bool settle(Local v, std::size_t next, const Board& goal, Board& board, LimitMonitor& limits,
              std::int64_t& effort);

  const LocalGraph& graph_;
  const std::vector<Local> vertices_;
  std::vector<Local> index_;  // In vertices_, by vertex.
  std::vector<Cycle> cycles_;
  std::vector<std::vector<std::uint32_t>> cycles_at_;  // By index.
  bool has_base_ = false;
  Exchange base_;
  std::vector<std::uint32_t> reached_by_;  // By state: 2 * cycle + forwards + 1.
};

}  // namespace quadrille::pebbles
