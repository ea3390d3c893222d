// SPDX-License-Identifier: MIT
#include "mdd/mdd_model.hpp"

#include <algorithm>
#include <iterator>

#include "mdd/usages.hpp"

namespace quadrille::discrete {

using sat::Lit;

bool MddModel::knows(const Instance& instance) {
  return !instance.poses() &&
         std::all_of(instance.agents().begin(), instance.agents().end(),
                     [](const auto& agent) { return agent.waypoints.empty(); });
}

MddModel::MddModel(const Instance& instance, Objective objective)
    : instance_(instance),
      objective_(objective),
      blocked_(instance),
      residents_(instance.graph().num_vertices()) {
  for (const AgentId i : instance.agent_ids())
    if (!instance.agents()[i].leaves)
      for (const VertexId goal : instance.agents()[i].goals.vertices())
        residents_[goal].push_back(i);
}

bool MddModel::attach(sat::Engine& engine, LimitMonitor& limits, IdVector<AgentId, Timestep> lone) {
  engine_ = &engine;
  lone_ = std::move(lone);
  agents_.reserve(instance_.num_agents());
  for (const AgentId i : instance_.agent_ids()) {
    if (limits.exhausted_now()) return false;
    const Goals& goals = instance_.agents()[i].goals;
    std::vector<Lit> ends;
    if (!goals.is_single())
      for (const VertexId goal : goals.vertices())
        ends.push_back(new_lit({VariableKind::end, i, goal, 0}));
    agents_.push_back({MddPaths(instance_.graph(), instance_.agents()[i]), {}, std::move(ends)});
  }
  return true;
}

Lit MddModel::end_at(AgentId agent, VertexId goal) const {
  const Agent& own = agents_[agent];
  if (own.ends.empty()) return {};
  const auto goals = instance_.agents()[agent].goals.vertices();
  const auto found = std::lower_bound(goals.begin(), goals.end(), goal);
  return own.ends[static_cast<std::size_t>(found - goals.begin())];
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

// Called for each new X(v,t): a resident may have come to rest without a variable that says so.
void MddModel::prepare_rest(AgentId agent, VertexId v, Timestep t) {
  for (const AgentId other : residents(v)) {
    if (other == agent) continue;
    const Timestep delay = t + robust() + 1 - mdd(other).distance();
    if (delay > std::max(0, cap(other) + 1)) static_cast<void>(delay_at_least(other, delay));
  }
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
  Lit end_at(VertexId goal) override { return model_.end_at(agent_, goal); }
  void add(std::span<const Lit> clause) override {
    model_.engine_->add_clause({sat::why::Path{agent_}, clause, {}, false});
  }
  bool charges_delays() const override {
    const auto& task = model_.instance_.agents()[agent_];
    return model_.objective_ == Objective::sum_of_costs || task.leaves || task.deadline;
  }

 private:
  MddModel& model_;
  AgentId agent_;
};

bool MddModel::extend(AgentId agent, Timestep new_cap, LimitMonitor& limits) {
  AgentFormula formula(*this, agent);
  const Timestep old_cap = cap(agent);
  if (!agents_[agent].paths.extend(instance_.graph(), new_cap, formula, &limits)) return false;
  if (!instance_.is_plain()) add_rules(agent, old_cap);
  return true;
}

Lit MddModel::gone(Lit x) const {
  const Variable var = variable(x);
  const auto& task = instance_.agents()[var.agent];
  if (!task.leaves || !task.goals.contains(var.vertex)) return {};
  const Timestep late = var.number - mdd(var.agent).distance();
  return late < 1 ? Lit() : ~find_delay(var.agent, late);
}

void MddModel::add_rules(AgentId agent, Timestep old_cap) {
  const auto& task = instance_.agents()[agent];
  AgentFormula formula(*this, agent);
  const auto add_unit = [&](Lit lit) { formula.add(std::span(&lit, 1)); };
  const Timestep distance = mdd(agent).distance();
  if (old_cap < 0) {
    if (task.deadline) add_unit(~delay_at_least(agent, *task.deadline + 1 - distance));
    for (const VertexId goal : task.goals.vertices()) {
      const Timestep free_from = task.leaves ? 0 : blocked_.free_from(goal);
      if (free_from <= distance) continue;
      std::vector<Lit> clause;
      if (!task.goals.is_single()) clause.push_back(~end_at(agent, goal));
      if (free_from < kForever) clause.push_back(delay_at_least(agent, free_from - distance));
      formula.add(clause);
    }
  }
  add_bans(agent, old_cap);
  const auto is_new = [&](VertexId v, Timestep t) { return mdd(agent).slack(v, t) > old_cap; };
  for (const Blockage& b : instance_.rules().blockages) {
    if (!b.to) continue;
    const Timestep last = std::min(b.last.value_or(kForever), distance + cap(agent));
    for (Timestep t = b.first; t <= last; ++t)
      for (const auto& [from, to] : {std::pair(b.vertex, *b.to), std::pair(*b.to, b.vertex)}) {
        const Lit x = at(agent, from, t), y = at(agent, to, t + 1);
        if (!x.valid() || !y.valid() || !(is_new(from, t) || is_new(to, t + 1))) continue;
        const Lit clause[] = {~x, ~y};
        formula.add(clause);
      }
  }
}

void MddModel::add_bans(AgentId agent, Timestep old_cap) {
  const auto& task = instance_.agents()[agent];
  AgentFormula formula(*this, agent);
  for (const VertexId v : IdRange<VertexId>(instance_.graph().num_vertices())) {
    const auto ban = [&](Timestep first, Timestep last) {
      if (mdd(agent).to_goal(v) == kUnreachable) return;
      const Timestep newest = mdd(agent).timestep(v, cap(agent));
      for (Timestep t = std::max(first, mdd(agent).timestep(v, old_cap + 1));
           t <= std::min(last, newest); ++t) {
        const Lit x = at(agent, v, t);
        if (!x.valid()) continue;
        const Lit clause[] = {~x, gone(x)};
        formula.add(std::span(clause, clause[1].valid() ? 2 : 1));
      }
    };
    if (v != task.start && task.release > 0) ban(0, task.release);
    for (const BlockedTimes::Span& span : blocked_.at(v)) ban(span.first, span.last);
  }
}

}  // namespace quadrille::discrete
