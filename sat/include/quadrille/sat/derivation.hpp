// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// Hears how the SAT solver comes to its clauses. Clauses have numbers, each its own; literals are
/// DIMACS integers. Called on the solving thread, inside of the solver; must not call the engine.
class DerivationObserver {
 public:
  using Number = std::uint64_t;
  using Clause = std::span<const int>;

  virtual ~DerivationObserver() = default;
  /// The solver was given a clause, with the literals that Engine::add_clause or the theory named,
  /// in that order.
  virtual void on_given(Number number, Clause clause) = 0;
  /// It follows by unit propagation: if all its literals are false, `antecedents`, taken in their
  /// order, imply one literal after the other, and the last one is false.
  virtual void on_derived(Number number, Clause clause, std::span<const Number> antecedents) = 0;
  /// Likewise, for the negations of a verdict's core: they never become a clause of the solver. Of
  /// assumptions that contradict each other they are a literal and its negation.
  virtual void on_refuted(Number number, Clause clause, std::span<const Number> antecedents) = 0;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
