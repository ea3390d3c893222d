// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/sat/theory.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// Writes to the solver by way of the theory's context.
class ContextWriter final : public FormulaWriter {
 public:
  explicit ContextWriter(sat::TheoryContext& context) : context_(context) {}
  [[nodiscard]] sat::Lit new_lit() override { return context_.new_lit(); }
  void add(const sat::Lemma& lemma) override { context_.add_lemma(lemma); }

 private:
  sat::TheoryContext& context_;
};

/// Passes on and tells whether anything was written.
class CountingWriter final : public FormulaWriter {
 public:
  explicit CountingWriter(FormulaWriter& target) : target_(target) {}
  [[nodiscard]] sat::Lit new_lit() override {
    has_written_ = true;
    return target_.new_lit();
  }
  void add(const sat::Lemma& lemma) override {
    has_written_ = true;
    target_.add(lemma);
  }
  [[nodiscard]] bool has_written() const noexcept { return has_written_; }

 private:
  FormulaWriter& target_;
  bool has_written_ = false;
};

}  // namespace quadrille::continuous
