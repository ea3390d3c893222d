// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "quadrille/sat/theory.hpp"

namespace quadrille::sat {

/// A clause that waits for the solver, with its justification.
struct QueuedLemma {
  std::vector<Lit> clause;
  bool forgettable = false;
};

/// Turns the raw callbacks of an external propagator (IPASIR-UP) into the orderly stack that a
/// Theory sees. Knows the protocol, but no particular SAT solver, so that tests can play the
/// solver.
///
/// What the protocol allows and a Theory is spared: empty batches, literals announced twice,
/// literals at level 0 repeated at any time, backtracks to levels that were never announced,
/// reasons asked after a backtrack or outside of a solve.
class TheoryHost final : private TheoryContext {
 public:
  struct Hooks {
    std::function<Lit()> new_lit;                   ///< Makes an observed variable.
    std::function<void(const Lemma&)> count_lemma;  ///< Hears each lemma and each reason once.
  };
  TheoryHost(Theory& theory, Hooks hooks);

  /// Makes room for a variable; required before it occurs in a callback.
  void add_variable(int variable);

  void notify_assignment(std::span<const int> literals);
  void notify_new_decision_level();
  void notify_backtrack(std::size_t level);
  /// True if the theory agrees with the complete assignment announced so far. If false, there is a
  /// clause to fetch, or a new variable. The theory is not asked while clauses wait.
  [[nodiscard]] bool check_found_model();
  /// A literal to propagate, or 0. Consults the theory when literals were assigned since last time.
  [[nodiscard]] int propagate();
  /// The theory's choice of a decision, or 0.
  [[nodiscard]] int decide();
  /// To be called before each solve.
  void begin_solve() { wants_stop_ = false; }
  /// True if the theory asked to end the running solve.
  [[nodiscard]] bool wants_stop() const noexcept { return wants_stop_; }
  /// The literals of the reason of `propagated` one by one, then 0.
  [[nodiscard]] int next_reason_literal(int propagated);
  [[nodiscard]] bool has_clause(bool& forgettable);
  /// The literals of the first queued clause one by one, then 0, which ends it.
  [[nodiscard]] int next_clause_literal();

  /// Clauses that no callback has fetched (whole); the queue is empty afterwards. Outside of solve.
  [[nodiscard]] std::vector<QueuedLemma> take_queue();

  [[nodiscard]] std::int64_t num_levels_opened() const noexcept { return levels_opened_; }
  [[nodiscard]] std::int64_t num_models_checked() const noexcept { return models_checked_; }
  /// For tests: the stack as the theory has it.
  [[nodiscard]] const std::vector<Lit>& stack() const noexcept { return stack_; }

 private:
  struct VariableState {
    Truth value = Truth::unassigned;  // of the positive literal
    std::uint32_t level = 0;
    bool propagation_queued = false;
  };
  struct Propagation {
    Lit lit;
    std::size_t justified_by;  // stack size when it was asked for
  };

  // TheoryContext
  [[nodiscard]] Truth value(Lit lit) const override;
  [[nodiscard]] std::size_t level(Lit lit) const override;
  [[nodiscard]] std::size_t num_assigned() const override { return stack_.size(); }
  [[nodiscard]] std::size_t num_variables() const override { return num_variables_; }
  void add_lemma(const Lemma& lemma) override;
  void propagate(Lit implied) override;
  [[nodiscard]] Lit new_lit() override;
  void stop() override { wants_stop_ = true; }

  /// Asks the theory about literals that it was not asked about yet, unless clauses are waiting.
  void consult();
  [[nodiscard]] VariableState& state(Lit lit);
  [[nodiscard]] const VariableState& state(Lit lit) const;

  Theory& theory_;
  Hooks hooks_;
  std::vector<VariableState> variables_;  // by variable; entry 0 is unused
  std::size_t num_variables_ = 0;
  std::vector<Lit> stack_;
  std::vector<std::size_t> level_begin_;  // stack size when level k+1 was opened
  std::size_t consulted_ = 0;             // stack size at the last partial check
  std::vector<Lit> batch_;                // scratch

  std::vector<QueuedLemma> queue_;
  std::size_t queue_head_ = 0, literal_head_ = 0;
  std::vector<Propagation> propagations_;
  std::size_t propagation_head_ = 0;
  std::vector<Lit> reason_;
  std::size_t reason_head_ = 0;
  bool streaming_reason_ = false;
  bool made_variable_ = false;
  bool wants_stop_ = false;
  std::int64_t levels_opened_ = 0, models_checked_ = 0;
};

}  // namespace quadrille::sat
