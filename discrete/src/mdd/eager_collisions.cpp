// SPDX-License-Identifier: MIT
#include "mdd/eager_collisions.hpp"

namespace quadrille::discrete {

using sat::Lit;

EagerCollisions::EagerCollisions(const MddModel& model)
    : model_(model), clauses_(model), users_(model.instance().graph().num_vertices()) {}

// Variables in order; each one with all before it, so that every clause is written once, when the
// newest of its literals comes.
bool EagerCollisions::extend(sat::Engine& engine, LimitMonitor& limits) {
  const CollisionClauses::Sink sink = [&](const sat::Lemma& lemma) { engine.add_clause(lemma); };
  for (; written_end_ < model_.variable_end(); ++written_end_) {
    if (limits.exhausted()) return false;
    const Lit x = Lit::from_dimacs(written_end_);
    const auto var = model_.variable(x);
    if (var.kind == MddModel::VariableKind::end) add_ends(x, var, sink);
    if (var.kind != MddModel::VariableKind::vertex) continue;
    for (Timestep t = var.number - model_.robust(); t <= var.number + model_.robust(); ++t)
      for (const Lit y : users_(var.vertex, t))
        if (model_.variable(y).agent != var.agent) clauses_.vertex(y, x, sink);
    users_.at(var.vertex, var.number).push_back(x);
    add_swaps(x, var, sink);
    for (const AgentId resident : model_.residents(var.vertex)) {
      if (resident == var.agent) continue;
      const Lit late = clauses_.late_for(resident, var.number);
      if (late.valid()) clauses_.rest(x, resident, late, sink);
    }
  }
  return true;
}

void EagerCollisions::add_ends(Lit end, const MddModel::Variable& var,
                               const CollisionClauses::Sink& sink) {
  if (!model_.may_stay(var.agent, var.vertex)) return;
  for (const AgentId other : model_.residents(var.vertex)) {
    if (other == var.agent) continue;
    const Lit its = model_.end_at(other, var.vertex);
    if (!its.valid() || is_known(its, end)) clauses_.end(other, var.agent, var.vertex, sink);
  }
}

void EagerCollisions::add_swaps(Lit x, const MddModel::Variable& var,
                                const CollisionClauses::Sink& sink) {
  const VertexId v = var.vertex;
  const Timestep t = var.number;
  // Over edges that lead both ways.
  for (const VertexId u : model_.instance().graph().neighbours(v))
    for (const Timestep other_time : {t - 1, t + 1}) {
      if (other_time < 0) continue;
      const Lit own = model_.at(var.agent, u, other_time);
      if (!is_known(own, x)) continue;
      for (const Lit rival_u : users_(u, t)) {
        const AgentId rival = model_.variable(rival_u).agent;
        if (rival == var.agent) continue;
        const Lit rival_v = model_.at(rival, v, other_time);
        if (!is_known(rival_v, x)) continue;
        if (other_time < t)
          clauses_.swap(own, x, rival_v, rival_u, sink);
        else
          clauses_.swap(x, own, rival_u, rival_v, sink);
      }
    }
}

}  // namespace quadrille::discrete
