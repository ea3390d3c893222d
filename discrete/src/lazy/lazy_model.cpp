// SPDX-License-Identifier: MIT
#include "lazy/lazy_model.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

using sat::Lit;

LazyModel::LazyModel(const Instance& instance, std::shared_ptr<const GoalDistances> distances)
    : instance_(instance), goal_distances_(std::move(distances)), costs_(instance.num_agents()) {
  distances_.reserve(instance.num_agents());
  for (const AgentId i : instance.agent_ids())
    distances_.emplace_back(instance, *goal_distances_, i);
}

void LazyModel::remember(Lit lit, const Variable& variable) {
  const auto index = static_cast<std::size_t>(lit.variable());
  if (variables_.size() <= index) variables_.resize(index + 1);
  variables_[index] = variable;
}

LazyModel::Variable LazyModel::variable(Lit lit) const {
  const auto index = static_cast<std::size_t>(lit.variable());
  return index < variables_.size() ? variables_[index] : Variable{};
}

Lit LazyModel::cost_above(AgentId agent, Timestep cost, FormulaWriter& writer) {
  QUADRILLE_REQUIRE(cost >= distances(agent).free_cost(), "nobody costs less than its free cost");
  auto& known = costs_[agent];
  const auto at = std::lower_bound(known.begin(), known.end(), cost,
                                   [](const CostLiteral& c, Timestep k) { return c.cost < k; });
  if (at != known.end() && at->cost == cost) return at->above;
  const Lit above = ~writer.new_lit();
  remember(above, {VariableKind::cost, agent, ObstacleId(), cost, {}});
  const auto index = static_cast<std::size_t>(at - known.begin());
  known.insert(at, {cost, above});
  const auto order = [&](Lit stronger, Lit weaker) {
    const Lit clause[] = {~stronger, weaker};
    writer.add({sat::LemmaKind::order, clause, {}, false});
  };
  if (index > 0) order(above, known[index - 1].above);
  if (index + 1 < known.size()) order(known[index + 1].above, above);
  return above;
}

Lit LazyModel::make_usage(AgentId agent, FormulaWriter& writer) {
  const Lit allowed = ~writer.new_lit();
  remember(allowed, {VariableKind::usage, agent, ObstacleId(obstacles_.size()), 0, {}});
  return allowed;
}

Lit LazyModel::new_vertex(AgentId agent, Visit visit, FormulaWriter& writer) {
  const Lit at = writer.new_lit();
  remember(at, {VariableKind::vertex, agent, ObstacleId(), 0, visit});
  return at;
}

std::optional<ObstacleId> LazyModel::find_user(const Users& users, AgentId agent) const {
  for (const ObstacleId id : users)
    if (obstacles_[id].agent == agent) return id;
  return std::nullopt;
}

void LazyModel::join(Users& users, ObstacleId newcomer, FormulaWriter& writer) {
  const auto usage_of = [&](ObstacleId id) { return sat::Usage{obstacles_[id].agent, id.value()}; };
  for (const ObstacleId other : users) {
    const Lit clause[] = {~obstacles_[other].allowed, ~obstacles_[newcomer].allowed};
    const sat::Usage usages[] = {usage_of(other), usage_of(newcomer)};
    writer.add({sat::LemmaKind::collision, clause, usages, false});
  }
  users.push_back(newcomer);
}

ObstacleId LazyModel::point(AgentId agent, Visit visit, FormulaWriter& writer) {
  Users& users = points_[static_cast<std::uint64_t>(visit.timestep) << 32 | visit.vertex.value()];
  if (const auto known = find_user(users, agent)) return *known;
  const ObstacleId made = obstacles_.add_point(agent, make_usage(agent, writer), visit);
  join(users, made, writer);
  return made;
}

ObstacleId LazyModel::edge(AgentId agent, VertexId u, VertexId v, Timestep t,
                           FormulaWriter& writer) {
  if (v < u) std::swap(u, v);
  Users& users = edges_[{u, v, t}];
  if (const auto known = find_user(users, agent)) return *known;
  const ObstacleId made = obstacles_.add_edge(agent, make_usage(agent, writer), u, v, t);
  join(users, made, writer);
  return made;
}

ObstacleId LazyModel::range(AgentId agent, VertexId v, Timestep first, Timestep last,
                            FormulaWriter& writer) {
  if (first == last) return point(agent, {v, first}, writer);
  const auto key = std::make_tuple(agent, v, first, last);
  if (const auto known = ranges_.find(key); known != ranges_.end()) return known->second;
  const Lit allowed = make_usage(agent, writer);
  return ranges_[key] = obstacles_.add_range(agent, allowed, v, first, last);
}

ObstacleId LazyModel::barrier(AgentId agent, std::span<const Visit> visits, FormulaWriter& writer) {
  if (visits.size() == 1) return point(agent, visits[0], writer);
  const auto key = std::make_tuple(agent, visits.front(), visits.back());
  if (const auto known = barriers_.find(key); known != barriers_.end()) return known->second;
  const Lit allowed = make_usage(agent, writer);
  return barriers_[key] = obstacles_.add_barrier(agent, allowed, visits);
}

ObstacleId LazyModel::keep_off_goal(AgentId agent, AgentId resident, Timestep t,
                                    FormulaWriter& writer) {
  const auto key = std::make_tuple(agent, resident, t);
  if (const auto known = targets_.find(key); known != targets_.end()) return known->second;
  const Lit above = cost_above(resident, t, writer);
  const VertexId goal = distances(resident).goal();
  return targets_[key] = obstacles_.add_range(agent, above, goal, t, kForever);
}

}  // namespace quadrille::discrete
