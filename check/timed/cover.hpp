// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "rules/clauses.hpp"
#include "timed/rules.hpp"

namespace quadrille_check {

/// What all plans that count cost at least in sum, by trees over cores.
class Cover {
 public:
  /// All outlive it.
  Cover(const Clauses& clauses, const TimedMeanings& meanings, const std::vector<Int>& free_costs)
      : clauses_(clauses), meanings_(meanings), free_costs_(free_costs) {}

  /// bound fraction nodes: 1 agent cost, then what is below and what is not; or 0 n, then n times a
  /// clause and its multiplier. Throws Rejected if no such bound follows.
  void add(std::span<const Int> tree);
  /// Beyond what agents cost at least when each is alone.
  [[nodiscard]] Int bound() const { return bound_; }

 private:
  struct Range {
    Int low = 0, high = kNever;
  };
  [[nodiscard]] Range& range(int agent);
  void check_leaf(std::span<const Int> multipliers, Int bound, Int fraction);

  const Clauses& clauses_;
  const TimedMeanings& meanings_;
  const std::vector<Int>& free_costs_;
  std::map<int, Range> ranges_;  // of the agents that the tree at work is about
  std::set<int> counted_;        // of trees before
  Int bound_ = 0;
};

}  // namespace quadrille_check
