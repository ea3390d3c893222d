// SPDX-License-Identifier: MIT
// When a clause is true in every plan: the rules of docs/certificates.md, which proves them.
// Whether the answer "no" is right does not matter.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "read/instance.hpp"
#include "rules/meanings.hpp"

namespace quadrille_check {

using Clause = std::span<const Int>;

/// Rule 1: no walk of one agent makes all literals false.
class OneAgent {
 public:
  OneAgent(const Instance& instance, const Meanings& meanings, Distances& distances);
  [[nodiscard]] bool holds(int agent, Clause clause);

 private:
  /// What a walk that makes all literals false does.
  struct Task {
    Int most = kEndOfTime, more_than = -1;     // its cost: at most, more than
    std::vector<std::pair<int, int>> must_be;  // times and places, in order of time in the end
    int horizon = 0;                           // nothing is forbidden after it, but for ever
  };
  enum class Direction { forwards, backwards };

  void clear();
  /// False: no walk can do that.
  [[nodiscard]] bool collect(int agent, Clause clause, Task& task);
  void forbid(const Visit& visit);
  void forbid_move(int from, int to, int time);
  [[nodiscard]] bool is_forbidden(int place, int time) const;
  [[nodiscard]] bool is_move_forbidden(int from, int to, int time) const;
  [[nodiscard]] bool has_walk(int agent, Task& task);
  /// Whether a walk leads from a place and time to another one; `to` < 0: to any place then.
  /// `may_be(place, time)` is false only where no such walk comes.
  template <class MayBe>
  [[nodiscard]] bool leads(std::pair<int, int> from, std::pair<int, int> to, Direction direction,
                           const MayBe& may_be);

  const Instance& instance_;
  const Meanings& meanings_;
  Distances& distances_;
  struct Move {
    int to = 0, time = 0;
  };
  struct Ban {
    std::vector<Visit> visits;
    std::vector<Move> moves;
  };
  std::vector<Ban> bans_;    // [0] is none
  std::vector<int> ban_of_;  // by place: in bans_
  std::vector<int> banned_;  // places
  std::vector<int> seen_;    // by place: the number of the last layer that it was in
  int layer_ = 0;
};

/// Rule 2: two agents are in one place at one time, or use one edge at one time.
[[nodiscard]] bool is_same_place(const Meanings& meanings, Clause clause);
/// Rule 3: two agents swap places.
[[nodiscard]] bool is_swap(const Meanings& meanings, Clause clause);
/// Rule 4: two agents cross a rectangle, one from side to side, one from top to bottom, without
/// delay. Parameters: x0 y0 x1 y1 T a b.
[[nodiscard]] bool is_rectangle(const Instance& instance, const Meanings& meanings, Clause clause,
                                std::span<const Int> parameters);
/// Rule 5: two agents pass a corridor in opposite directions. Parameter: a place inside.
[[nodiscard]] bool is_corridor(const Instance& instance, const Meanings& meanings,
                               Distances& distances, Clause clause,
                               std::span<const Int> parameters);
/// Rule 6: parts of a sum imply the sum.
[[nodiscard]] bool is_sum(const Meanings& meanings, Clause clause);
/// Rule 7: a number implies one that is never smaller.
[[nodiscard]] bool is_order(const Meanings& meanings, Clause clause);

}  // namespace quadrille_check
