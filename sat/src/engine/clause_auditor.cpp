// SPDX-License-Identifier: MIT
#include "quadrille/sat/clause_auditor.hpp"

#include <algorithm>
#include <cstddef>

namespace quadrille::sat {

ClauseAuditor::ClauseAuditor(bool derive, bool has_known_plan) : has_known_plan_(has_known_plan) {
  if (derive) cores_.emplace();
}

void ClauseAuditor::on_lemma(const Lemma& lemma) {
  if (complaint_) return;
  std::string wrong;
  if (cores_) wrong = derive_again(lemma);
  if (wrong.empty() && is_false_in_plan(lemma.clause) && !define_output(lemma))
    wrong = "a lemma excludes the known plan";
  if (!wrong.empty()) complaint_ = wrong + ":" + describe(lemma.clause);
}

void ClauseAuditor::on_learned(Clause clause) {
  if (complaint_ || !is_false_in_plan(clause)) return;
  complaint_ = "a learned clause excludes the known plan:" + describe(clause);
}

void ClauseAuditor::on_core(Clause clause) {
  if (complaint_) return;
  if (cores_) cores_->on_core(clause);
  if (cores_ && cores_->complaint())
    complaint_ = "a core does not follow from the clauses:" + describe(clause);
  else if (is_false_in_plan(clause))
    complaint_ = "a core excludes the known plan:" + describe(clause);
}

std::string ClauseAuditor::derive_again(const Lemma& lemma) {
  cores_->on_lemma(lemma);
  if (lemma.is<why::Counter>()) return "";  // definitions of new variables
  if (lemma.is<why::Core>())
    return cores_->complaint() ? "a core does not follow from the clauses" : "";
  return audit(lemma);
}

bool ClauseAuditor::is_true_in_plan(Lit lit) const {
  if (const auto value = find_in_plan(lit)) return *value;
  const auto index = static_cast<std::size_t>(lit.variable());
  return (index < counter_is_true_.size() && counter_is_true_[index]) == lit.positive();
}

bool ClauseAuditor::is_false_in_plan(Clause clause) const {
  return has_known_plan_ &&
         std::none_of(clause.begin(), clause.end(), [&](Lit lit) { return is_true_in_plan(lit); });
}

bool ClauseAuditor::define_output(const Lemma& lemma) {
  if (!lemma.is<why::Counter>()) return false;
  for (const Lit lit : lemma.clause)
    if (lit.positive() && !find_in_plan(lit)) {
      const auto index = static_cast<std::size_t>(lit.variable());
      if (counter_is_true_.size() <= index) counter_is_true_.resize(index + 1, false);
      counter_is_true_[index] = true;
      return true;
    }
  return false;
}

}  // namespace quadrille::sat
