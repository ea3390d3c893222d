// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/sat/engine.hpp"
#include "quadrille/sat/theory.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::lazy {

/// Where new literals and clauses go: to the engine between solves, or to it by way of the theory.
class FormulaWriter {
 public:
  virtual ~FormulaWriter() = default;
  [[nodiscard]] virtual sat::Lit new_lit() = 0;
  virtual void add(const sat::Lemma& lemma) = 0;
};

/// Writes to an engine between solves.
class EngineWriter final : public FormulaWriter {
 public:
  explicit EngineWriter(sat::Engine& engine) : engine_(engine) {}
  [[nodiscard]] sat::Lit new_lit() override { return engine_.new_lit(); }
  void add(const sat::Lemma& lemma) override { engine_.add_clause(lemma); }

 private:
  sat::Engine& engine_;
};

/// Writes to the solver by way of the theory's context.
class ContextWriter final : public FormulaWriter {
 public:
  explicit ContextWriter(sat::TheoryContext& context) : context_(context) {}
  [[nodiscard]] sat::Lit new_lit() override { return context_.new_lit(); }
  void add(const sat::Lemma& lemma) override { context_.add_lemma(lemma); }

 private:
  sat::TheoryContext& context_;
};

/// Passes on what a check writes, and knows what that says of the assignment.
class CheckWriter final : public FormulaWriter {
 public:
  /// `context`: of the solve that is running; null between solves.
  CheckWriter(FormulaWriter& target, sat::TheoryContext* context)
      : target_(target), context_(context) {}

  [[nodiscard]] sat::Lit new_lit() override {
    has_excluded_ = true;
    return target_.new_lit();
  }
  void add(const sat::Lemma& lemma) override {
    has_excluded_ = has_excluded_ || !is_satisfied(lemma);
    target_.add(lemma);
  }
  /// A limit is met: ends the solve soon, or throws LimitReached between solves.
  void stop() const {
    if (context_ == nullptr) throw LimitReached{};
    context_->stop();
  }

  /// The assignment cannot stay as it is: because of a clause of which no literal is true, or of a
  /// literal that has no value yet. Between solves: anything was written.
  [[nodiscard]] bool has_excluded() const noexcept { return has_excluded_; }

 private:
  [[nodiscard]] bool is_satisfied(const sat::Lemma& lemma) const {
    return context_ != nullptr &&
           std::any_of(lemma.clause.begin(), lemma.clause.end(),
                       [&](sat::Lit lit) { return context_->value(lit) == sat::Truth::is_true; });
  }

  FormulaWriter& target_;
  sat::TheoryContext* const context_;
  bool has_excluded_ = false;
};

}  // namespace quadrille::lazy

QUADRILLE_API_END
