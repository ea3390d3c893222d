// SPDX-License-Identifier: MIT
#include "lazy/lazy_model.hpp"

#include <algorithm>
#include <utility>

#include "paths/lone_agents.hpp"

namespace quadrille::discrete {

using sat::Lit;

LazyModel::LazyModel(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                     std::shared_ptr<const GoalPrices> prices, std::vector<VertexId> left_over)
    : Vocabulary(instance.num_agents(), Costs::negative),
      instance_(instance),
      goal_distances_(std::move(distances)),
      prices_(std::move(prices)),
      left_over_(std::move(left_over)) {
  if (!instance.rules().blockages.empty())
    blocked_ = std::make_shared<const BlockedTimes>(instance);
  distances_.reserve(instance.num_agents());
  for (const AgentId i : instance.agent_ids())
    distances_.emplace_back(instance, *goal_distances_, i, prices_.get(), blocked_.get());
  if (instance.is_plain()) return;
  LoneAgents lone(instance.graph().num_vertices(), nullptr);
  for (AgentDistances& own : distances_) own.set_free_cost(*lone.find_cost(own));
}

Lit LazyModel::new_vertex(AgentId agent, Visit visit, FormulaWriter& writer) {
  visits_.push_back(visit);
  return new_own(agent, static_cast<std::uint32_t>(visits_.size() - 1), writer);
}

std::optional<ObstacleId> LazyModel::find_user(const Users& users, AgentId agent) const {
  for (const ObstacleId id : users)
    if (obstacles_[id].agent == agent) return id;
  return std::nullopt;
}

void LazyModel::join(Users& users, ObstacleId newcomer, const sat::Why& why,
                     FormulaWriter& writer) {
  const auto usage_of = [&](ObstacleId id) { return sat::Usage{obstacles_[id].agent, id.value()}; };
  for (const ObstacleId other : users) {
    const Lit clause[] = {~obstacles_[other].allowed, ~obstacles_[newcomer].allowed};
    const sat::Usage usages[] = {usage_of(other), usage_of(newcomer)};
    writer.add({why, clause, usages, false});
  }
  users.push_back(newcomer);
}

ObstacleId LazyModel::point(AgentId agent, Visit visit, FormulaWriter& writer) {
  Users& users = points_[static_cast<std::uint64_t>(visit.timestep) << 32 | visit.vertex.value()];
  if (const auto known = find_user(users, agent)) return *known;
  const ObstacleId made = obstacles_.add_point(agent, make_usage(agent, writer), visit);
  join(users, made, sat::why::Vertex{}, writer);
  return made;
}

ObstacleId LazyModel::window(AgentId agent, VertexId v, Timestep first, FormulaWriter& writer) {
  const Timestep robust = instance_.rules().robust;
  if (robust == 0) return point(agent, {v, first}, writer);
  Users& users = windows_[static_cast<std::uint64_t>(first) << 32 | v.value()];
  if (const auto known = find_user(users, agent)) return *known;
  const ObstacleId made =
      obstacles_.add_range(agent, make_usage(agent, writer), v, first, first + robust);
  join(users, made, sat::why::Vertex{}, writer);
  return made;
}

ObstacleId LazyModel::edge(AgentId agent, VertexId u, VertexId v, Timestep t,
                           FormulaWriter& writer) {
  if (v < u) std::swap(u, v);
  Users& users = edges_[{u, v, t}];
  if (const auto known = find_user(users, agent)) return *known;
  const ObstacleId made = obstacles_.add_edge(agent, make_usage(agent, writer), u, v, t);
  join(users, made, sat::why::Edge{}, writer);
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

ObstacleId LazyModel::end(AgentId agent, VertexId goal, FormulaWriter& writer) {
  Users& users = ends_[goal];
  if (const auto known = find_user(users, agent)) return *known;
  const ObstacleId made = obstacles_.add_end(agent, make_usage(agent, writer), goal);
  join(users, made, sat::why::Goal{agent}, writer);
  return made;
}

ObstacleId LazyModel::elsewhere(AgentId agent, VertexId goal, FormulaWriter& writer) {
  const auto key = std::make_pair(agent, goal);
  if (const auto known = elsewheres_.find(key); known != elsewheres_.end()) return known->second;
  const Lit allowed = make_usage(agent, writer);
  return elsewheres_[key] = obstacles_.add_elsewhere(agent, allowed, goal);
}

void LazyModel::take(VertexId goal, FormulaWriter& writer) {
  std::vector<MayEndElsewhere> all;
  for (const AgentId i : instance_.agent_ids()) {
    if (!instance_.agents()[i].goals.contains(goal)) continue;
    const ObstacleId id = elsewhere(i, goal, writer);
    all.push_back({i, id, obstacles_[id].allowed});
  }
  take(goal, all, writer);
}

ObstacleId LazyModel::keep_off_goal(AgentId agent, AgentId resident, Visit goal,
                                    FormulaWriter& writer) {
  Rest rest{resident, goal.vertex, Cost{goal.timestep} + price(goal.vertex) + 1};
  if (!instance_.agents()[resident].goals.is_single())
    rest.may_end = obstacles_[end(resident, goal.vertex, writer)].allowed;
  return goal_obstacle(agent, rest, writer,
                       [&](Lit allowed) {
                         const Timestep robust = instance_.rules().robust;
                         return obstacles_.add_range(agent, allowed, goal.vertex,
                                                     std::max(0, goal.timestep - robust), kForever);
                       })
      .first;
}

}  // namespace quadrille::discrete
