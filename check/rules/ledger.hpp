// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "read/basics.hpp"
#include "read/instance.hpp"
#include "rules/meanings.hpp"

namespace quadrille_check {

/// What plans cost at least, and what some of them cost beyond that.
///
/// A unit is something that costs one if it is true in a plan: "agent i costs more than k", k at
/// least its free cost d_i, and "the sum N is at least c", c = 2 .. m, for a sum of m literals that
/// a core step has opened. For every plan P at all times: P costs `lower()` or more, and one more
/// for each open unit that is true in P.
class Ledger {
 public:
  /// Both outlive it. An agent without a way to its goal costs kFar, as good as any number.
  Ledger(const Instance& instance, const Meanings& meanings);

  /// The clause, which is true in all plans, is one of open units: at least one is true, and as
  /// many as 1, and one for "2 or more are", ..., "all are". Closes them, opens the latter if
  /// `node` is the sum of the clause's literals (-1: it gives them up), and raises the bound by
  /// one. Throws Rejected.
  void pay(const std::vector<Int>& clause, Int node);
  /// `node` is a sum of numbers that open units make up, each counted once: plans cost that much
  /// beyond the bound as it is now. Throws Rejected.
  void count_excess(Int node);
  /// What every plan costs at least by a clause that is true in all of them; by the units alone if
  /// there is none. Throws Rejected if it bounds nothing.
  [[nodiscard]] Int bound(const std::optional<std::vector<Int>>& clause, bool is_makespan) const;

  [[nodiscard]] Int lower() const { return lower_; }
  /// What plans cost by which the excess is more, if it was counted.
  [[nodiscard]] Int excess_base() const { return excess_base_; }
  /// What agents cost at least when each is alone.
  [[nodiscard]] Int free_cost(int agent) const {
    return free_costs_[static_cast<std::size_t>(agent)];
  }
  [[nodiscard]] Int free_sum() const { return free_sum_; }
  [[nodiscard]] Int free_makespan() const { return free_makespan_; }

 private:
  using Unit = std::pair<Int, Int>;  // agent and cost, or node and number
  void close(Int lit);
  void open(Int node, const std::vector<Int>& literals);
  void take(Int node, Int number, std::set<Unit>& taken) const;
  void take_leaf(const Node& leaf, std::set<Unit>& taken, std::set<Int>& agents) const;
  [[nodiscard]] Int bound_of(Int lit, bool is_makespan) const;
  [[nodiscard]] bool is_sum_of_delays(Int node) const;

  const Meanings& meanings_;
  std::vector<Int> free_costs_;
  Int free_sum_ = 0, free_makespan_ = 0;
  Int lower_ = 0;
  std::set<Unit> closed_costs_, closed_numbers_;
  std::map<Int, Int> opened_;  // by node: of how many literals
  std::optional<Int> excess_;
  Int excess_base_ = 0;
};

}  // namespace quadrille_check
