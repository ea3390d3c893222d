// SPDX-License-Identifier: MIT
#include "mdd/collision_theory.hpp"

#include <algorithm>

#include "mdd/usages.hpp"

namespace quadrille::discrete {

using sat::Lit;
using sat::Truth;
using VariableKind = MddModel::VariableKind;

CollisionTheory::CollisionTheory(const MddModel& model, const CheckSchedule& schedule)
    : model_(model),
      schedule_(schedule),
      clauses_(model),
      occupant_(model.instance().graph().num_vertices()),
      rivals_(model.instance().graph().num_vertices()) {}

void CollisionTheory::on_extended() {
  if (schedule_.kind != CheckSchedule::Kind::propagate) return;
  for (int v = std::max(1, rivals_end_); v < model_.variable_end(); ++v) {
    const Lit lit = Lit::from_dimacs(v);
    const auto var = model_.variable(lit);
    if (var.kind == VariableKind::vertex) rivals_.at(var.vertex, var.number).push_back(lit);
  }
  rivals_end_ = model_.variable_end();
  reason_.resize(static_cast<std::size_t>(rivals_end_));
}

void CollisionTheory::on_assign(std::span<const Lit> newly_true) {
  num_announced_ += static_cast<std::int64_t>(newly_true.size());
  stack_.insert(stack_.end(), newly_true.begin(), newly_true.end());
}

void CollisionTheory::on_retract(std::size_t kept) {
  leave(kept);
  stack_.resize(kept);
  // A share that is passed again is checked again.
  stages_done_ = std::min(stages_done_, stage(kept, num_variables_));
}

void CollisionTheory::leave(std::size_t kept) {
  while (entered_.size() > kept) {
    const Entered& last = entered_.back();
    const auto var = model_.variable(last.lit);
    if (last.lit.positive() && var.kind == VariableKind::vertex)
      occupant_.at(var.vertex, var.number) = last.previous;
    entered_.pop_back();
  }
}

std::size_t CollisionTheory::stage(std::size_t assigned, std::size_t variables) const {
  std::size_t reached = 0;
  for (const auto& f : schedule_.fractions)
    if (assigned * static_cast<std::size_t>(f.denominator) >=
        variables * static_cast<std::size_t>(f.numerator))
      ++reached;
  return reached;
}

bool CollisionTheory::is_due(const sat::TheoryContext& context) {
  if (schedule_.kind != CheckSchedule::Kind::fractions) return true;
  num_variables_ = context.num_variables();
  const std::size_t reached = stage(context.num_assigned(), num_variables_);
  const bool due = reached > stages_done_;
  stages_done_ = reached;
  return due;
}

void CollisionTheory::check(sat::Extent extent, sat::TheoryContext& context) {
  if (extent == sat::Extent::full) {
    ++num_checks_;
    check_paths(context);
  } else if (is_due(context)) {
    ++num_checks_;
    if (schedule_.kind == CheckSchedule::Kind::fractions)
      check_walks(context);
    else
      enter_all(context);
  }
}

void CollisionTheory::enter_all(sat::TheoryContext& context) {
  while (entered_.size() < stack_.size()) {
    const Lit lit = stack_[entered_.size()];
    entered_.push_back({lit, Lit()});
    if (lit.positive())
      enter(lit, context);
    else
      enter_early_rest(lit, context);
  }
}

void CollisionTheory::check_walks(sat::TheoryContext& context) {
  const auto is_true = [&](Lit lit) { return context.value(lit) == Truth::is_true; };
  for (const AgentId i : model_.instance().agent_ids()) {
    if (!model_.has_path(i, is_true)) continue;
    const Path walk = model_.extract_walk(i, is_true);
    for (std::size_t t = 0; t < walk.size(); ++t) {
      const Lit x = model_.at(i, walk[t], static_cast<Timestep>(t));
      entered_.push_back({x, Lit()});
      enter(x, context);
    }
  }
  leave(0);
}

void CollisionTheory::enter(Lit x, sat::TheoryContext& context) {
  const auto var = model_.variable(x);
  if (var.kind == VariableKind::end) enter_end(var, context);
  if (var.kind != VariableKind::vertex) return;
  const CollisionClauses::Sink sink = [&](const sat::Lemma& lemma) { context.add_lemma(lemma); };
  Lit& place = occupant_.at(var.vertex, var.number);
  entered_.back().previous = place;
  const auto exclude = [&](Lit y) {
    if (y.valid() && model_.variable(y).agent != var.agent && !is_gone(x, context) &&
        !is_gone(y, context))
      clauses_.vertex(y, x, sink);
  };
  exclude(place);
  place = x;
  for (Timestep gap = 1; gap <= model_.robust(); ++gap) {
    exclude(occupant_(var.vertex, var.number - gap));
    exclude(occupant_(var.vertex, var.number + gap));
  }
  find_swaps(x, var, sink);
  for (const AgentId resident : model_.residents(var.vertex)) keep_out(x, resident, context);
  if (schedule_.kind == CheckSchedule::Kind::propagate) deny_others(x, var, context);
}

void CollisionTheory::keep_out(Lit x, AgentId resident, sat::TheoryContext& context) {
  const auto var = model_.variable(x);
  if (var.agent == resident) return;
  const Lit ends = model_.end_at(resident, var.vertex);
  if (ends.valid() && context.value(ends) != Truth::is_true) return;
  const Lit late = clauses_.late_for(resident, var.number);
  if (!late.valid() || context.value(late) == Truth::is_true || is_gone(x, context)) return;
  clauses_.rest(x, resident, late, [&](const sat::Lemma& lemma) { context.add_lemma(lemma); });
}

// "Not late" comes after the X literal of a visitor at the goal when both came in one batch with a
// true "late" that was undone since.
void CollisionTheory::enter_early_rest(Lit not_late, sat::TheoryContext& context) {
  const auto var = model_.variable(not_late);
  if (var.kind != VariableKind::delay || model_.instance().agents()[var.agent].leaves) return;
  const Mdd& mdd = model_.mdd(var.agent);
  const Timestep t = mdd.distance() + var.number - 1 - model_.robust();
  if (clauses_.late_for(var.agent, t) != ~not_late) return;
  for (const VertexId goal : mdd.task().goals.vertices())
    if (const Lit visitor = occupant_(goal, t); visitor.valid())
      keep_out(visitor, var.agent, context);
}

// Where an agent ends may become known after who was there, and after who else ends there.
void CollisionTheory::enter_end(const MddModel::Variable& var, sat::TheoryContext& context) {
  if (!model_.may_stay(var.agent, var.vertex)) return;
  for (const Lit visitor : occupant_.row(var.vertex))
    if (visitor.valid()) keep_out(visitor, var.agent, context);
  for (const AgentId other : model_.residents(var.vertex)) {
    if (other == var.agent) continue;
    const Lit its = model_.end_at(other, var.vertex);
    if (!its.valid() || context.value(its) == Truth::is_true)
      clauses_.end(std::min(var.agent, other), std::max(var.agent, other), var.vertex,
                   [&](const sat::Lemma& lemma) { context.add_lemma(lemma); });
  }
}

// The moves that x begins or ends, against moves that entered literals make.
void CollisionTheory::find_swaps(Lit x, const MddModel::Variable& var,
                                 const CollisionClauses::Sink& sink) {
  const auto agent_of = [&](Lit lit) { return model_.variable(lit).agent; };
  const VertexId v = var.vertex;
  const Timestep t = var.number;
  for (const VertexId u : model_.instance().graph().neighbours(v)) {
    for (const Timestep other_time : {t - 1, t + 1}) {
      const Lit own = occupant_(u, other_time);
      if (!own.valid() || agent_of(own) != var.agent) continue;
      // This agent is in u then and in v at t; a rival that is in v then and in u at t crosses it.
      const Lit rival_v = occupant_(v, other_time), rival_u = occupant_(u, t);
      if (!rival_v.valid() || !rival_u.valid()) continue;
      if (agent_of(rival_v) != agent_of(rival_u) || agent_of(rival_v) == var.agent) continue;
      if (other_time < t)
        clauses_.swap(own, x, rival_v, rival_u, sink);
      else
        clauses_.swap(x, own, rival_u, rival_v, sink);
    }
  }
}

bool CollisionTheory::is_gone(Lit x, const sat::TheoryContext& context) const {
  const Lit gone = model_.gone(x);
  return gone.valid() && context.value(gone) == Truth::is_true;
}

void CollisionTheory::deny_others(Lit x, const MddModel::Variable& var,
                                  sat::TheoryContext& context) {
  if (model_.gone(x).valid()) return;
  for (const Lit y : rivals_(var.vertex, var.number)) {
    if (model_.variable(y).agent == var.agent || model_.gone(y).valid()) continue;
    if (context.value(y) != Truth::unassigned) continue;
    // Who asked for it first stays the reason: `x` may be retracted while the request still stands.
    Lit& reason = reason_[static_cast<std::size_t>(y.variable())];
    if (!reason.valid() || context.value(reason) != Truth::is_true) reason = x;
    context.propagate(~y);
  }
}

sat::Lemma CollisionTheory::explain(Lit implied, std::vector<Lit>& clause) {
  const Lit x = reason_[static_cast<std::size_t>(implied.variable())];
  QUADRILLE_REQUIRE(x.valid() && !implied.positive(), "explains what was propagated");
  clause.push_back(implied);
  clause.push_back(~x);
  const auto var = model_.variable(x);
  reason_usages_ = {vertex_usage(model_.variable(implied).agent, var.vertex, var.number),
                    vertex_usage(var.agent, var.vertex, var.number)};
  return {sat::why::Vertex{}, {}, reason_usages_, true};
}

void CollisionTheory::check_paths(sat::TheoryContext& context) {
  const auto is_true = [&](Lit lit) { return context.value(lit) == Truth::is_true; };
  Plan plan;  // an agent without a path has an empty one here, which collides with nothing
  for (const AgentId i : model_.instance().agent_ids())
    plan.paths.push_back(model_.has_path(i, is_true) ? model_.extract_path(i, is_true) : Path());
  const CollisionClauses::Sink sink = [&](const sat::Lemma& lemma) { context.add_lemma(lemma); };
  for (const PathCollision& c : find_collisions(model_.instance(), plan))
    clauses_.exclude(c, is_true, sink);
}

}  // namespace quadrille::discrete
