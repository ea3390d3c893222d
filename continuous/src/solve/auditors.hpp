// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "quadrille/continuous/solver.hpp"
#include "quadrille/sat/core_auditor.hpp"
#include "theory/known_plan_auditor.hpp"
#include "theory/lemma_auditor.hpp"

namespace quadrille::continuous {

/// Those that the options ask for.
class Auditors final : public sat::ClauseObserver {
 public:
  Auditors(const Model& model, const DebugOptions& options) {
    if (options.known_plan) of_plan_.emplace(model, *options.known_plan);
    if (!options.audit) return;
    of_lemmas_.emplace(model);
    of_cores_.emplace();
  }
  [[nodiscard]] bool is_needed() const { return of_plan_ || of_lemmas_; }
  void on_lemma(const sat::Lemma& lemma) override {
    if (of_plan_) of_plan_->on_lemma(lemma);
    if (of_lemmas_) of_lemmas_->on_lemma(lemma);
    if (of_cores_) of_cores_->on_lemma(lemma);
  }
  void on_learned(std::span<const sat::Lit> clause) override {
    if (of_plan_) of_plan_->on_learned(clause);
  }
  void on_core(std::span<const sat::Lit> clause) override {
    if (of_cores_) of_cores_->on_core(clause);
  }
  /// Null if cores are not audited.
  [[nodiscard]] sat::CoreAuditor* of_cores() { return of_cores_ ? &*of_cores_ : nullptr; }
  /// The first of each kind.
  [[nodiscard]] std::optional<std::string> complaint() const {
    if (of_lemmas_ && of_lemmas_->complaint()) return of_lemmas_->complaint();
    if (of_cores_ && of_cores_->complaint()) return of_cores_->complaint();
    return of_plan_ ? of_plan_->complaint() : std::nullopt;
  }

 private:
  std::optional<KnownPlanAuditor> of_plan_;
  std::optional<LemmaAuditor> of_lemmas_;
  std::optional<sat::CoreAuditor> of_cores_;
};

}  // namespace quadrille::continuous
