// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mdd/mdd_model.hpp"
#include "quadrille/sat/clause_auditor.hpp"

namespace quadrille::discrete {

/// Derives the lemmas of the MDD model again: path lemmas by a search of its own over the
/// time-expanded graph, collision lemmas from their usages.
class LemmaAuditor final : public sat::ClauseAuditor {
 public:
  /// `model` outlives the auditor. `known_plan` must be a valid plan if given.
  LemmaAuditor(const MddModel& model, bool derive, std::optional<Plan> known_plan);

 private:
  [[nodiscard]] std::string audit(const sat::Lemma& lemma) override;
  [[nodiscard]] std::optional<bool> find_in_plan(sat::Lit lit) const override;
  [[nodiscard]] std::string describe(Clause clause) const override;
  [[nodiscard]] std::string audit_path(Clause clause, AgentId agent) const;
  [[nodiscard]] std::string audit_order(Clause clause) const;
  [[nodiscard]] std::string audit_collision(const sat::Lemma& lemma) const;

  const MddModel& model_;
  std::optional<Plan> known_plan_;
};

}  // namespace quadrille::discrete
