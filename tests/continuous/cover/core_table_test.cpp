// SPDX-License-Identifier: MIT
// Tables of cores against the plain list of the cores.
#include "cover/core_table.hpp"

#include <gtest/gtest.h>

#include <set>

#include "continuous/cover/level_cores.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;
using Costs = IdVector<AgentId, Cost>;

LevelCores draw_cores(Random& random) {
  const std::size_t num_agents = random.between(1, 6);
  const std::size_t num_cores = random.below(10), num_levels = random.between(1, 8);
  const Cost step = random.percent(50) ? 1 : 100'000'000;
  return LevelCores::draw(random, num_agents, num_cores, num_levels, step);
}

TEST(CoreTable, ListsLevelsAndCores) {
  for (std::size_t seed = 0; seed < scaled(500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const LevelCores input = draw_cores(random);
    const CoreTable table(input.pointers());
    std::set<Level> levels;
    for (const LevelCore& core : input.cores) levels.insert(core.begin(), core.end());
    ASSERT_EQ(table.rows(), std::vector<Level>(levels.begin(), levels.end()));
    ASSERT_EQ(table.num_cores(), input.cores.size());
    for (std::size_t c = 0; c < input.cores.size(); ++c) {
      LevelCore core;
      for (const std::uint32_t r : table.rows_of(c)) core.push_back(table.rows()[r]);
      EXPECT_EQ(core, input.cores[c]);
    }
    for (std::size_t r = 0; r < table.rows().size(); ++r) {
      std::vector<std::uint32_t> with_level;
      for (std::uint32_t c = 0; c < input.cores.size(); ++c)
        if (std::count(input.cores[c].begin(), input.cores[c].end(), table.rows()[r]) > 0)
          with_level.push_back(c);
      const auto cores = table.cores_of(r);
      EXPECT_EQ(std::vector<std::uint32_t>(cores.begin(), cores.end()), with_level);
    }
  }
}

/// The level that hits most cores that are not hit, for what it costs; the first of equals.
Level best_level(const LevelCores& input, const Costs& costs) {
  std::set<Level> levels;
  for (const LevelCore& core : input.cores)
    if (!hit(costs, core)) levels.insert(core.begin(), core.end());
  Level best;
  double best_score = 0;
  for (const Level& level : levels) {
    Costs raised = costs;
    raised[level.agent] = level.cost;
    int num_hit = 0;
    for (const LevelCore& core : input.cores)
      num_hit += static_cast<int>(!hit(costs, core) && hit(raised, core));
    const double score = num_hit / static_cast<double>(level.cost - costs[level.agent]);
    if (score <= best_score) continue;
    best = level;
    best_score = score;
  }
  return best;
}

/// Dearest first, each to its least cost, of its levels and the free one, that keeps all cores hit.
void lower(const LevelCores& input, Costs& costs) {
  std::vector<AgentId> order;
  for (const AgentId i : input.agents())
    if (!input.levels_of(i).empty()) order.push_back(i);
  const auto price = [&](AgentId i) { return costs[i] - input.free_costs[i]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](AgentId a, AgentId b) { return price(a) > price(b); });
  for (const AgentId i : order) {
    const Cost now = costs[i];
    std::vector<Cost> choices = input.levels_of(i);
    choices.insert(choices.begin(), input.free_costs[i]);
    for (const Cost choice : choices) {
      costs[i] = std::min(choice, now);
      if (hit_all(costs, input.cores)) break;
    }
  }
}

Costs plain_complete(const LevelCores& input, Costs costs) {
  while (!hit_all(costs, input.cores)) {
    const Level level = best_level(input, costs);
    costs[level.agent] = level.cost;
  }
  lower(input, costs);
  return costs;
}

TEST(CoreTable, CompletesCosts) {
  for (std::size_t seed = 0; seed < scaled(2000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const LevelCores input = draw_cores(random);
    // Any costs to begin with: levels, others, too high ones.
    Costs begin = input.free_costs;
    for (const AgentId i : input.agents()) {
      const std::vector<Cost> levels = input.levels_of(i);
      if (random.percent(30)) begin[i] += static_cast<Cost>(random.below(10));
      if (random.percent(30) && !levels.empty()) begin[i] = random.pick(levels);
      if (random.percent(10)) begin[i] += 1'000'000'000;
    }
    Costs costs = begin;
    CoreTable(input.pointers()).complete(input.free_costs, costs);
    ASSERT_TRUE(hit_all(costs, input.cores));
    for (const AgentId i : input.agents()) {
      const std::vector<Cost> levels = input.levels_of(i);
      if (levels.empty()) {
        ASSERT_EQ(costs[i], begin[i]);
        continue;
      }
      ASSERT_GE(costs[i], input.free_costs[i]);
      if (costs[i] == input.free_costs[i]) continue;
      ASSERT_TRUE(std::binary_search(levels.begin(), levels.end(), costs[i]));
      Costs lower = costs;
      --lower[i];
      ASSERT_FALSE(hit_all(lower, input.cores))
          << "agent " << i.index() << " need not be that high";
    }
    ASSERT_EQ(costs, plain_complete(input, begin));
  }
}

TEST(CoreTable, OfNoCores) {
  const Costs free{3, 4};
  for (const CoreTable& table : {CoreTable(), CoreTable(std::span<const LevelCore* const>())}) {
    EXPECT_EQ(table.num_cores(), 0u);
    EXPECT_TRUE(table.rows().empty());
    Costs costs{3, 9};
    table.complete(free, costs);
    EXPECT_EQ(costs, (Costs{3, 9}));
  }
}

TEST(CoreTable, TakesALevelThatServesLowerOnesToo) {
  // Each core alone is cheaper to hit with an agent of its own, both together with the first one.
  const std::vector<LevelCore> cores{{{AgentId(0), 4}, {AgentId(1), 3}},
                                     {{AgentId(0), 5}, {AgentId(2), 3}}};
  const std::vector<const LevelCore*> pointers{&cores[0], &cores[1]};
  const Costs free{0, 0, 0};
  Costs costs = free;
  CoreTable(pointers).complete(free, costs);
  EXPECT_EQ(costs, (Costs{5, 0, 0}));
}

}  // namespace
}  // namespace quadrille::continuous::test
