// SPDX-License-Identifier: MIT
#include "cover/level_cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "continuous/cover/level_cores.hpp"

namespace quadrille::continuous::test {
namespace {

/// Tries all combinations of levels.
Cost least_total(std::vector<Cost> costs, const std::vector<LevelCore>& cores, std::size_t agent) {
  if (agent == costs.size()) {
    for (const LevelCore& core : cores)
      if (!hit(costs, core)) return std::numeric_limits<Cost>::max();
    Cost total = 0;
    for (const Cost c : costs) total += c;
    return total;
  }
  Cost best = least_total(costs, cores, agent + 1);
  for (const LevelCore& core : cores)
    for (const Level& level : core)
      if (level.agent.index() == agent) {
        costs[agent] = level.cost;
        best = std::min(best, least_total(costs, cores, agent + 1));
      }
  return best;
}

TEST(LevelCover, IsOptimalAfterEachCore) {
  LimitMonitor limits({});
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::size_t num_agents = 2 + random() % 4;
    const Cost scale = seed % 2 == 0 ? 3 : 100'000'000;
    IdVector<AgentId, Cost> free(num_agents);
    std::vector<Cost> costs;
    for (const AgentId i : IdRange<AgentId>(num_agents)) {
      free[i] = static_cast<Cost>(random() % 50);
      costs.push_back(free[i]);
    }
    LevelCover cover(free);
    std::vector<LevelCore> cores;
    const std::size_t num_cores = num_agents > 4 ? 4 : 6;
    for (std::size_t k = 0; k < num_cores; ++k) {
      LevelCore core;
      for (const AgentId i : IdRange<AgentId>(num_agents))
        if (random() % 2 == 0)
          core.push_back({i, free[i] + 1 + static_cast<Cost>(random()) % (4 * scale)});
      if (core.empty()) continue;
      cores.push_back(core);
      cover.add(core);
      ASSERT_TRUE(cover.solve(limits));
      for (const LevelCore& c : cores) ASSERT_TRUE(hit(cover.costs().items(), c));
      ASSERT_EQ(cover.total(), least_total(costs, cores, 0));
      for (const LevelCore& c : cores) ASSERT_TRUE(hit(cover.completed(cover.costs()).items(), c));
    }
  }
}

/// Hits the first core that is not hit, in each way; `limit` is what is known already.
Cost least_by_cores(const std::vector<Cost>& costs, const std::vector<LevelCore>& cores,
                    Cost limit) {
  Cost total = 0;
  for (const Cost c : costs) total += c;
  if (total >= limit) return limit;
  const auto open = std::find_if(cores.begin(), cores.end(),
                                 [&](const LevelCore& core) { return !hit(costs, core); });
  if (open == cores.end()) return total;
  for (const Level& level : *open) {
    std::vector<Cost> raised = costs;
    raised[level.agent.index()] = level.cost;
    limit = least_by_cores(raised, cores, limit);
  }
  return limit;
}

// Many small cores with low levels, of which linear programs take halves.
TEST(LevelCover, IsOptimalWhereHalvesAreCheaper) {
  LimitMonitor limits({});
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::size_t num_agents = 9 + random() % 6;
    const Cost num_levels = 1 + static_cast<Cost>(seed % 4);
    LevelCover cover(IdVector<AgentId, Cost>(num_agents, 0));
    std::vector<LevelCore> cores;
    for (int k = 0; k < 36; ++k) {
      LevelCore core;
      for (const AgentId i : IdRange<AgentId>(num_agents))
        if (random() % num_agents < 2)
          core.push_back({i, 1 + static_cast<Cost>(random()) % num_levels});
      if (core.size() < 2) continue;
      cores.push_back(core);
      cover.add(core);
      ASSERT_TRUE(cover.solve(limits));
      for (const LevelCore& c : cores) ASSERT_TRUE(hit(cover.costs().items(), c));
      ASSERT_EQ(cover.total(), least_by_cores(std::vector<Cost>(num_agents, 0), cores,
                                              std::numeric_limits<Cost>::max()));
    }
  }
}

TEST(LevelCover, NeedsBranching) {
  // Three agents, each pair of which has a core: the linear program says 1.5.
  LimitMonitor limits({});
  LevelCover cover({0, 0, 0});
  cover.add({{AgentId(0), 1}, {AgentId(1), 1}});
  cover.add({{AgentId(1), 1}, {AgentId(2), 1}});
  cover.add({{AgentId(0), 1}, {AgentId(2), 1}});
  ASSERT_TRUE(cover.solve(limits));
  EXPECT_EQ(cover.total(), 2);
}

TEST(LevelCover, DropsImpliedCores) {
  LevelCover cover({0, 0});
  cover.add({{AgentId(0), 5}, {AgentId(1), 5}});
  cover.add({{AgentId(0), 4}, {AgentId(1), 5}});
  EXPECT_EQ(cover.num_cores(), 1u);
  cover.add({{AgentId(0), 7}});
  EXPECT_EQ(cover.num_cores(), 1u);
}

}  // namespace
}  // namespace quadrille::continuous::test
