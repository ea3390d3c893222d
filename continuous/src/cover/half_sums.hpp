// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cover/core_table.hpp"

namespace quadrille::continuous {

/// "At least `least` of these levels are reached." Increasing; an agent may have several, and one
/// level may be listed more than once: then it counts as often. A core is a sum with distinct
/// agents of which at least one level is reached.
struct LevelSum {
  std::vector<Level> levels;
  int least = 1;
  friend auto operator<=>(const LevelSum&, const LevelSum&) = default;
};

/// Sums that follow from others, and that a fractional cover does not satisfy: the zero-half cuts
/// of three of them (Caprara and Fischetti, "{0,1/2}-Chvatal-Gomory cuts", Mathematical Programming
/// 1996).
///
/// Why they hold: let an agent reach h of its levels in the three, counted as often as they are
/// listed. All h together are at least the sum n of the three `least`. So the h/2, each rounded up
/// to an integer, are together at least n/2, rounded up too. And h/2 rounded up is the number of
/// levels reached among the agent's first, third, fifth, ... in increasing order, since whoever
/// reaches a level reaches those below. With n odd something is gained.
class HalfSums {
 public:
  /// A sum, as numbers of its levels in `parts`, and how much of each level is reached. What the
  /// spans are of outlives the object.
  struct Summand {
    std::span<const std::uint32_t> rows;
    int least = 1;
  };
  HalfSums(std::span<const Level> levels, std::span<const double> parts);

  /// Of a summand whose parts are all 0 or 1, or more than 1 too large, nothing follows.
  void add(const Summand& summand);
  /// Those that are violated by more than 0.2, the most violated ones first, at most `most`, none
  /// twice. None is missed of the 60 summands with the least excess, if each lists an agent once.
  /// n^3 steps for n of them, less as a rule.
  [[nodiscard]] std::vector<LevelSum> find(std::size_t most);
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  struct Term {
    AgentId agent;
    double part;
  };
  struct Line {
    Summand summand;
    std::vector<Term> terms;  // by agent, then by falling part; none where it is 0
    double excess = 0;        // what the parts add up to more than `least`
  };
  struct Found {
    double violation;
    std::size_t a, b, c;  // lines; b twice if there are two
  };
  [[nodiscard]] double saved(const Line& a, const Line& b);
  void merge(const Line& a, const Line& b);
  void look(std::size_t a, std::size_t b, std::vector<Found>& found);
  [[nodiscard]] double common(std::size_t a, std::size_t b) const {
    return common_[a * lines_.size() + b];
  }
  [[nodiscard]] LevelSum sum_of(const Found& found) const;

  std::span<const Level> levels_;
  std::span<const double> parts_;
  std::vector<Line> lines_;
  std::vector<double> common_;  // by two lines: what rounding their sum saves
  Line merged_;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::continuous
