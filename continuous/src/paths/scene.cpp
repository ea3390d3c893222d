// SPDX-License-Identifier: MIT
#include "paths/scene.hpp"

#include "paths/obstacle_bans.hpp"

namespace quadrille::continuous {

Scene::Scene(const Instance& instance, LimitMonitor& limits)
    : instance_(instance), limits_(limits), contacts_(instance, limits) {
  distances_.reserve(instance.num_agents());
  detours_.reserve(instance.num_agents());
  for (const AgentId i : instance.agent_ids()) {
    if (limits.exhausted_now()) return;
    distances_.emplace_back(instance, i);
    detours_.emplace_back(instance, i, distances_.back());
  }
  standing_.resize(instance.num_classes());
  is_complete_ = instance.obstacles().empty() || avoid_obstacles();
}

bool Scene::avoid_obstacles() {
  for (const ClassId c : IdRange<ClassId>(instance_.num_classes())) {
    if (limits_.exhausted_now()) return false;
    standing_[c.index()] = bans_around_obstacles(instance_, c, limits_);
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
