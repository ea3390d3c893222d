// SPDX-License-Identifier: MIT
#include "paths/scene.hpp"

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
}

}  // namespace quadrille::continuous
