// SPDX-License-Identifier: MIT
// Solutions against the definitions of the two linear programs, which prove each other optimal.
#include "cover/level_simplex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "continuous/cover/level_cores.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;
using Costs = IdVector<AgentId, Cost>;

constexpr double kTiny = 1e-6;

/// The ends of the agents' ranges in a leaf, in which each core has a level.
struct Ends {
  Costs low, high;
};

LevelSimplex simplex_of(const LevelCores& input, const CoreTable& table) {
  LevelSimplex simplex(input.free_costs);
  simplex.set_levels(table.rows());
  for (std::size_t c = 0; c < table.num_cores(); ++c)
    static_cast<void>(simplex.add_column(table.rows_of(c), 1));
  return simplex;
}

Ends all_costs(const LevelCores& input) {
  return {input.free_costs, Costs(input.free_costs.size(), std::numeric_limits<Cost>::max())};
}

Ends draw_ends(Random& random, const LevelCores& input) {
  Ends ends = all_costs(input);
  for (const AgentId i : input.agents()) {
    const std::vector<Cost> levels = input.levels_of(i);
    if (levels.empty() || !random.percent(30)) continue;
    ends.low[i] = levels[static_cast<std::size_t>(random.below(levels.size()))];
    if (random.percent(50)) continue;
    ends.high[i] =
        std::max(levels[static_cast<std::size_t>(random.below(levels.size()))], ends.low[i] + 1);
  }
  for (const LevelCore& core : input.cores) {
    const bool has_level = std::any_of(core.begin(), core.end(), [&](const Level& level) {
      return level.cost < ends.high[level.agent];
    });
    for (const Level& level : core)
      if (!has_level) ends.high[level.agent] = std::numeric_limits<Cost>::max();
  }
  return ends;
}

void expect_optimal(const LevelCores& input, const CoreTable& table, LevelSimplex& simplex,
                    const Ends& ends) {
  const std::vector<Level>& levels = table.rows();
  const double scale = 1 + static_cast<double>(levels.size());
  // The multipliers: none below 0, and no row exceeded.
  const std::vector<double> multipliers = simplex.multipliers();
  ASSERT_EQ(multipliers.size(), simplex.basis().columns.size());
  double worth = 0;
  IdVector<AgentId, double> of_low(input.free_costs.size(), 0);
  std::vector<double> used(levels.size(), 0), used_by_low(input.free_costs.size(), 0);
  for (std::size_t k = 0; k < multipliers.size(); ++k) {
    EXPECT_GE(multipliers[k], -kTiny * scale);
    worth += multipliers[k];
    const std::uint32_t column = simplex.basis().columns[k];
    if (column < simplex.num_lows()) {
      const AgentId i = simplex.lines()[column].agent;
      EXPECT_GT(ends.low[i], input.free_costs[i]);
      used_by_low[i.index()] += multipliers[k];
      for (std::size_t r = 0; r < levels.size(); ++r)
        if (levels[r].agent == i) used[r] += multipliers[k];
      continue;
    }
    for (const std::size_t first : table.rows_of(column - simplex.num_lows())) {
      const AgentId i = levels[first].agent;
      if (levels[first].cost <= ends.low[i]) used_by_low[i.index()] += multipliers[k];
      for (std::size_t r = first; r < levels.size() && levels[r].agent == i; ++r)
        used[r] += multipliers[k];
    }
  }
  for (std::size_t r = 0; r < levels.size(); ++r) {
    const AgentId i = levels[r].agent;
    if (levels[r].cost <= ends.low[i] || levels[r].cost >= ends.high[i]) continue;
    EXPECT_LE(used[r], static_cast<double>(levels[r].cost - input.free_costs[i]) + kTiny * scale);
  }
  for (const AgentId i : input.agents()) {
    if (ends.low[i] == input.free_costs[i]) continue;
    EXPECT_LE(used_by_low[i.index()],
              static_cast<double>(ends.low[i] - input.free_costs[i]) + kTiny * scale);
  }
  // The fractional cover: falling by level, all of what the low ends reach, and each core covered.
  const std::vector<double>& parts = simplex.parts();
  double price = 0;
  for (std::size_t r = 0; r < levels.size(); ++r) {
    const AgentId i = levels[r].agent;
    const bool is_first = r == 0 || levels[r - 1].agent != i;
    EXPECT_LE(parts[r], is_first ? 1e9 : parts[r - 1] + kTiny);
    EXPECT_GE(parts[r], levels[r].cost <= ends.low[i] ? 1 - kTiny : -kTiny);
    EXPECT_LE(parts[r], levels[r].cost >= ends.high[i] ? kTiny : 1e9);
    const Cost below = is_first ? input.free_costs[i] : levels[r - 1].cost;
    price += parts[r] * static_cast<double>(levels[r].cost - below);
  }
  for (std::size_t c = 0; c < table.num_cores(); ++c) {
    double covered = 0;
    for (const std::size_t r : table.rows_of(c)) covered += parts[r];
    EXPECT_GE(covered, 1 - kTiny);
  }
  EXPECT_NEAR(price, worth, kTiny * scale * std::max(1.0, worth));
}

void expect_optimal(Random& random, const LevelCores& input, bool in_leaf) {
  const auto pointers = input.pointers();
  const CoreTable table(pointers);
  LevelSimplex simplex = simplex_of(input, table);
  Ends ends = all_costs(input);
  if (in_leaf) ends = draw_ends(random, input);
  simplex.begin(ends.low, ends.high);
  simplex.solve();
  expect_optimal(input, table, simplex, ends);
}

TEST(LevelSimplex, IsOptimal) {
  Random random(21);
  for (std::size_t round = 0; round < scaled(10'000) && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    // One after the other: compilers differ in which argument of a call they draw first.
    const std::size_t agents = random.between(1, 8), cores = random.between(1, 12);
    const std::size_t levels = random.between(1, 6), step = random.between(1, 9);
    const auto input = LevelCores::draw(random, agents, cores, levels, static_cast<Cost>(step));
    expect_optimal(random, input, round % 2 == 1);
  }
}

TEST(LevelSimplex, IsOptimalWhereItIsLarge) {
  Random random(22);
  for (std::size_t round = 0; round < scaled(20) && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const auto input = LevelCores::draw(random, 12, 150, 40, 1'000'003);
    expect_optimal(random, input, round % 2 == 1);
  }
}

TEST(LevelSimplex, TakesHalves) {
  // Each two of three agents: a half of each.
  LevelCores input;
  for (int i = 0; i < 3; ++i) input.free_costs.push_back(5);
  for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(0U, 2U), std::pair(1U, 2U)})
    input.cores.push_back({{AgentId(a), 15}, {AgentId(b), 15}});
  const auto pointers = input.pointers();
  const CoreTable table(pointers);
  LevelSimplex simplex = simplex_of(input, table);
  const Ends ends = all_costs(input);
  simplex.begin(ends.low, ends.high);
  simplex.solve();
  for (const double part : simplex.parts()) EXPECT_NEAR(part, 0.5, kTiny);
}

}  // namespace
}  // namespace quadrille::continuous::test
