// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/pebbles/board.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::pebbles {

/// Whether all agents of a full cycle may go on by one vertex at the same time.
enum class Rotations { allowed, forbidden };

/// Frees vertices and exchanges neighbours on a board, everybody else in the end where they were.
/// docs/complete.md has the proofs that with rotations it finds a way where there is one.
class Exchanger {
 public:
  /// Both outlive the object.
  Exchanger(const LocalGraph& graph, Board& board, Rotations rotations = Rotations::allowed);

  /// A set of vertices, by a mark for each: to be emptied often.
  class Marks {
   public:
    explicit Marks(std::size_t size) : mark_(size, 0) {}
    void clear() { ++now_; }
    void add(Local v) { mark_[v] = now_; }
    [[nodiscard]] bool has(Local v) const { return mark_[v] == now_; }

   private:
    std::vector<std::uint32_t> mark_;
    std::uint32_t now_ = 1;
  };

  /// Frees a vertex by moves into the nearest vertex that is free and not in `kept`; agents go past
  /// free vertices of `kept`, and nobody enters or leaves one of `blocked`. `rank`: only vertices
  /// whose rank is below `end`; empty: all. False, and nothing is moved, if that is impossible.
  /// O(E).
  bool free(Local v, std::span<const Local> blocked, const Marks* kept,
            std::span<const Local> rank = {}, Local end = 0);

  /// Exchanges two agents that are neighbours. False, and nothing is changed, if no way was found.
  /// Requires a free vertex and a vertex with three neighbours.
  bool exchange(Local a, Local b);

  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  bool exchange_behind(Local lead, Local rear);
  bool exchange_at_fork(Local lead, Local rear);
  bool exchange_at_block(Local lead, Local rear, std::size_t first);
  bool exchange_down(Local lead, Local rear, Local next, std::size_t first);
  void swap_at_fork(Local lead, Local rear, Local side, Local other_side);
  bool exchange_on_cycle(Local a, Local b);
  bool free_beside_cycle(const std::vector<Local>& cycle, Local& exit, Local& outside);
  [[nodiscard]] std::optional<Local> nearest_free_outside(const std::vector<Local>& cycle);
  bool free_on_cycle(const std::vector<Local>& cycle, std::span<const Local> blocked);
  bool turn_into_cycle(Local next, Local door, Local rear);
  void turn(const std::vector<Local>& cycle, bool forwards);
  void turn_until(const std::vector<Local>& cycle, std::size_t from, std::size_t to);
  [[nodiscard]] std::vector<Local> cycle_through(Local a, Local b);
  void shift_along(Local from_free);

  const LocalGraph& graph_;
  Board& board_;
  const Rotations rotations_;
  Marks kept_, seen_, on_cycle_;
  std::vector<Local> parent_, queue_;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::pebbles

QUADRILLE_API_END
