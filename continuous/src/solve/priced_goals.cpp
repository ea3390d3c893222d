// SPDX-License-Identifier: MIT
#include "solve/priced_goals.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "paths/earliest_visits.hpp"
#include "quadrille/continuous/under_way.hpp"
#include "quadrille/core/assignment.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous {
namespace {

/// Whether the agent pays as much longer as the price is. Not if its arrival is too late then, nor
/// if it is at its goal before it may move.
bool can_pay(const Agent& agent) {
  return !agent.deadline && (agent.release == 0 || !agent.goals.contains(agent.start));
}

/// Whether no two agents that stay can end in one place. Polygons may lie beside their positions.
bool are_in_each_others_way(const Instance& instance) {
  std::vector<ClassId> classes;
  for (const AgentId i : instance.agent_ids())
    if (!instance.agent(i).leaves) classes.push_back(instance.class_of(i));
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
  for (const ClassId a : classes)
    for (const ClassId b : classes) {
      const auto& body = instance.body(a);
      if (std::holds_alternative<Disc>(body)) break;  // with discs pairs are seen from there
      if (!geometry::bodies_overlap(body, Point{}, instance.body(b), Point{})) return false;
    }
  return true;
}

/// Goals of the agents that stay, increasing.
std::vector<VertexId> goals_to_rest_at(const Instance& instance) {
  std::vector<VertexId> goals;
  for (const Agent& agent : instance.agents()) {
    if (agent.leaves) continue;
    const auto own = agent.goals.vertices();
    goals.insert(goals.end(), own.begin(), own.end());
  }
  std::sort(goals.begin(), goals.end());
  goals.erase(std::unique(goals.begin(), goals.end()), goals.end());
  return goals;
}

/// Of the agents that stay, when each can be where. nullopt if a limit was met.
std::optional<std::vector<std::vector<Reach>>> find_reach(const Instance& instance,
                                                          const std::vector<VertexId>& goals,
                                                          LimitMonitor& limits) {
  std::size_t num_pairs = 0;
  for (const Agent& agent : instance.agents()) num_pairs += agent.goals.size();
  if (!limits.has_room_for(num_pairs * sizeof(Reach))) return std::nullopt;
  std::vector<std::vector<Reach>> reach;
  for (const AgentId i : instance.agent_ids()) {
    const Agent& agent = instance.agent(i);
    if (agent.leaves) continue;
    if (limits.exhausted_now()) return std::nullopt;
    const std::vector<Ticks> visits = earliest_visits(instance, i);
    std::vector<Reach>& own = reach.emplace_back();
    for (const VertexId goal : agent.goals.vertices()) {
      if (visits[goal.index()] >= kForever) continue;
      const auto at = std::lower_bound(goals.begin(), goals.end(), goal);
      own.push_back({static_cast<std::size_t>(at - goals.begin()), as_cost(visits[goal.index()])});
    }
  }
  return reach;
}

}  // namespace

std::optional<PricedGoals> PricedGoals::make(const Instance& instance, LimitMonitor& limits) {
  const auto& agents = instance.agents();
  const bool can_all_pay = std::all_of(agents.begin(), agents.end(), [](const Agent& agent) {
    return agent.leaves || can_pay(agent);
  });
  if (!instance.has_goal_sets() || !can_all_pay || !are_in_each_others_way(instance))
    return std::nullopt;
  const std::vector<VertexId> goals = goals_to_rest_at(instance);
  const auto reach = find_reach(instance, goals, limits);
  if (!reach) return std::nullopt;
  const auto assignment = cheapest_assignment(*reach, goals.size(), limits);
  if (!assignment) return std::nullopt;
  const std::vector<bool> may_be_left = may_be_left_over(*reach, goals.size());
  PricedGoals priced;
  std::size_t next = instance.roadmap().num_vertices();
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const Cost price = assignment->prices[k];
    if (price == 0) continue;
    const VertexId end(next++);
    priced.prices_.push_back({goals[k], end, Ticks(price)});
    priced.paid_ += price;
    if (may_be_left[k]) priced.fees_.push_back({end, price});
  }
  if (priced.paid_ == 0 || !priced.build(instance)) return std::nullopt;
  return priced;
}

bool PricedGoals::build(const Instance& instance) {
  RoadmapParts parts(instance.roadmap());
  for (const Price& price : prices_) {
    parts.vertices.push_back(instance.roadmap().position(price.goal));
    parts.edges.push_back({price.goal, price.end, price.ticks});
  }
  auto roadmap = std::move(parts).make();
  if (!roadmap) return false;
  std::vector<Agent> agents;
  for (const Agent& agent : instance.agents()) {
    agents.push_back(agent);
    if (agent.leaves) continue;
    std::vector<VertexId> ends;
    for (const VertexId goal : agent.goals.vertices()) {
      const Price* const price = find(goal);
      ends.push_back(price == nullptr ? goal : price->end);
    }
    agents.back().goals = Goals(std::move(ends));
  }
  auto made = Instance::make(std::move(roadmap).value(), std::move(agents), instance.resolution(),
                             {}, instance.obstacles());
  if (!made) return false;
  priced_ = std::move(made).value();
  return true;
}

const PricedGoals::Price* PricedGoals::find(VertexId goal) const {
  const auto at = std::lower_bound(prices_.begin(), prices_.end(), goal,
                                   [](const Price& price, VertexId v) { return price.goal < v; });
  return at != prices_.end() && at->goal == goal ? &*at : nullptr;
}

void PricedGoals::enter(Plan& plan) const {
  for (const AgentId i : priced_->agent_ids()) {
    if (priced_->agent(i).leaves) continue;
    Path& path = plan.paths[i];
    const Price* const price = find(path.back().vertex);
    if (price == nullptr) continue;
    const Ticks done = path.back().arrive + price->ticks;
    path.push_back({price->end, done, done});
  }
}

void PricedGoals::leave(Plan& plan) const {
  for (Path& path : plan.paths) {
    const bool has_paid =
        path.size() > 1 && !prices_.empty() && path.back().vertex >= prices_.front().end;
    if (!has_paid) continue;
    path.pop_back();
    path.back().depart = path.back().arrive;
  }
}

}  // namespace quadrille::continuous
