// SPDX-License-Identifier: MIT
#include "cover/cover_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "continuous/cover/level_cores.hpp"
#include "cover/level_cover.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

/// The least sum above the free costs that hits these cores, by trying all levels of all agents.
Cost cheapest(const LevelCores& all, const std::vector<LevelCore>& cores) {
  IdVector<AgentId, Cost> costs = all.free_costs;
  Cost best = -1;
  const auto choose = [&](const auto& self, std::size_t at, Cost paid) -> void {
    if (best >= 0 && paid >= best) return;
    if (at == costs.size()) {
      if (hit_all(costs, cores)) best = paid;
      return;
    }
    const AgentId i(at);
    self(self, at + 1, paid);
    for (const Cost level : all.levels_of(i)) {
      costs[i] = level;
      self(self, at + 1, paid + level - all.free_costs[i]);
    }
    costs[i] = all.free_costs[i];
  };
  choose(choose, 0, 0);
  return best;
}

bool is_within(const std::vector<AgentId>& agents, std::size_t set) {
  return std::all_of(agents.begin(), agents.end(),
                     [&](AgentId i) { return (set >> i.index() & 1U) != 0; });
}

// Whatever agents are looked at: covering the cores among them costs what their shares amount to.
TEST(CoverShares, HoldForEachSetOfAgents) {
  constexpr std::size_t kAgents = 5;
  int num_of_one_core = 0, num_of_all = 0;
  for (std::uint64_t seed = 0; seed < support::scaled(150); ++seed) {
    Random random(seed);
    const std::size_t num_cores = 1 + random.below(7);
    const Cost step = 1 + static_cast<Cost>(random.below(50));
    const auto all = LevelCores::draw(random, kAgents, num_cores, 3, step);
    LevelCover cover(all.free_costs);
    LimitMonitor limits{Limits()};
    for (const LevelCore& core : all.cores) cover.add(core);
    ASSERT_TRUE(cover.solve(limits));
    const auto shares = cover.shares();
    Cost free_sum = 0, total = 0;
    for (const Cost cost : all.free_costs) free_sum += cost;
    for (const CoverShare& share : shares) {
      EXPECT_GT(share.amount, 0);
      total += share.amount;
      ++(share.is_of_one_core ? num_of_one_core : num_of_all);
    }
    EXPECT_EQ(total, cover.total() - free_sum) << seed;
    for (std::size_t set = 1; set < std::size_t{1} << kAgents; ++set) {
      std::vector<LevelCore> inside;
      for (const LevelCore& core : all.cores) {
        std::vector<AgentId> agents;
        for (const Level& level : core) agents.push_back(level.agent);
        if (is_within(agents, set)) inside.push_back(core);
      }
      Cost claimed = 0;
      for (const CoverShare& share : shares)
        if (is_within(share.agents, set)) claimed += share.amount;
      EXPECT_LE(claimed, cheapest(all, inside)) << "seed " << seed << ", agents " << set;
    }
  }
  if (support::scaled(150) < 150) return;  // scaled down: too few to count on chance
  EXPECT_GT(num_of_one_core, 20);
  EXPECT_GT(num_of_all, 0);
}

}  // namespace
}  // namespace quadrille::continuous::test
