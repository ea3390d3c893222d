// SPDX-License-Identifier: MIT
#include "engine/theory_host.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::sat {

TheoryHost::TheoryHost(Theory& theory, Hooks hooks)
    : theory_(theory), hooks_(std::move(hooks)), variables_(1) {}

void TheoryHost::add_variable(int variable) {
  QUADRILLE_REQUIRE(variable > 0, "variables are positive");
  const auto index = static_cast<std::size_t>(variable);
  if (variables_.size() <= index) variables_.resize(index + 1);
  ++num_variables_;
}

TheoryHost::VariableState& TheoryHost::state(Lit lit) {
  QUADRILLE_REQUIRE(static_cast<std::size_t>(lit.variable()) < variables_.size(),
                    "a variable of this host");
  return variables_[static_cast<std::size_t>(lit.variable())];
}

const TheoryHost::VariableState& TheoryHost::state(Lit lit) const {
  return const_cast<TheoryHost*>(this)->state(lit);
}

// ---- callbacks about the assignment -------------------------------------------------------------

void TheoryHost::notify_assignment(std::span<const int> literals) {
  batch_.clear();
  for (const int literal : literals) {
    const Lit lit = Lit::from_dimacs(literal);
    VariableState& var = state(lit);
    if (var.value != Truth::unassigned) continue;  // announced again
    var.value = lit.positive() ? Truth::is_true : Truth::is_false;
    var.level = static_cast<std::uint32_t>(level_begin_.size());
    stack_.push_back(lit);
    batch_.push_back(lit);
  }
  if (!batch_.empty()) theory_.on_assign(batch_);
}

void TheoryHost::notify_new_decision_level() {
  level_begin_.push_back(stack_.size());
  ++levels_opened_;
}

void TheoryHost::notify_backtrack(std::size_t level) {
  if (level >= level_begin_.size()) return;  // levels above were never announced
  const std::size_t kept = level_begin_[level];
  level_begin_.resize(level);
  if (kept == stack_.size()) return;
  for (std::size_t i = kept; i < stack_.size(); ++i) state(stack_[i]).value = Truth::unassigned;
  stack_.resize(kept);
  consulted_ = std::min(consulted_, kept);
  while (propagations_.size() > propagation_head_ && propagations_.back().justified_by > kept) {
    state(propagations_.back().lit).propagation_queued = false;
    propagations_.pop_back();
  }
  theory_.on_retract(kept);
}

// ---- callbacks that ask
// ---------------------------------------------------------------------------

bool TheoryHost::check_found_model() {
  // A theory may rely on what it has said: it is not asked about models that its clauses exclude.
  if (queue_head_ < queue_.size()) return false;
  ++models_checked_;
  made_variable_ = false;
  consulted_ = stack_.size();
  theory_.check(Extent::full, *this);
  return queue_head_ == queue_.size() && !made_variable_;
}

void TheoryHost::consult() {
  if (consulted_ == stack_.size() || queue_head_ < queue_.size()) return;
  consulted_ = stack_.size();
  theory_.check(Extent::partial, *this);
}

int TheoryHost::propagate() {
  consult();
  if (queue_head_ < queue_.size()) return 0;  // clauses first
  while (propagation_head_ < propagations_.size()) {
    const Lit lit = propagations_[propagation_head_++].lit;
    VariableState& var = state(lit);
    var.propagation_queued = false;
    if (var.value == Truth::unassigned) return lit.dimacs();
  }
  propagations_.clear();
  propagation_head_ = 0;
  return 0;
}

int TheoryHost::decide() {
  const Lit lit = theory_.decide(*this);
  return lit.valid() ? lit.dimacs() : 0;
}

int TheoryHost::next_reason_literal(int propagated) {
  if (!streaming_reason_) {
    reason_.clear();
    reason_head_ = 0;
    const Lit implied = Lit::from_dimacs(propagated);
    Lemma lemma = theory_.explain(implied, reason_);
    lemma.clause = reason_;
    QUADRILLE_REQUIRE(std::find(reason_.begin(), reason_.end(), implied) != reason_.end(),
                      "a reason contains what it implies");
    hooks_.count_lemma(lemma);
    streaming_reason_ = true;
  }
  if (reason_head_ < reason_.size()) return reason_[reason_head_++].dimacs();
  streaming_reason_ = false;
  return 0;
}

bool TheoryHost::has_clause(bool& forgettable) {
  consult();  // what was assigned while older clauses were being fetched
  if (queue_head_ == queue_.size()) return false;
  forgettable = queue_[queue_head_].forgettable;
  return true;
}

int TheoryHost::next_clause_literal() {
  QUADRILLE_REQUIRE(queue_head_ < queue_.size(), "a clause is queued");
  const auto& clause = queue_[queue_head_].clause;
  if (literal_head_ < clause.size()) return clause[literal_head_++].dimacs();
  literal_head_ = 0;
  if (++queue_head_ == queue_.size()) {
    queue_.clear();
    queue_head_ = 0;
  }
  return 0;
}

std::vector<QueuedLemma> TheoryHost::take_queue() {
  QUADRILLE_REQUIRE(literal_head_ == 0, "no clause is half fetched");
  std::vector<QueuedLemma> rest(
      std::make_move_iterator(queue_.begin() + static_cast<std::ptrdiff_t>(queue_head_)),
      std::make_move_iterator(queue_.end()));
  queue_.clear();
  queue_head_ = 0;
  return rest;
}

// ---- TheoryContext ------------------------------------------------------------------------------

Truth TheoryHost::value(Lit lit) const {
  const Truth positive = state(lit).value;
  if (positive == Truth::unassigned || lit.positive()) return positive;
  return positive == Truth::is_true ? Truth::is_false : Truth::is_true;
}

std::size_t TheoryHost::level(Lit lit) const {
  const VariableState& var = state(lit);
  QUADRILLE_REQUIRE(var.value != Truth::unassigned, "level of an assigned literal");
  return var.level;
}

void TheoryHost::add_lemma(const Lemma& lemma) {
  hooks_.count_lemma(lemma);
  queue_.push_back({{lemma.clause.begin(), lemma.clause.end()}, lemma.forgettable});
}

void TheoryHost::propagate(Lit implied) {
  VariableState& var = state(implied);
  if (var.value != Truth::unassigned || var.propagation_queued) return;
  var.propagation_queued = true;
  propagations_.push_back({implied, stack_.size()});
}

Lit TheoryHost::new_lit() {
  made_variable_ = true;
  return hooks_.new_lit();
}

}  // namespace quadrille::sat
