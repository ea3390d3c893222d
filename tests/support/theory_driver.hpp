// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "engine/theory_host.hpp"
#include "support/mock_solver.hpp"
#include "support/random.hpp"

namespace quadrille::support {

/// Drives a theory that makes literals and clauses of its own through random sequences of
/// callbacks. Clauses and literals outlive a sequence, and so does the theory: as from solve to
/// solve.
class TheoryDriver {
 public:
  struct Hooks {
    std::function<void(const sat::Lemma&)> on_lemma;
    std::function<void()> begin_solve;          ///< At the root: the place for assumptions.
    std::function<sat::Lit()> draw_literal;     ///< One that does something; none: no literal.
    std::function<sat::Lit()> draw_assumption;  ///< Likewise, of a kind that is assumed.
  };
  TheoryDriver(sat::Theory& theory, Random& random, Hooks hooks)
      : theory_(theory), random_(random), hooks_(std::move(hooks)) {}

  // ---- for what makes literals and clauses outside of the theory's calls ------------------------

  [[nodiscard]] sat::Lit new_lit() {
    host_->add_variable(end_);
    return sat::Lit::from_dimacs(end_++);
  }
  void add(const sat::Lemma& lemma) {
    hooks_.on_lemma(lemma);
    solver_->add_clause({lemma.clause.begin(), lemma.clause.end()});
  }
  /// Assumes the literal at a level of its own.
  void assume(sat::Lit lit) {
    solver_->open_level();
    solver_->assign(lit);
  }
  [[nodiscard]] int end() const { return end_; }  ///< Of the variables.

  // ---- sequences --------------------------------------------------------------------------------

  /// A solver's life. True if the clauses turned out to have no model without assumptions.
  bool run_sequence(std::uint64_t seed) {
    host_ = std::make_unique<sat::TheoryHost>(
        theory_, sat::TheoryHost::Hooks{[this] { return new_lit(); }, hooks_.on_lemma});
    for (int v = 1; v < end_; ++v) host_->add_variable(v);
    solver_ = std::make_unique<MockSolver>(*host_, end_ - 1, seed);
    for (auto& clause : clauses_) solver_->add_clause(std::move(clause));
    begin_solve();
    for (std::size_t step = 0; step < 40 && goes_on(); ++step) make_move();
    for (int tries = 0; tries < 4 && goes_on() && !check_model(); ++tries) {
    }
    EXPECT_TRUE(solver_->reasons().empty());
    clauses_ = solver_->clauses();
    for (const auto& rest : host_->take_queue()) clauses_.push_back(rest.clause);
    return solver_->dead();
  }

 private:
  [[nodiscard]] bool goes_on() const { return !solver_->dead() && !testing::Test::HasFailure(); }

  void begin_solve() {
    solver_->backtrack(0);
    host_->begin_solve();
    hooks_.begin_solve();
  }
  /// True if the theory agrees with a complete assignment.
  bool check_model() {
    for (int tries = 0; tries < 8 && goes_on(); ++tries) {
      if (random_.percent(80) && !solver_->propagate()) continue;
      if (!solver_->complete(end_)) continue;
      if (random_.percent(80) && !solver_->propagate()) continue;
      if (solver_->num_assigned() + 1 != static_cast<std::size_t>(end_)) continue;  // new literals
      if (solver_->check_found_model()) return true;
      solver_->fetch_clauses();
      solver_->resolve_conflicts();
    }
    return false;
  }
  void decide() {
    bool forgettable = false;
    if (!solver_->propagate() || solver_->dead() || host_->has_clause(forgettable)) return;
    // Without an answer, the solver may decide for a literal that it does not announce.
    while (!solver_->decide().valid() && random_.percent(50)) {
    }
    if (host_->wants_stop()) begin_solve();
  }
  void make_move() {
    switch (random_.below(16)) {
      case 0:
        solver_->open_level();
        break;
      case 1:
      case 2:
        solver_->backtrack(random_.below(solver_->level() + 1));
        break;
      case 3:
        solver_->backtrack_unannounced_levels();
        break;
      case 4:
        solver_->ask_late_reason();
        break;
      case 5:
        if (end_ > 1)
          solver_->assign(sat::Lit::from_dimacs(
              -1 - static_cast<int>(random_.below(static_cast<std::size_t>(end_ - 1)))));
        break;
      case 6:
        if (const auto lit = hooks_.draw_assumption(); lit.valid()) solver_->assign(lit);
        break;
      case 7:
        begin_solve();
        break;
      case 8:
      case 9:
        decide();
        break;
      case 10:
        static_cast<void>(check_model());
        break;
      case 11:
        solver_->announce();  // and do not ask
        break;
      default:
        if (random_.percent(50)) solver_->open_level();
        if (const auto lit = hooks_.draw_literal(); lit.valid()) solver_->assign(lit);
        if (random_.percent(70)) static_cast<void>(solver_->propagate());
    }
  }

  sat::Theory& theory_;
  Random& random_;
  const Hooks hooks_;
  std::unique_ptr<sat::TheoryHost> host_;
  std::unique_ptr<MockSolver> solver_;
  std::vector<std::vector<sat::Lit>> clauses_;
  int end_ = 1;
};

}  // namespace quadrille::support
