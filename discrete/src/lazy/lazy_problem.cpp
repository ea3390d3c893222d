// SPDX-License-Identifier: MIT
#include "lazy/lazy_problem.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/sat/proof_log.hpp"

namespace quadrille::discrete {

using sat::Lit;

LazyProblem::LazyProblem(LazyModel& model, sat::Engine& engine, LazyTheory& theory,
                         Objective objective)
    : model_(model),
      engine_(engine),
      theory_(theory),
      objective_(objective),
      writer_(engine),
      total_delay_(engine, model.instance().num_agents() + model.may_be_left_over().size(),
                   [this](std::size_t input, int k) { return delay(input, k); }) {
  for (const VertexId goal : model.may_be_left_over())
    fees_.push_back({model.left_over(goal, writer_), model.price(goal)});
  std::vector<Cost> free_costs;
  for (const AgentId i : model.instance().agent_ids()) {
    free_costs.push_back(free_cost(i));
    lower_bound_ = objective == Objective::sum_of_costs ? lower_bound_ + free_cost(i)
                                                        : std::max(lower_bound_, free_cost(i));
    // With a clause that says that it is false.
    if (const auto deadline = model.distances(i).deadline())
      static_cast<void>(model.cost_above(i, *deadline, writer_));
  }
  if (engine.proof() != nullptr)
    engine.proof()->set_inputs_beyond(total_delay_.proof_number(), free_costs);
}

Lit LazyProblem::delay(std::size_t input, int k) {
  if (input < num_agents()) {
    const AgentId agent(input);
    return model_.cost_above(agent, model_.distances(agent).free_cost() + k - 1, writer_);
  }
  const Fee& fee = fees_[input - num_agents()];
  return k <= fee.amount ? fee.due : Lit();
}

// Every agent gets a cap: what the bound leaves to it alone.
bool LazyProblem::assume_at_most(Cost bound, LimitMonitor&, std::vector<Lit>& assumptions) {
  const bool is_sum = objective_ == Objective::sum_of_costs;
  const Cost delay = bound - lower_bound_;
  for (const AgentId i : model_.instance().agent_ids()) {
    const Cost cap = is_sum ? free_cost(i) + delay : bound;
    assumptions.push_back(~model_.cost_above(i, static_cast<Timestep>(cap), writer_));
  }
  if (is_sum) {
    const Lit too_much = total_delay_.at_least(static_cast<int>(delay) + 1);
    if (too_much.valid()) assumptions.push_back(~too_much);
  }
  return true;
}

bool LazyProblem::accept_model() {
  QUADRILLE_REQUIRE(theory_.accepted().has_value(), "every agent had a bound");
  plan_ = *theory_.accepted();
  std::vector<VertexId> unpaid;
  for (std::size_t k = 0; k < fees_.size(); ++k)
    if (const VertexId goal = model_.may_be_left_over()[k];
        !engine_.model_value(fees_[k].due) && !is_taken(goal))
      unpaid.push_back(goal);
  // A clause ends the model.
  for (const VertexId goal : unpaid) model_.take(goal, writer_);
  return unpaid.empty();
}

bool LazyProblem::is_taken(VertexId goal) const {
  return std::any_of(plan_.paths.begin(), plan_.paths.end(),
                     [&](const Path& path) { return path.back() == goal; });
}

Cost LazyProblem::next_bound(Cost refuted, std::span<const Lit>) { return refuted + 1; }

Lit LazyProblem::cost_above(AgentId agent, Cost cost) {
  return model_.cost_above(agent, static_cast<Timestep>(cost), writer_);
}

std::vector<AgentId> LazyProblem::agents_of(std::span<const Lit> core) const {
  std::vector<AgentId> agents;
  for (const Lit lit : core) {
    const auto variable = model_.variable(lit);
    // The counter is about all agents.
    if (variable.kind != LazyModel::VariableKind::cost) return CostProblem::agents_of(core);
    agents.push_back(variable.agent);
  }
  std::sort(agents.begin(), agents.end());
  return agents;
}

void LazyProblem::on_solve(bool all_present) { theory_.on_solve(all_present); }

}  // namespace quadrille::discrete
