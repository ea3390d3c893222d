// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "read/basics.hpp"
#include "read/instance.hpp"
#include "read/records.hpp"
#include "rules/table.hpp"

namespace quadrille_check {

/// Being in a place at some time from `first` to `last`, which can be kForever.
struct Visit {
  int place = 0, first = 0, last = 0;
};

/// What a variable says of a plan.
struct Variable {
  enum class Kind { does_not, costs_at_most, is_there, number_is_at_least };
  Kind kind = Kind::does_not;
  int agent = 0;
  Int number = 0;             ///< Of a cost, or of what a node is at least.
  std::vector<Visit> visits;  ///< does_not: make any of these; is_there: the one visit.
  bool is_edge = false;       ///< does_not: move between `from` and `to`, either way, at `time`.
  int from = 0, to = 0, time = 0;
  Int node = 0;
};

/// A number that each plan determines.
struct Node {
  enum class Kind { literal = 0, agent = 1, beyond = 2, sum = 3, levels = 4 };
  Kind kind = Kind::literal;
  Int of = 0;    ///< The literal, the agent, the node; of a sum its left part.
  Int base = 0;  ///< Of a sum its right part.
  Int rank = 0;  ///< Of levels.
  Ints levels;   ///< Nodes, each at most the one before.
};

/// All variables and nodes, in the order of the file: each is made of older ones.
class Meanings {
 public:
  explicit Meanings(const Instance& instance) : instance_(instance) {}  ///< Which outlives it.

  /// Records f, c, x, s and n. Throw Rejected.
  void add_variable(const Record& record);
  void add_node(const Record& record);

  /// Of the literal. Throws Rejected if it has no meaning.
  [[nodiscard]] const Variable& variable(Int lit) const { return variables_[lit]; }
  [[nodiscard]] const Node& node(Int number) const;
  [[nodiscard]] Int last_variable() const { return variables_.last(); }
  [[nodiscard]] Int num_nodes() const { return static_cast<Int>(nodes_.size()); }

  /// The largest k such that the literal, if true, implies that the node is at least k; 0: none.
  [[nodiscard]] Int implied(Int node, Int lit) const;
  /// Whether the one literal, if true, implies the other one: both say that an agent costs more, or
  /// that a number is at least so large.
  [[nodiscard]] bool implies(Int lit, Int other) const;
  /// Whether node a is at most node b in every plan: each literal that a counts implies one that b
  /// counts, another one each time, in the order of both. False if that is not known.
  [[nodiscard]] bool is_at_most(Int a, Int b) const;
  /// What a tree of sums adds up, in order. Throws Rejected if these are more than `most`.
  [[nodiscard]] Ints leaves(Int node, std::size_t most = kMostLeaves) const;

 private:
  static constexpr std::size_t kMostLeaves = 1'000'000;
  static constexpr int kDeepest = 5000;
  [[nodiscard]] Variable read_usage(std::span<const Int> values) const;
  [[nodiscard]] int agent(Int number) const;
  [[nodiscard]] int place(Int number) const;
  [[nodiscard]] static int time(Int number);

  const Instance& instance_;
  VariableTable<Variable> variables_;
  std::vector<Node> nodes_;
  mutable std::map<std::pair<Int, Int>, bool> at_most_;
  mutable int depth_ = 0;  // of is_at_most
};

}  // namespace quadrille_check
