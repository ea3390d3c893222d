// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/sat/lemma.hpp"
#include "quadrille/sat/lit.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// How much a theory is asked to find.
enum class Extent {
  partial,  ///< Some literals are assigned; any lemma is welcome, none is owed.
  full,     ///< Every literal is assigned: silence claims that the assignment obeys the theory.
};

/// What a theory may ask and say while it is being called. Valid during that call only.
class TheoryContext {
 public:
  /// Under the assignment announced so far.
  [[nodiscard]] virtual Truth value(Lit lit) const = 0;
  /// Decision level at which `lit` was announced. Requires an assigned literal.
  [[nodiscard]] virtual std::size_t level(Lit lit) const = 0;
  /// How many variables have a value, and how many there are.
  [[nodiscard]] virtual std::size_t num_assigned() const = 0;
  [[nodiscard]] virtual std::size_t num_variables() const = 0;
  /// Queues a clause that holds in the theory, whatever its literals' values. The solver gets it at
  /// its next opportunity; a clause that is false then is a conflict.
  virtual void add_lemma(const Lemma& lemma) = 0;
  /// Asks to assign `implied`, now unassigned. As long as it is assigned, `Theory::explain` may be
  /// asked why. Ignored if it has a value or is asked for already.
  virtual void propagate(Lit implied) = 0;
  /// A new literal, observed. During search this can undo assignments, so prefer making literals
  /// before solving.
  [[nodiscard]] virtual Lit new_lit() = 0;
  /// Asks to end the running solve soon, with the verdict `unknown`. Then nothing is owed for a
  /// complete assignment.
  virtual void stop() = 0;

 protected:
  ~TheoryContext() = default;
};

/// A decision procedure inside the SAT search. One thread. What it throws, LimitReached for
/// instance, ends the running solve and comes out of Engine::solve.
///
/// The engine shows the theory one stack of true literals. `on_assign` pushes, `on_retract` pops.
/// No variable is on the stack twice. After a retraction, literals that the solver kept at lower
/// levels are pushed again, possibly in another order than before and after literals that used to
/// come later. The stack outlives a call of solve: the next one begins with a retraction.
class Theory {
 public:
  virtual ~Theory() = default;
  /// Pushes, in order. Never empty.
  virtual void on_assign(std::span<const Lit> newly_true) = 0;
  /// Keeps the first `kept` literals of the stack.
  virtual void on_retract(std::size_t kept) = 0;
  /// Looks for violations of the theory under the literals on the stack. With Extent::full, at
  /// least one lemma that is false, or no complaint about this assignment at all.
  virtual void check(Extent extent, TheoryContext& context) = 0;
  /// The literal to assume next, unassigned; no literal: the solver chooses. May add lemmas and
  /// literals; lemmas reach the solver after the decision.
  [[nodiscard]] virtual Lit decide(TheoryContext& /*context*/) { return {}; }
  /// Appends a clause that holds in the theory, contains `implied` and whose other literals were
  /// false when `propagate(implied)` was called. May be asked late: after retractions, and outside
  /// of solve. Returns why, usages (valid until the next call) and forgettability; the clause in
  /// the result is not looked at.
  virtual Lemma explain(Lit implied, std::vector<Lit>& clause) = 0;
  /// The running solve ends soon because its effort is used up: called once then. The stack is
  /// still that of the search, for the last time: what comes next is a retraction.
  virtual void on_pause() {}
  /// Of all calls so far. The same in each run.
  [[nodiscard]] virtual Effort effort() const { return {}; }
};

}  // namespace quadrille::sat

QUADRILLE_API_END
