// SPDX-License-Identifier: MIT
#include "cover/level_cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
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

/// Cores of a dozen agents. Levels are a few multiples of `step`, some with a part of it, and often
/// a tick apart: that of a plan and one more, as cores have them.
std::vector<LevelCore> drawn_cores(unsigned seed, std::size_t num_agents, Cost step) {
  std::mt19937 random(seed);
  std::vector<LevelCore> cores;
  while (cores.size() < 40) {
    LevelCore core;
    for (const AgentId i : IdRange<AgentId>(num_agents)) {
      Cost cost = (1 + static_cast<Cost>(random()) % 5) * step + static_cast<Cost>(random()) % 3;
      if (random() % 3 == 0) cost += static_cast<Cost>(random()) % 1000 * (step / 1000);
      if (random() % num_agents < 3) core.push_back({i, cost});
    }
    if (core.size() >= 2) cores.push_back(core);
  }
  return cores;
}

// Doubles know 10^12 ticks to a ten-thousandth of a tick at best, linear programs to some hundred
// ticks; bounds have to be exact all the same, or leaves are split for ever that should be closed.
TEST(LevelCover, TakesAsFewProgramsWhereTicksAreFine) {
  // Of each call; all calls take about 50.
  constexpr Effort much = Effort::microseconds(25'000);
  LimitMonitor limits({});
  std::int64_t coarse_programs = 0, fine_programs = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t num_agents = 10 + seed % 4;
    for (const Cost step : {Cost{1'000'000}, Cost{700'000'000'001}}) {
      LevelCover cover(IdVector<AgentId, Cost>(num_agents, 0));
      std::vector<LevelCore> cores;
      for (const LevelCore& core : drawn_cores(seed, num_agents, step)) {
        cores.push_back(core);
        cover.add(core);
        ASSERT_TRUE(cover.solve(limits, much));
        ASSERT_TRUE(cover.is_exact());
        for (const LevelCore& c : cores) ASSERT_TRUE(hit(cover.costs(), c));
        ASSERT_EQ(cover.total(),
                  std::accumulate(cover.costs().begin(), cover.costs().end(), Cost{0}));
      }
      if (seed % 8 == 0) {
        ASSERT_EQ(cover.total(), least_by_cores(std::vector<Cost>(num_agents, 0), cores,
                                                std::numeric_limits<Cost>::max()));
      }
      (step == 1'000'000 ? coarse_programs : fine_programs) += cover.num_programs();
    }
  }
  // Measured: 1.1 times as many.
  EXPECT_LE(2 * fine_programs, 3 * coarse_programs);
}

// With however little effort at a time: bounds on both sides, and at last the least sum.
TEST(LevelCover, GoesOnWhereItGaveUp) {
  LimitMonitor limits({});
  int num_open = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t num_agents = 10 + seed % 4;
    LevelCover cover(IdVector<AgentId, Cost>(num_agents, 3));
    std::vector<LevelCore> cores;
    for (const LevelCore& core : drawn_cores(seed, num_agents, 5)) {
      cores.push_back(core);
      cover.add(core);
    }
    const Cost least =
        least_by_cores(std::vector<Cost>(num_agents, 3), cores, std::numeric_limits<Cost>::max());
    Cost last = 0;
    for (int calls = 0; calls < 10'000; ++calls) {
      ASSERT_TRUE(cover.solve(limits, Effort::nanoseconds(1)));
      Cost sum = 0;
      for (const Cost cost : cover.costs()) sum += cost;
      for (const LevelCore& core : cores) ASSERT_TRUE(hit(cover.costs().items(), core));
      ASSERT_LE(cover.total(), least);
      ASSERT_GE(cover.total(), last);
      ASSERT_GE(sum, least);
      ASSERT_EQ(cover.is_exact(), cover.total() == sum);
      Cost proven = 0;
      for (const CoverShare& share : cover.shares()) proven += share.amount;
      ASSERT_GE(proven + static_cast<Cost>(3 * num_agents), cover.total());
      if (cover.is_exact()) break;
      last = cover.total();
      ++num_open;
    }
    ASSERT_EQ(cover.total(), least);
  }
  EXPECT_GT(num_open, 100);
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
