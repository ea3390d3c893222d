// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/sat/core_auditor.hpp"
#include "quadrille/sat/lemma.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// Checks while the solver runs that no clause excludes a plan, and keeps the first complaint.
///
/// On request, each lemma is derived again: those about agents as the domain says,
/// cores by a CoreAuditor: core clauses, and the core of each refutation, also where it becomes a
/// bound and no clause, and where it has no literals. With a known plan, which may cost anything,
/// each lemma, each learned clause and each core has to be true in it. Counters are definitions
/// "inputs -> output": the least values that satisfy them belong to the plan, which is why
/// definitions have to come before clauses that use them.
class ClauseAuditor : public ClauseObserver {
 public:
  void on_lemma(const Lemma& lemma) final;
  void on_learned(std::span<const Lit> clause) final;
  void on_core(std::span<const Lit> clause) final;

  [[nodiscard]] const std::optional<std::string>& complaint() const noexcept { return complaint_; }
  /// Null unless lemmas are derived again.
  [[nodiscard]] CoreAuditor* cores() noexcept { return cores_ ? &*cores_ : nullptr; }

 protected:
  using Clause = std::span<const Lit>;
  ClauseAuditor(bool derive, bool has_known_plan);

  /// What is wrong with a lemma of the domain, that is, no counter and no core; empty if nothing
  /// is.
  [[nodiscard]] virtual std::string audit(const Lemma& lemma) = 0;

  /// Whether the literal is true in the known plan; nullopt for auxiliary variables.
  [[nodiscard]] virtual std::optional<bool> find_in_plan(Lit lit) const = 0;
  [[nodiscard]] virtual std::string describe(Clause clause) const = 0;

 private:
  [[nodiscard]] std::string derive_again(const Lemma& lemma);
  [[nodiscard]] bool is_true_in_plan(Lit lit) const;
  /// False without a known plan.
  [[nodiscard]] bool is_false_in_plan(Clause clause) const;
  /// Of a counting lemma: makes an output true if need be.
  [[nodiscard]] bool define_output(const Lemma& lemma);

  std::optional<CoreAuditor> cores_;  // if lemmas are derived again
  const bool has_known_plan_;
  std::vector<bool> counter_is_true_;  // auxiliary variables that the known plan implies
  std::optional<std::string> complaint_;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
