// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solve/lemma_stock.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// Remembers the last lemmas of a search about paths, collisions and pairs, those among them that
/// it was given. Passes everything on to another observer.
class LemmaKeeper final : public sat::PassingObserver {
 public:
  /// Both outlive the keeper; `next` may be null.
  LemmaKeeper(const Model& model, sat::ClauseObserver* next)
      : PassingObserver(next), model_(model) {}

  void on_lemma(const sat::Lemma& lemma) override;

  /// Lemmas in stock, at most. Measured in sessions of 15 and 30 agents: most searches leave fewer,
  /// and a third is hardly worse.
  static constexpr std::size_t kMostLemmas = 3000;
  [[nodiscard]] LemmaStock stock() const;

 private:
  const Model& model_;
  std::vector<LemmaStock::Lemma> lemmas_;  // with obstacles by id
};

/// Gives lemmas of earlier searches to this one, which has not begun. They hold for the model's
/// instance, but for doubtful levels: those become what a cheapest path around the obstacles costs.
/// Lemmas that say nothing here are left out. Returns how many there are. Throws LimitReached.
std::size_t take_up(const LemmaStock& stock, Model& model, FormulaWriter& writer);

}  // namespace quadrille::continuous
