// SPDX-License-Identifier: MIT
#include "mdd_model.hpp"

#include <algorithm>
#include <iterator>

#include "usages.hpp"

namespace quadrille::discrete {

using sat::Lit;

MddModel::MddModel(const Instance& instance, Objective objective)
    : instance_(instance), objective_(objective), resident_(instance.graph().num_vertices(), 0) {
  for (const AgentId i : instance.agents()) resident_[instance.tasks()[i].goal] = i.value() + 1;
}

bool MddModel::attach(sat::Engine& engine, LimitMonitor& limits) {
  engine_ = &engine;
  agents_.reserve(instance_.num_agents());
  for (const AgentId i : instance_.agents()) {
    if (limits.exhausted_now()) return false;
    agents_.push_back({Mdd(instance_.graph(), instance_.tasks()[i]), {}, {}});
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

Lit MddModel::at(AgentId agent, VertexId v, Timestep t) const {
  const Agent& a = agents_[agent];
  if (a.mdd.to_goal(v) == kUnreachable) return {};
  const Timestep slack = a.mdd.slack(v, t);
  if (slack < 0 || slack > cap(agent)) return {};
  const auto& layer = a.layers[static_cast<std::size_t>(slack)];
  const std::uint32_t rank = a.mdd.rank(v);
  return rank < layer.size() ? layer[rank] : Lit();
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
    const sat::Usage usages[] = {path_usage(agent)};
    engine_->add_clause({sat::LemmaKind::order, clause, usages, false});
  };
  if (const auto above = std::next(entry); above != delays.end()) implies(above->second, lit);
  if (entry != delays.begin()) implies(lit, std::prev(entry)->second);
  return lit;
}

Lit MddModel::arrival_after(AgentId agent, Timestep t) const {
  const Timestep delay = t + 1 - agents_[agent].mdd.distance();
  if (delay < 1) return {};
  if (objective_ == Objective::makespan && delay <= cap(agent) + 1) return {};
  const auto& delays = agents_[agent].delays;
  const auto found = delays.find(delay);
  return found == delays.end() ? Lit() : found->second;
}

void MddModel::add_path_clause(AgentId agent, const std::vector<Lit>& clause) {
  const sat::Usage usages[] = {path_usage(agent)};
  engine_->add_clause({sat::LemmaKind::path, clause, usages, false});
}

void MddModel::make_layer(AgentId agent, Timestep slack) {
  Agent& a = agents_[agent];
  auto& layer = a.layers.emplace_back();
  const std::size_t size = a.mdd.reach(instance_.graph(), slack);
  layer.reserve(size);
  for (std::size_t rank = 0; rank < size; ++rank) {
    const VertexId v = a.mdd.vertex(rank);
    const Timestep t = a.mdd.timestep(v, slack);
    layer.push_back(new_lit({VariableKind::vertex, agent, v, t}));
    // The resident may have come to rest without a variable that says so.
    if (const auto other = resident(v); other && *other != agent) {
      const Timestep delay = t + 1 - agents_[*other].mdd.distance();
      if (delay > std::max(0, cap(*other) + 1)) static_cast<void>(delay_at_least(*other, delay));
    }
  }
}

// X(v,t) -> C(slack) unless v is the goal: who is elsewhere at t arrives no earlier than t + h(v).
void MddModel::add_delay_clauses(AgentId agent, Timestep slack) {
  if (slack == 0 || objective_ != Objective::sum_of_costs) return;
  Agent& a = agents_[agent];
  const Lit late = delay_at_least(agent, slack);
  const auto& layer = a.layers[static_cast<std::size_t>(slack)];
  for (std::size_t rank = 0; rank < layer.size(); ++rank) {
    if (a.mdd.vertex(rank) == a.mdd.task().goal) continue;
    scratch_ = {~layer[rank], late};
    add_path_clause(agent, scratch_);
  }
}

// X(w,t+1) -> one of X(v,t). Final, because predecessors have no larger slack.
void MddModel::add_predecessor_clauses(AgentId agent, Timestep slack) {
  const Agent& a = agents_[agent];
  const auto& layer = a.layers[static_cast<std::size_t>(slack)];
  for (std::size_t rank = 0; rank < layer.size(); ++rank) {
    const VertexId w = a.mdd.vertex(rank);
    const Timestep t = a.mdd.timestep(w, slack);
    if (t == 0) continue;
    scratch_ = {~layer[rank]};
    const auto add = [&](VertexId v) {
      if (const Lit before = at(agent, v, t - 1); before.valid()) scratch_.push_back(before);
    };
    add(w);
    for (const VertexId v : instance_.graph().neighbours(w)) add(v);
    add_path_clause(agent, scratch_);
  }
}

// X(v,t) -> one of X(w,t+1) or C(cap+1), without the guard if no successor lies beyond the cap.
// For v in an old layer only if its clause had the guard of the old cap. At the goal only once it
// is complete: an agent at rest needs no successors, and a guard would forbid it to finish.
void MddModel::add_successor_clauses(AgentId agent, Timestep slack, Timestep old_cap) {
  const Timestep new_cap = cap(agent);
  const Agent& a = agents_[agent];
  const Lit guard = a.delays.at(new_cap + 1);
  const auto& layer = a.layers[static_cast<std::size_t>(slack)];
  for (std::size_t rank = 0; rank < layer.size(); ++rank) {
    const VertexId v = a.mdd.vertex(rank);
    const bool is_goal = v == a.mdd.task().goal;
    if (is_goal && slack + 2 > new_cap) continue;
    const Timestep t = a.mdd.timestep(v, slack);
    scratch_ = {~layer[rank]};
    Timestep largest = 0;
    const auto add = [&](VertexId w) {
      const Timestep next_slack = a.mdd.slack(w, t + 1);
      largest = std::max(largest, next_slack);
      if (next_slack <= new_cap) scratch_.push_back(at(agent, w, t + 1));
    };
    add(v);
    for (const VertexId w : instance_.graph().neighbours(v)) add(w);
    const bool was_complete = slack <= old_cap && (is_goal ? slack + 2 : largest) <= old_cap;
    if (was_complete) continue;
    if (largest > new_cap) scratch_.push_back(guard);
    add_path_clause(agent, scratch_);
  }
}

bool MddModel::extend(AgentId agent, Timestep new_cap, LimitMonitor& limits) {
  const Timestep old_cap = cap(agent);
  if (new_cap <= old_cap) return true;
  Agent& a = agents_[agent];
  if (a.mdd.distance() + new_cap >= kMaxTimestep) return false;
  for (Timestep slack = old_cap + 1; slack <= new_cap; ++slack) {
    if (limits.exhausted_now()) return false;
    make_layer(agent, slack);
  }
  const Lit guard = delay_at_least(agent, new_cap + 1);
  if (old_cap < 0) {
    scratch_ = {at(agent, a.mdd.task().start, 0)};
    add_path_clause(agent, scratch_);
  }
  scratch_ = {at(agent, a.mdd.task().goal, a.mdd.distance() + new_cap), guard};
  add_path_clause(agent, scratch_);
  for (Timestep slack = std::max(0, old_cap - 1); slack <= new_cap; ++slack) {
    if (limits.exhausted_now()) return false;
    if (slack > old_cap) {
      add_delay_clauses(agent, slack);
      add_predecessor_clauses(agent, slack);
    }
    add_successor_clauses(agent, slack, old_cap);
  }
  return true;
}

}  // namespace quadrille::discrete
