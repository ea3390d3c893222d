// SPDX-License-Identifier: MIT
#include "solve/priced_goals.hpp"

#include <algorithm>
#include <utility>

#include "feasibility/goal_reach.hpp"
#include "quadrille/continuous/under_way.hpp"

namespace quadrille::continuous {
namespace {

/// Whether the agent pays as much longer as the price is. Not if its arrival is too late then, nor
/// if it is at its goal before it may move.
bool can_pay(const Agent& agent) {
  return !agent.deadline && (agent.release == 0 || !agent.goals.contains(agent.start));
}

}  // namespace

std::optional<PricedGoals> PricedGoals::make(const Instance& instance, LimitMonitor& limits) {
  const auto& agents = instance.agents();
  const bool can_all_pay = std::all_of(agents.begin(), agents.end(), [](const Agent& agent) {
    return agent.leaves || can_pay(agent);
  });
  if (!instance.has_goal_sets() || !can_all_pay) return std::nullopt;
  const auto found = find_goal_reach(instance, limits);
  if (!found) return std::nullopt;
  const std::vector<VertexId>& goals = found->goals;
  const auto assignment = cheapest_assignment(found->reach, goals.size(), limits);
  if (!assignment) return std::nullopt;
  const std::vector<bool> may_be_left = may_be_left_over(found->reach, goals.size());
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
    const ShapeId shape = instance.roadmap().shape(price.goal);
    parts.vertices.push_back(instance.roadmap().position(price.goal));
    if (!parts.shapes.empty()) parts.shapes.push_back(shape);
    parts.edges.push_back({price.goal, price.end, price.ticks, Groups::all(), shape});
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
  priced_ = made->with_whole_moves(instance.has_whole_moves());
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
