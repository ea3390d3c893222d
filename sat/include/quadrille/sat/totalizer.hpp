// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/sat/engine.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// Counts in unary: a balanced tree of adders over inputs that are unary numbers themselves, and
/// that may grow after the tree was built (Bailleux and Boufkhad 2003, CP; grown on demand as by
/// Martins et al. 2014, CP). Only the direction "inputs imply outputs" is encoded: enough to forbid
/// large sums.
class Totalizer {
 public:
  /// The literal "input number `input` is at least `k`", k >= 1. Must be the same literal each
  /// time, and true for k whenever it is true for k+1 (the engine must have those clauses).
  using Input = std::function<Lit(std::size_t input, int k)>;

  /// `engine` and what `input` refers to must outlive the totalizer. Adds no clause yet.
  Totalizer(Engine& engine, std::size_t num_inputs, Input input);

  [[nodiscard]] std::size_t num_inputs() const noexcept { return num_inputs_; }
  /// The number of this sum in the proof log of the engine; 0 if there is none.
  [[nodiscard]] int proof_number() const noexcept { return proof_number_; }
  /// A literal that is implied when the inputs' sum is at least `k`, k >= 1; assuming its negation
  /// bounds the sum. Invalid if the sum is never that large. Adds the clauses for all sums up to
  /// `k` that are missing: O(num_inputs * k^2) in all. Not during solve.
  [[nodiscard]] Lit at_least(int k);
  /// Ends its use, for good: makes all its literals true, which satisfies its clauses, so that they
  /// cost no time any more. What was learned of the inputs stays valid. Not during solve; must not
  /// be followed by `at_least`.
  void retire();

 private:
  struct Adder {
    std::size_t left, right;  // numbers of tree items; see output()
    std::vector<Lit> sums;    // [k-1]: at least k
  };
  [[nodiscard]] Lit output(std::size_t item, int k) const;
  void grow(std::size_t item, int k);
  void add(std::vector<Lit>& clause);

  Engine& engine_;
  Input input_;
  std::size_t num_inputs_;
  int proof_number_ = 0;
  // Tree items: 0 .. num_inputs-1 are the inputs, the others adders in an order in which children
  // come before parents. The last one is the root.
  std::vector<Adder> adders_;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
