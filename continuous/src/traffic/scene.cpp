// SPDX-License-Identifier: MIT
#include "traffic/scene.hpp"

#include <algorithm>

#include "paths/obstacle_bans.hpp"

namespace quadrille::continuous {

bool ends_at(const Plan& plan, VertexId goal) {
  return std::any_of(plan.paths.begin(), plan.paths.end(),
                     [&](const Path& path) { return path.back().vertex == goal; });
}

Scene::Scene(const Instance& instance, LimitMonitor& limits, SceneStore* store,
             const Settings& settings)
    : instance_(instance),
      limits_(limits),
      settings_(settings),
      contacts_(instance, limits, store != nullptr ? &store->contacts() : nullptr) {
  distances_.reserve(instance.num_agents());
  detours_.reserve(instance.num_agents());
  for (const AgentId i : instance.agent_ids()) {
    if (limits.exhausted_now()) return;
    if (store != nullptr)
      distances_.push_back(store->distances(instance, i));
    else
      distances_.emplace_back(instance, i);
    detours_.emplace_back(instance, i, distances_.back());
  }
  standing_.resize(instance.num_classes());
  keep_moving();
  is_complete_ = instance.obstacles().empty() || avoid_obstacles();
}

Cost Scene::cost(const Plan& plan, Objective objective) const {
  Cost cost = continuous::cost(plan, objective);
  for (const Fee& fee : fees_)
    if (!ends_at(plan, fee.goal)) cost += fee.amount;
  return cost;
}

// A ban for a class is one for a single agent here: nobody else can be where it begins.
void Scene::keep_moving() {
  for (const AgentId i : instance_.agent_ids()) {
    const Agent& agent = instance_.agent(i);
    if (!agent.under_way) continue;
    const EdgeId rest_of_move = instance_.roadmap().out_edges(agent.start).front();
    standing_[instance_.class_of(i).index()].push_back(Ban::start(rest_of_move, {1, kForever}));
  }
  for (std::vector<Ban>& bans : standing_) std::sort(bans.begin(), bans.end());
}

bool Scene::avoid_obstacles() {
  for (const ClassId c : IdRange<ClassId>(instance_.num_classes())) {
    if (limits_.exhausted_now()) return false;
    std::vector<Ban>& bans = standing_[c.index()];
    const std::vector<Ban> around = bans_around_obstacles(instance_, c, limits_);
    bans.insert(bans.end(), around.begin(), around.end());
    std::sort(bans.begin(), bans.end());
  }
  PathFinder finder(instance_, &limits_);
  BanTable bans(instance_.roadmap());
  std::vector<Cost> costs;
  for (const AgentId i : instance_.agent_ids()) {
    bans.clear(standing_bans(i));
    const auto arrival = finder.find(task(i), bans, kForever, nullptr);
    costs.push_back(arrival ? as_cost(*arrival) : kAnyCost);
  }
  free_costs_ = std::move(costs);
  return true;
}

}  // namespace quadrille::continuous
