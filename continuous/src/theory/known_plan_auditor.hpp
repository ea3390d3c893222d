// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "quadrille/continuous/plan.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// Checks that every clause, learned ones included, allows a valid plan: the promise of Model.
class KnownPlanAuditor final : public sat::ClauseObserver {
 public:
  /// `model` outlives the auditor. Requires a valid plan.
  KnownPlanAuditor(const Model& model, const Plan& plan);

  void on_lemma(const sat::Lemma& lemma) override { check(lemma.clause, to_string(lemma.kind)); }
  void on_learned(std::span<const sat::Lit> clause) override { check(clause, "learned"); }

  /// The first clause that excludes the plan.
  [[nodiscard]] const std::optional<std::string>& complaint() const noexcept { return complaint_; }

 private:
  void check(std::span<const sat::Lit> clause, std::string_view kind);
  /// Whether the plan makes the literal true.
  [[nodiscard]] bool holds(sat::Lit lit) const;

  const Model& model_;
  IdVector<AgentId, TimedPath> paths_;
  IdVector<AgentId, PathUses> uses_;
  std::optional<std::string> complaint_;
};

}  // namespace quadrille::continuous
