// SPDX-License-Identifier: MIT
#include "theory/known_plan_auditor.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

KnownPlanAuditor::KnownPlanAuditor(const Model& model, const Plan& plan) : model_(model) {
  const Instance& instance = model.instance();
  for (const AgentId i : instance.agent_ids()) {
    TimedPath path;
    const Path& stops = plan.paths[i];
    const ClassId c = instance.class_of(i);
    path.arrival = cost(stops);
    for (std::size_t k = 0; k + 1 < stops.size(); ++k)
      for (const EdgeId e : instance.roadmap().out_edges(stops[k].vertex))
        if (instance.roadmap().edge(e).to == stops[k + 1].vertex &&
            instance.duration(c, e) == stops[k + 1].arrive - stops[k].depart) {
          path.moves.push_back({e, stops[k].depart});
          break;
        }
    QUADRILLE_REQUIRE(path.moves.size() + 1 == stops.size(), "the plan is valid");
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
      return true;
    case Model::VariableKind::cost:
      value = paths_[meaning.agent].arrival >= meaning.cost;
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
