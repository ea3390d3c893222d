// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mdd/mdd_model.hpp"
#include "quadrille/sat/lemma.hpp"

namespace quadrille::discrete {

/// Checks while the solver runs that no clause excludes a plan.
///
/// Every lemma is derived again: path lemmas by a search of their own over the time-expanded graph,
/// collision lemmas from their usages. With a known plan, every lemma and every learned clause has
/// to be true in it. Keeps the first complaint.
class LemmaAuditor final : public sat::ClauseObserver {
 public:
  /// `model` outlives the auditor. `known_plan` must be a valid plan if given.
  LemmaAuditor(const MddModel& model, bool derive, std::optional<Plan> known_plan);

  void on_lemma(const sat::Lemma& lemma) override;
  void on_learned(std::span<const sat::Lit> clause) override;

  [[nodiscard]] const std::optional<std::string>& complaint() const noexcept { return complaint_; }

 private:
  using Clause = std::span<const sat::Lit>;
  /// Each returns what is wrong, empty if nothing is.
  [[nodiscard]] std::string audit_path(Clause clause, AgentId agent) const;
  [[nodiscard]] std::string audit_order(Clause clause) const;
  [[nodiscard]] std::string audit_collision(const sat::Lemma& lemma) const;
  [[nodiscard]] std::string audit_against_plan(const sat::Lemma* lemma, Clause clause);

  [[nodiscard]] bool is_true_in_plan(sat::Lit lit) const;
  [[nodiscard]] std::string describe(Clause clause) const;
  void complain(const std::string& what, Clause clause);

  const MddModel& model_;
  bool derive_;
  std::optional<Plan> known_plan_;
  std::vector<bool> counter_is_true_;  // auxiliary variables that the known plan implies
  std::optional<std::string> complaint_;
};

}  // namespace quadrille::discrete
