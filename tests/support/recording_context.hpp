// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "quadrille/sat/theory.hpp"

namespace quadrille::support {

/// Passes everything on, and remembers what the theory said.
class RecordingContext final : public sat::TheoryContext {
 public:
  explicit RecordingContext(sat::TheoryContext& context) : context_(context) {}

  std::vector<std::vector<sat::Lit>> lemmas;
  std::vector<sat::Why> reasons;  // of the lemmas
  bool made_literal = false, stopped = false;
  bool is_trial = false;  // lemmas stay here

  [[nodiscard]] sat::Truth value(sat::Lit lit) const override { return context_.value(lit); }
  [[nodiscard]] std::size_t level(sat::Lit lit) const override { return context_.level(lit); }
  [[nodiscard]] std::size_t num_assigned() const override { return context_.num_assigned(); }
  [[nodiscard]] std::size_t num_variables() const override { return context_.num_variables(); }
  void add_lemma(const sat::Lemma& lemma) override {
    lemmas.emplace_back(lemma.clause.begin(), lemma.clause.end());
    reasons.push_back(lemma.why);
    if (!is_trial) context_.add_lemma(lemma);
  }
  void propagate(sat::Lit implied) override { context_.propagate(implied); }
  [[nodiscard]] sat::Lit new_lit() override {
    made_literal = true;
    EXPECT_FALSE(is_trial) << "a literal for something that is known already";
    return context_.new_lit();
  }
  void stop() override {
    stopped = true;
    context_.stop();
  }

 private:
  sat::TheoryContext& context_;
};

}  // namespace quadrille::support
