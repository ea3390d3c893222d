// SPDX-License-Identifier: MIT
#include "cost/relaxation.hpp"

#include "quadrille/core/contract.hpp"

namespace quadrille::sat {

bool Relaxation::start() {
  for (const AgentId i : IdRange<AgentId>(problem_.num_agents())) {
    if (!add_agent_soft(i, problem_.free_cost(i))) return false;
    bound_ += problem_.free_cost(i);
  }
  return true;
}

bool Relaxation::add_agent_soft(AgentId agent, Cost bound) {
  if (!problem_.grow_to(agent, bound, limits_)) return false;
  softs_.emplace(problem_.cost_above(agent, bound), Soft{nullptr, agent, bound});
  return true;
}

void Relaxation::add_counter_soft(Totalizer& counter, Cost bound) {
  softs_.emplace(counter.at_least(static_cast<int>(bound) + 1), Soft{&counter, AgentId(), bound});
}

std::vector<Lit> Relaxation::assumptions() const {
  std::vector<Lit> lits;
  for (const auto& [lit, soft] : softs_) lits.push_back(~lit);
  return lits;
}

bool Relaxation::relax(std::span<const Lit> core) {
  std::vector<Lit> violated;
  for (const Lit assumption : core) violated.push_back(~assumption);
  engine_.add_clause({LemmaKind::core, violated, {}, false});
  ++bound_;
  for (const Lit lit : violated) {
    const auto found = softs_.find(lit);
    QUADRILLE_REQUIRE(found != softs_.end(), "cores consist of softs");
    const Soft soft = found->second;
    softs_.erase(found);
    if (soft.counter != nullptr) {
      if (soft.bound + 1 < static_cast<Cost>(soft.counter->num_inputs()))
        add_counter_soft(*soft.counter, soft.bound + 1);
    } else if (!add_agent_soft(soft.agent, soft.bound + 1)) {
      return false;
    }
  }
  if (violated.size() > 1) {
    // The inputs are literals: numbers of 0 or 1.
    counters_.emplace_back(engine_, violated.size(), [violated](std::size_t input, int k) {
      return k == 1 ? violated[input] : Lit();
    });
    add_counter_soft(counters_.back(), 1);
  }
  return true;
}

Totalizer::Input Relaxation::excess() const {
  std::vector<Soft> items;
  for (const auto& [lit, soft] : softs_) items.push_back(soft);
  return [&problem = problem_, items](std::size_t input, int k) {
    const Soft& soft = items[input];
    const Cost beyond = soft.bound + k;
    if (soft.counter == nullptr) return problem.cost_above(soft.agent, beyond - 1);
    if (beyond > static_cast<Cost>(soft.counter->num_inputs())) return Lit();
    return soft.counter->at_least(static_cast<int>(beyond));
  };
}

void Relaxation::retire() {
  // Later counters have outputs of earlier ones as inputs.
  for (auto counter = counters_.rbegin(); counter != counters_.rend(); ++counter) counter->retire();
  softs_.clear();
}

}  // namespace quadrille::sat
