// SPDX-License-Identifier: MIT
#include "mdd/mdd_model.hpp"

#include <algorithm>
#include <iterator>

#include "mdd/usages.hpp"

namespace quadrille::discrete {

using sat::Lit;

MddModel::MddModel(const Instance& instance, Objective objective)
    : instance_(instance), objective_(objective), resident_(instance.graph().num_vertices(), 0) {
  for (const AgentId i : instance.agent_ids())
    resident_[instance.agents()[i].goal()] = i.value() + 1;
}

bool MddModel::attach(sat::Engine& engine, LimitMonitor& limits) {
  engine_ = &engine;
  agents_.reserve(instance_.num_agents());
  for (const AgentId i : instance_.agent_ids()) {
    if (limits.exhausted_now()) return false;
    agents_.push_back({MddPaths(instance_.graph(), instance_.agents()[i]), {}});
  }
  return true;
}

std::optional<AgentId> MddModel::resident(VertexId v) const {
  if (resident_[v] == 0) return std::nullopt;
  return AgentId(resident_[v] - 1);
}

Lit MddModel::new_lit(const Variable& variable) {
  const Lit lit = engine_->new_lit();
  const auto index = static_cast<std::size_t>(lit.variable());
  if (variables_.size() <= index) variables_.resize(index + 1);
  variables_[index] = variable;
  return lit;
}

MddModel::Variable MddModel::variable(Lit lit) const {
  const auto index = static_cast<std::size_t>(lit.variable());
  return index < variables_.size() ? variables_[index] : Variable();
}

Lit MddModel::delay_at_least(AgentId agent, Timestep delay) {
  QUADRILLE_REQUIRE(delay >= 1, "delays of zero need no literal");
  auto& delays = agents_[agent].delays;
  const auto [entry, is_new] = delays.try_emplace(delay);
  if (!is_new) return entry->second;
  const Lit lit = new_lit({VariableKind::delay, agent, VertexId(), delay});
  entry->second = lit;
  const auto implies = [&](Lit stronger, Lit weaker) {
    const Lit clause[] = {~stronger, weaker};
    engine_->add_clause({sat::why::Order{agent}, clause, {}, false});
  };
  if (const auto above = std::next(entry); above != delays.end()) implies(above->second, lit);
  if (entry != delays.begin()) implies(lit, std::prev(entry)->second);
  return lit;
}

Lit MddModel::find_delay(AgentId agent, Timestep delay) const {
  const auto& delays = agents_[agent].delays;
  const auto found = delays.find(delay);
  return found == delays.end() ? Lit() : found->second;
}

Lit MddModel::arrival_after(AgentId agent, Timestep t) const {
  const Timestep delay = t + 1 - mdd(agent).distance();
  if (delay < 1) return {};
  if (objective_ == Objective::makespan && delay <= cap(agent) + 1) return {};
  return find_delay(agent, delay);
}

// Called for each new X(v,t): the resident may have come to rest without a variable that says so.
void MddModel::prepare_rest(AgentId agent, VertexId v, Timestep t) {
  const auto other = resident(v);
  if (!other || *other == agent) return;
  const Timestep delay = t + 1 - mdd(*other).distance();
  if (delay > std::max(0, cap(*other) + 1)) static_cast<void>(delay_at_least(*other, delay));
}

class MddModel::AgentFormula final : public MddPaths::Formula {
 public:
  AgentFormula(MddModel& model, AgentId agent) : model_(model), agent_(agent) {}
  Lit new_vertex(VertexId v, Timestep t) override {
    const Lit lit = model_.new_lit({VariableKind::vertex, agent_, v, t});
    model_.prepare_rest(agent_, v, t);
    return lit;
  }
  Lit delay_at_least(Timestep delay) override { return model_.delay_at_least(agent_, delay); }
  void add(std::span<const Lit> clause) override {
    model_.engine_->add_clause({sat::why::Path{agent_}, clause, {}, false});
  }
  bool charges_delays() const override { return model_.objective_ == Objective::sum_of_costs; }

 private:
  MddModel& model_;
  AgentId agent_;
};

bool MddModel::extend(AgentId agent, Timestep new_cap, LimitMonitor& limits) {
  AgentFormula formula(*this, agent);
  return agents_[agent].paths.extend(instance_.graph(), new_cap, formula, &limits);
}

}  // namespace quadrille::discrete
