// SPDX-License-Identifier: MIT
#include "quadrille/sat/core_auditor.hpp"

#include <utility>

namespace quadrille::sat {

CoreAuditor::CoreAuditor(int max_conflicts)
    : max_conflicts_(max_conflicts), limits_(Limits{}), solver_(nullptr) {}

void CoreAuditor::make_variables(std::span<const Lit> lits) {
  for (const Lit lit : lits)
    while (solver_.num_variables() < lit.variable()) static_cast<void>(solver_.new_lit());
}

void CoreAuditor::on_lemma(const Lemma& lemma) {
  if (lemma.is<why::Core>()) audit(lemma.clause);
  make_variables(lemma.clause);
  solver_.add_clause(lemma);
}

void CoreAuditor::prove(std::span<const Lit> core, std::vector<Lit> given) {
  if (complaint_) return;
  std::vector<Lit> assumptions = std::move(given);
  for (const Lit lit : core) assumptions.push_back(~lit);
  make_variables(assumptions);
  const Verdict verdict = solver_.solve(assumptions, limits_, {max_conflicts_});
  if (verdict == Verdict::unsat) ++num_proved_;
  if (verdict == Verdict::unknown) ++num_open_;
  if (verdict != Verdict::sat) return;
  complaint_ = "a core does not follow from the clauses:";
  for (const Lit lit : core) *complaint_ += " " + std::to_string(lit.dimacs());
}

}  // namespace quadrille::sat
