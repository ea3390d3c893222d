// SPDX-License-Identifier: MIT
#include "theory/known_plan_auditor.hpp"

#include <algorithm>

namespace quadrille::continuous {

KnownPlanAuditor::KnownPlanAuditor(const Model& model, const Plan& plan) : model_(model) {
  const Instance& instance = model.instance();
  for (const AgentId i : instance.agent_ids()) {
    const TimedPath path = without_stops(instance, i, plan.paths[i]);
    PathUses uses;
    uses.assign(instance, i, path);
    paths_.push_back(path);
    uses_.push_back(uses);
  }
}

bool KnownPlanAuditor::holds(sat::Lit lit) const {
  const auto meaning = model_.variable(lit);
  bool value = true;  // of the literal as it is in the model
  switch (meaning.kind) {
    case Model::VariableKind::auxiliary:
    case Model::VariableKind::own:
      return true;
    case Model::VariableKind::cost:
      value = as_cost(paths_[meaning.agent].arrival) >= meaning.cost;
      return value == lit.positive();
    case Model::VariableKind::usage:
      value = uses_[meaning.agent].breaks(model_.obstacles()[meaning.obstacle].bans);
      return value != lit.positive();  // the variable forbids
  }
  return true;
}

void KnownPlanAuditor::check(std::span<const sat::Lit> clause, std::string_view kind) {
  if (complaint_ ||
      std::any_of(clause.begin(), clause.end(), [&](sat::Lit lit) { return holds(lit); }))
    return;
  complaint_ = "a clause excludes the known plan (" + std::string(kind) + "):";
  for (const sat::Lit lit : clause) *complaint_ += " " + std::to_string(lit.dimacs());
}

}  // namespace quadrille::continuous
