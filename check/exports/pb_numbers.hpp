// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "read/basics.hpp"
#include "rules/meanings.hpp"

namespace quadrille_check {

/// A sum of constraints, in reverse Polish notation.
class PbSum {
 public:
  PbSum& add(Int constraint, Int factor = 1);
  /// That the literal is at least 0.
  PbSum& add_literal(Int lit);
  /// To both a clause that has a literal and one that has its negation.
  PbSum& resolve(Int clause);
  PbSum& divide(Int by);
  /// What has a degree of 1 or more: at least one of its literals is true.
  PbSum& as_clause();
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  PbSum& push(const std::string& operand);
  std::string text_;
};

/// A pseudo-Boolean formula and its refutation: constraints by their numbers, those of the formula
/// first. Literals are those of the certificate, and new ones.
class PbProof {
 public:
  explicit PbProof(Int num_variables) : num_variables_(num_variables) {}
  [[nodiscard]] Int new_variable() { return ++num_variables_; }

  /// Of the formula: the sum of the literals is at least `degree`. Before all steps.
  Int given(std::span<const Int> literals, Int degree);
  Int derive(const PbSum& sum);
  /// The variable's new meaning, by two constraints with numbers one after the other: it is true if
  /// and only if at least `k` >= 1 of the literals are. Gives the number of "only if", the second.
  /// The first one is not made if k is more than there are literals.
  Int define(Int variable, std::span<const Int> literals, Int k);

  [[nodiscard]] std::string formula() const;
  [[nodiscard]] std::string refutation(Int contradiction) const;

 private:
  void put(std::string& text, Int factor, Int lit);
  void put(std::string& text, std::span<const Int> literals, Int sign);

  std::string formula_, steps_;
  Int num_variables_, num_given_ = 0, num_constraints_ = 0;
  std::size_t num_terms_ = 0;
};

/// The numbers of a certificate as sums of literals: "costs more than k" for each k from the base
/// on, "is at least c" likewise. Literals of sums get their meaning in the proof.
class PbNumbers {
 public:
  PbNumbers(const Meanings& meanings, PbProof& proof) : meanings_(meanings), proof_(proof) {}

  /// A record c, s or n.
  void note(const Record& record);
  /// That for the agent all costs from `least` to the largest one have literals.
  void fill(Int agent, Int least);
  /// To be called after all that: puts the order of costs into the formula.
  void give_orders();

  /// Of literals that mean the same, one.
  [[nodiscard]] Int same(Int lit) const;
  [[nodiscard]] Int costs_more(Int agent, Int cost) const { return -costs_.at(agent).at(cost); }
  /// Of a literal that a number is at least so large: its node, and how large.
  [[nodiscard]] std::pair<Int, Int> meaning(Int lit) const { return meant_.at(lit); }
  /// "The node is at least k".
  [[nodiscard]] Int at_least(Int node, Int k);
  [[nodiscard]] const Ints& terms(Int node);
  /// The constraint: k, or no such literal, or so many of the terms.
  [[nodiscard]] Int only_if(Int node, Int k);

  /// Adds: if the literal is true, the sum of the node's terms is as large as it says. 0: no
  /// literal, so that it is at least 0.
  void add_implied(PbSum& sum, Int node, Int lit);
  /// Adds: if so many of the terms are true, the literal "the node is at least k" is. False: it
  /// never is, because there are not so many.
  bool add_if(PbSum& sum, Int node, Int k);
  /// The clause that one literal implies another one, which Meanings::implies.
  [[nodiscard]] Int implication(Int lit, Int other);

 private:
  struct Definition {
    Int variable = 0, only_if = 0;
  };
  const Definition& definition(Int node, Int k);
  [[nodiscard]] Int order_of_costs(Int lit, Int other);
  [[nodiscard]] Int order_of_numbers(Int lit, Int other);

  const Meanings& meanings_;
  PbProof& proof_;
  std::map<Int, std::map<Int, Int>> costs_;     // variables, by agent and cost
  std::map<std::pair<Int, Int>, Int> numbers_;  // variables, by node and k
  std::map<Int, std::pair<Int, Int>> meant_;    // by variable: the keys of both
  std::map<Int, Int> fills_, largest_, same_;   // least cost by agent; k by node; by variable
  std::map<std::pair<Int, Int>, Definition> definitions_;
  std::map<std::pair<Int, Int>, Int> implications_;
  std::map<Int, Ints> terms_;
};

}  // namespace quadrille_check
