// SPDX-License-Identifier: MIT
#include "mdd/mdd_problem.hpp"

#include <algorithm>

#include "quadrille/sat/proof_log.hpp"

namespace quadrille::discrete {

using sat::Lit;

namespace {
/// The delay of the agent when it is alone.
Timestep free_delay(const MddModel& model, AgentId agent) {
  return model.free_cost(agent) - model.mdd(agent).distance();
}
}  // namespace

MddProblem::MddProblem(MddModel& model, sat::Engine& engine, CollisionTheory* theory,
                       EagerCollisions* eager, MddGrowth growth)
    : model_(model),
      engine_(engine),
      theory_(theory),
      eager_(eager),
      growth_(growth),
      total_(engine, model.instance().num_agents(), [&model](std::size_t input, int k) {
        const AgentId agent(input);
        return model.delay_at_least(agent, free_delay(model, agent) + k);
      }) {
  std::vector<Cost> free_costs;
  for (const AgentId i : model.instance().agent_ids()) {
    const Cost cost = model.free_cost(i);
    free_costs.push_back(cost);
    wanted_cap_.push_back(free_delay(model, i));
    if (model.objective() == Objective::sum_of_costs)
      lower_bound_ += cost;
    else
      lower_bound_ = std::max(lower_bound_, cost);
  }
  if (engine.proof() != nullptr)
    engine.proof()->set_inputs_beyond(total_.proof_number(), free_costs);
}

Timestep MddProblem::allowed_delay(AgentId agent, Cost bound) const {
  if (model_.objective() == Objective::sum_of_costs)
    return free_delay(model_, agent) + static_cast<Timestep>(bound - lower_bound_);
  return static_cast<Timestep>(bound - model_.mdd(agent).distance());
}

bool MddProblem::assume_at_most(Cost bound, LimitMonitor& limits, std::vector<Lit>& assumptions) {
  for (const AgentId i : model_.instance().agent_ids()) {
    const Timestep allowed = allowed_delay(i, bound);
    const Timestep cap = growth_ == MddGrowth::full ? allowed : std::min(allowed, wanted_cap_[i]);
    if (!model_.extend(i, cap, limits)) return false;
  }
  if (eager_ != nullptr && !eager_->extend(engine_, limits)) return false;
  for (const AgentId i : model_.instance().agent_ids())
    assumptions.push_back(~model_.delay_at_least(i, model_.cap(i) + 1));
  if (model_.objective() == Objective::sum_of_costs) {
    const Lit too_much = total_.at_least(static_cast<int>(bound - lower_bound_) + 1);
    if (too_much.valid()) assumptions.push_back(~too_much);
  }
  if (theory_ != nullptr) theory_->on_extended();
  return true;
}

bool MddProblem::accept_model() {
  const auto is_true = [&](Lit lit) { return engine_.model_value(lit); };
  ++num_checks_;
  plan_ = {};
  for (const AgentId i : model_.instance().agent_ids())
    plan_.paths.push_back(model_.extract_path(i, is_true));
  CollisionClauses clauses(model_);
  std::vector<PathCollision> collisions = find_collisions(model_.instance(), plan_);
  const CollisionClauses::Sink sink = [&](const sat::Lemma& lemma) { engine_.add_clause(lemma); };
  for (const PathCollision& c : collisions) clauses.exclude(c, is_true, sink);
  if (!collisions.empty()) ++num_rejected_;
  return collisions.empty();
}

bool MddProblem::grow_to(AgentId agent, Cost cost, LimitMonitor& limits) {
  return model_.extend(agent, static_cast<Timestep>(cost - model_.mdd(agent).distance()), limits) &&
         (eager_ == nullptr || eager_->extend(engine_, limits));
}

Lit MddProblem::cost_above(AgentId agent, Cost cost) {
  return model_.delay_at_least(agent,
                               static_cast<Timestep>(cost - model_.mdd(agent).distance()) + 1);
}

void MddProblem::on_solve(bool) {
  if (theory_ != nullptr) theory_->on_extended();
}

Cost MddProblem::next_bound(Cost refuted, std::span<const Lit> core) {
  bool grown = false;
  for (const Lit lit : core) {
    const auto var = model_.variable(lit);
    if (var.kind != MddModel::VariableKind::delay) continue;
    const Timestep cap = model_.cap(var.agent), allowed = allowed_delay(var.agent, refuted);
    if (var.number != cap + 1 || cap >= allowed) continue;
    // Sums are tight, so small steps; the makespan leaves most agents plenty.
    wanted_cap_[var.agent] =
        model_.objective() == Objective::sum_of_costs ? cap + 1 : std::min(allowed, 2 * cap + 1);
    grown = true;
  }
  return grown ? refuted : refuted + 1;
}

}  // namespace quadrille::discrete
