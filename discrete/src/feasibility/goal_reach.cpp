// SPDX-License-Identifier: MIT
#include "feasibility/goal_reach.hpp"

#include <algorithm>
#include <utility>

#include "model/breadth_first.hpp"

namespace quadrille::discrete {

std::optional<GoalReach> find_goal_reach(const Instance& instance, LimitMonitor& limits) {
  GoalReach reach;
  for (const Agent& task : instance.agents().items()) {
    const auto own = task.goals.vertices();
    reach.goals.insert(reach.goals.end(), own.begin(), own.end());
  }
  // Where many share many, this is the largest part of all.
  if (!limits.has_room_for(2 * reach.goals.size() * sizeof(Reach))) return std::nullopt;
  std::sort(reach.goals.begin(), reach.goals.end());
  reach.goals.erase(std::unique(reach.goals.begin(), reach.goals.end()), reach.goals.end());
  BreadthFirst search(instance.graph());
  for (const Agent& task : instance.agents().items()) {
    if (limits.exhausted_now() || !search.run(task.start, &limits)) return std::nullopt;
    std::vector<Reach>& own = reach.agents.emplace_back();
    for (const VertexId goal : task.goals.vertices()) {
      const Timestep d = search.distances()[goal.index()];
      if (d == kUnreachable) continue;
      const auto at = std::lower_bound(reach.goals.begin(), reach.goals.end(), goal);
      own.push_back({static_cast<std::size_t>(at - reach.goals.begin()), d});
    }
    std::stable_sort(own.begin(), own.end(),
                     [](const Reach& a, const Reach& b) { return a.cost < b.cost; });
  }
  return reach;
}

std::optional<PricedGoals> price_goals(const Instance& instance, LimitMonitor& limits) {
  const auto reach = find_goal_reach(instance, limits);
  if (!reach) return std::nullopt;
  auto assignment = cheapest_assignment(reach->agents, reach->goals.size(), limits);
  if (!assignment) return std::nullopt;
  const std::vector<bool> may_be_left = may_be_left_over(reach->agents, reach->goals.size());
  GoalPrices prices(instance.graph().num_vertices(), 0);
  PricedGoals priced;
  for (std::size_t k = 0; k < reach->goals.size(); ++k) {
    prices[reach->goals[k]] = static_cast<Timestep>(assignment->prices[k]);
    priced.paid += assignment->prices[k];
    if (assignment->prices[k] > 0 && may_be_left[k]) priced.left_over.push_back(reach->goals[k]);
  }
  if (priced.paid == 0) return std::nullopt;
  priced.distances = GoalDistances::make(instance, prices, limits);
  if (!priced.distances) return std::nullopt;
  priced.prices = std::make_shared<const GoalPrices>(std::move(prices));
  return priced;
}

}  // namespace quadrille::discrete
