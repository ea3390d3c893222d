// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "cover/core_table.hpp"
#include "support/random.hpp"

namespace quadrille::continuous::test {

using support::Random;

/// By its definition.
inline bool hit(const std::vector<Cost>& costs, const LevelCore& core) {
  return std::any_of(core.begin(), core.end(),
                     [&](const Level& l) { return costs[l.agent.index()] >= l.cost; });
}
inline bool hit(const IdVector<AgentId, Cost>& costs, const LevelCore& core) {
  return hit(costs.items(), core);
}
inline bool hit_all(const IdVector<AgentId, Cost>& costs, const std::vector<LevelCore>& cores) {
  return std::all_of(cores.begin(), cores.end(),
                     [&](const LevelCore& core) { return hit(costs, core); });
}

/// A few cores of a few agents, and their free costs.
struct LevelCores {
  IdVector<AgentId, Cost> free_costs;
  std::vector<LevelCore> cores;

  /// Levels are up to `num_levels` steps of `step` above the free costs. About a third of the
  /// agents are in a core, or a half.
  static LevelCores draw(Random& random, std::size_t num_agents, std::size_t num_cores,
                         std::size_t num_levels, Cost step) {
    LevelCores result;
    for (std::size_t i = 0; i < num_agents; ++i)
      result.free_costs.push_back(static_cast<Cost>(random.below(20)));
    const std::size_t density = random.percent(50) ? 33 : 50;
    while (result.cores.size() < num_cores) {
      LevelCore core;
      for (const AgentId i : IdRange<AgentId>(num_agents))
        if (random.percent(density))
          core.push_back(
              {i, result.free_costs[i] + step * static_cast<Cost>(random.between(1, num_levels))});
      if (!core.empty()) result.cores.push_back(core);
    }
    return result;
  }

  [[nodiscard]] std::vector<const LevelCore*> pointers() const {
    std::vector<const LevelCore*> result;
    for (const LevelCore& core : cores) result.push_back(&core);
    return result;
  }
  [[nodiscard]] IdRange<AgentId> agents() const { return IdRange<AgentId>(free_costs.size()); }
  /// The levels of the agent, increasing; some more than once.
  [[nodiscard]] std::vector<Cost> levels_of(AgentId agent) const {
    std::vector<Cost> result;
    for (const LevelCore& core : cores)
      for (const Level& level : core)
        if (level.agent == agent) result.push_back(level.cost);
    std::sort(result.begin(), result.end());
    return result;
  }
  /// What all agents together pay above their free costs.
  [[nodiscard]] Cost price(const IdVector<AgentId, Cost>& costs) const {
    Cost sum = 0;
    for (const AgentId i : agents()) sum += costs[i] - free_costs[i];
    return sum;
  }
};

}  // namespace quadrille::continuous::test
