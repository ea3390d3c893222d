// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "quadrille/sat/totalizer.hpp"

namespace quadrille::sat {

/// Of some unary numbers, of which one is known to reach `height`, what the others come to up to
/// there: the second largest of them, the third largest, and so on. With the largest, which counts
/// `height`, these add up to the sum of all numbers, none counted for more than `height`.
///
/// For each level that is asked for there is one counter over the numbers that reach it.
class CoreCounter {
 public:
  /// The literals "the number is at least `level`", those of all numbers that ever are: at most
  /// those of the level below, in the same order.
  using Level = std::function<std::vector<Lit>(int level)>;

  /// `engine` and what `level` refers to outlive the counter. Adds no clause yet.
  CoreCounter(Engine& engine, int height, Level level);

  /// A literal that is implied when `count` numbers are at least `level`, 1 <= level. Invalid if
  /// the counter does not reach so far. Not during solve.
  [[nodiscard]] Lit at_least(int level, int count);
  /// The number of this counter in the proof log of the engine; 0 if there is none.
  [[nodiscard]] int proof_number() const noexcept { return proof_number_; }
  /// As Totalizer::retire.
  void retire();

 private:
  [[nodiscard]] Totalizer& counter(int level);

  Engine& engine_;
  const int height_;
  int proof_number_ = 0;
  Level level_;
  std::vector<Totalizer> counters_;  // by level - 1
  std::map<int, int> reached_;       // by count: levels whose literals are there, in order
};

}  // namespace quadrille::sat
