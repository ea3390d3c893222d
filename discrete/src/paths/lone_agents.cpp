// SPDX-License-Identifier: MIT
#include "paths/lone_agents.hpp"

#include <algorithm>

namespace quadrille::discrete {

std::optional<Timestep> LoneAgents::find_cost(const AgentDistances& distances) {
  if (distances.length() == kUnreachable || distances.is_banned(distances.start(), 0))
    return std::nullopt;
  map_.load(none_, {}, distances);
  // After the last rule has had its say, whoever can come to a goal goes straight there.
  const auto states = static_cast<std::int64_t>(distances.states().num_vertices());
  const auto most = std::min<std::int64_t>(kForever / 2, 2 * std::int64_t{kMaxRuleTime} + states);
  const Timestep last = distances.deadline().value_or(static_cast<Timestep>(most));
  if (!search_.find(distances, map_, last, {}, path_)) return std::nullopt;
  return static_cast<Timestep>(path_.size()) - 1;
}

LoneCosts lone_costs(const Instance& instance, const GoalDistances& distances,
                     LimitMonitor& limits) {
  LoneCosts lone;
  if (instance.is_plain()) {
    for (const AgentId i : instance.agent_ids())
      lone.costs.push_back(distances(i, instance.agents()[i].start));
    return lone;
  }
  const BlockedTimes blocked(instance);
  const bool is_blocked = !instance.rules().blockages.empty();
  LoneAgents agents(instance.graph().num_vertices(), &limits);
  for (const AgentId i : instance.agent_ids()) {
    limits.check();
    const auto cost = agents.find_cost(
        AgentDistances(instance, distances, i, nullptr, is_blocked ? &blocked : nullptr));
    if (!cost) {
      lone.stuck = i;
      return lone;
    }
    lone.costs.push_back(*cost);
  }
  return lone;
}

}  // namespace quadrille::discrete
