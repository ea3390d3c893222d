// SPDX-License-Identifier: MIT
// Linear programs of leaves against all integer solutions of the leaf, and against the fractional
// cover that proves them optimal.
#include "cover/leaf_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "continuous/cover/leaf_cases.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;

void expect_solved(const LeafCase& c, const CoverLeaf& leaf, const Costs& costs, bool is_integral,
                   Cost least) {
  expect_form(c.input, leaf);
  EXPECT_EQ(leaf.branch.has_value(), !hit_all(low_ends(c.input, leaf), c.input.cores));
  // The shares are a fractional cover, so none is cheaper than the bound of the linear program;
  // this one costs no more.
  EXPECT_TRUE(covers_all(c.input, leaf));
  EXPECT_LE(leaf.bound, least);
  const double price = price_of_shares(c.input, leaf);
  EXPECT_GE(static_cast<double>(leaf.bound), price - c.loss());
  EXPECT_LE(static_cast<double>(leaf.bound), std::ceil(price + c.loss()));
  for (const AgentId i : c.input.agents()) {
    const CoverLeaf::Range range = range_of(c.input, leaf, i);
    const std::vector<Cost> levels = c.input.levels_of(i);
    EXPECT_TRUE(costs[i] == range.low ||
                (costs[i] > range.low && costs[i] < range.high &&
                 std::binary_search(levels.begin(), levels.end(), costs[i])));
  }
  if (!is_integral) return;
  EXPECT_TRUE(hit_all(costs, c.input.cores));
  EXPECT_EQ(c.input.price(costs), least);
  EXPECT_EQ(leaf.bound, least);
}

TEST(LeafProgram, BoundsTheLeaf) {
  std::size_t num_fractional = 0, num_empty = 0, num_wrong_starts = 0;
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    const LeafCase c = LeafCase::draw(seed);
    const CoreTable table(c.input.pointers());
    LeafProgram program(c.input.free_costs);
    program.set_cores(table);
    const std::optional<Cost> least = least_price(c.input, c.leaf);
    CoverLeaf leaf = c.leaf;
    Costs costs;
    ASSERT_EQ(program.solve(leaf, costs), least.has_value());
    if (!least) {
      ++num_empty;
      EXPECT_TRUE(costs.empty());
      EXPECT_EQ(leaf.bound, 0);
      EXPECT_FALSE(leaf.branch);
      continue;
    }
    expect_solved(c, leaf, costs, program.is_integral(), *least);
    num_fractional += static_cast<std::size_t>(!program.is_integral());
    // A bound that is better already stays.
    CoverLeaf bounded = c.leaf;
    bounded.bound = *least + 5;
    ASSERT_TRUE(program.solve(bounded, costs));
    EXPECT_EQ(bounded.bound, *least + 5);
    // Whatever fractional cover it has to begin with, right or wrong.
    Random random(seed + 1);
    CoverLeaf started = c.leaf;
    for (const AgentId i : c.input.agents())
      for (const Cost cost : c.input.levels_of(i))
        if (random.percent(50))
          started.shares.push_back({{i, cost}, 0.25 * static_cast<double>(random.between(1, 4))});
    std::sort(started.shares.begin(), started.shares.end(),
              [](const auto& a, const auto& b) { return a.level > b.level; });
    num_wrong_starts += static_cast<std::size_t>(!covers_all(c.input, started));
    ASSERT_TRUE(program.solve(started, costs));
    expect_solved(c, started, costs, program.is_integral(), *least);
    if (testing::Test::HasFailure()) return;
  }

  EXPECT_GE(num_fractional, scaled(3000) / 100);
  EXPECT_GE(num_empty, scaled(3000) / 100);
  EXPECT_GE(num_wrong_starts, scaled(3000) / 100);
}

// One program after another, about whatever leaf and cores, says what a program of its own says.
TEST(LeafProgram, KeepsNothingOfOtherLeaves) {
  for (std::size_t seed = 0; seed < scaled(300); ++seed) {
    SCOPED_TRACE(seed);
    const LeafCase c = LeafCase::draw(seed);
    Random random(seed);
    LeafProgram program(c.input.free_costs);
    for (int k = 0; k < 10; ++k) {
      LevelCores some = c.input;
      std::erase_if(some.cores, [&](const LevelCore&) { return random.percent(30); });
      const CoreTable table(some.pointers());
      CoverLeaf leaf = draw_leaf(random, c.input), again = leaf;
      program.set_cores(table);
      LeafProgram other(c.input.free_costs);
      other.set_cores(table);
      Costs costs, costs_again;
      ASSERT_EQ(program.solve(leaf, costs), other.solve(again, costs_again));
      EXPECT_EQ(program.is_known(leaf), other.is_known(again));
      EXPECT_EQ(leaf.bound, again.bound);
      EXPECT_EQ(leaf.branch, again.branch);
      EXPECT_EQ(costs, costs_again);
    }
  }
}

// Other cores leave a leaf as it is exactly if its fractional cover covers them too.
TEST(LeafProgram, KnowsLeavesThatStayAsTheyAre) {
  std::size_t num_known = 0, num_unknown = 0;
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    LeafCase c = LeafCase::draw(seed);
    Random random(seed);
    LeafProgram program(c.input.free_costs);
    EXPECT_FALSE(program.is_known(c.leaf));  // never solved
    CoverLeaf leaf = c.leaf;
    Costs costs;
    {
      const CoreTable table(c.input.pointers());
      program.set_cores(table);
      if (!program.solve(leaf, costs)) continue;
      EXPECT_EQ(program.is_known(leaf), leaf.branch.has_value());
    }
    for (std::size_t k = random.between(1, 2); k > 0; --k)
      c.input.cores.push_back(
          LevelCores::draw(random, c.input.free_costs.size(), 1, 6, c.step).cores.front());
    for (LevelCore& core : c.input.cores)
      for (Level& level : core)  // those that were drawn just now have other free costs
        level.cost = std::max(level.cost, c.input.free_costs[level.agent] + 1);
    const bool are_more = random.percent(50);
    if (!are_more)  // some are gone, with their levels
      std::erase_if(c.input.cores, [&](const LevelCore&) { return random.percent(30); });
    const CoreTable table(c.input.pointers());
    program.set_cores(table);
    const bool is_known = program.is_known(leaf);
    ASSERT_EQ(is_known, leaf.branch && covers_all(c.input, leaf));
    ++(is_known ? num_known : num_unknown);
    // The next solution begins with the cores that matter in the former one, and is as good as one
    // that does not. A bound that is better stays.
    const std::optional<Cost> least = least_price(c.input, c.leaf);
    CoverLeaf again = leaf, bounded = leaf;
    again.bound = 0;
    Costs bounded_costs;
    ASSERT_EQ(program.solve(bounded, bounded_costs), least.has_value());
    ASSERT_EQ(program.solve(again, costs), least.has_value());
    if (!least) continue;
    expect_solved(c, again, costs, program.is_integral(), *least);
    EXPECT_EQ(bounded.bound, std::max(leaf.bound, again.bound));
    if (testing::Test::HasFailure()) return;
    if (is_known && are_more) {
      EXPECT_LE(std::abs(again.bound - leaf.bound), static_cast<Cost>(c.loss()) + 1);
    }
  }
  EXPECT_GE(num_known, scaled(3000) / 20);
  EXPECT_GE(num_unknown, scaled(3000) / 20);
}

TEST(LeafProgram, BoundsFromAnyMultipliers) {
  std::size_t num_raised = 0;
  for (std::size_t seed = 0; seed < scaled(1000); ++seed) {
    SCOPED_TRACE(seed);
    const LeafCase c = LeafCase::draw(seed);
    const CoreTable table(c.input.pointers());
    LeafProgram program(c.input.free_costs);
    program.set_cores(table);
    CoverLeaf leaf = c.leaf;
    Costs costs;
    if (!program.solve(leaf, costs)) continue;
    const std::optional<Cost> least = least_price(c.input, c.leaf);
    Random random(seed);
    for (int k = 0; k < 5; ++k) {
      std::vector<double> multipliers;
      double sum = 0;
      for (const auto& column : leaf.solution->columns) {
        const double factor = 0.5 * static_cast<double>(random.between(1, 6));
        multipliers.push_back(factor * (column.multiplier + static_cast<double>(c.step)));
        sum += multipliers.back();
      }
      ASSERT_LE(program.certified_bound(multipliers), *least);
      num_raised += static_cast<std::size_t>(sum > static_cast<double>(*least));
    }
  }
  EXPECT_GE(num_raised, scaled(1000));
}

/// A part of the leaf: an agent reaches a level, or stays below it.
CoverLeaf part_of(Random& random, const LevelCores& input, CoverLeaf leaf) {
  const AgentId agent = random.pick(random.pick(input.cores)).agent;
  const CoverLeaf::Range range = range_of(input, leaf, agent);
  const Cost cost = random.pick(input.levels_of(agent));
  if (cost <= range.low || cost >= range.high) return leaf;
  auto at = std::lower_bound(leaf.ranges.begin(), leaf.ranges.end(), agent,
                             [](const auto& r, AgentId i) { return r.agent < i; });
  if (at == leaf.ranges.end() || at->agent != agent) at = leaf.ranges.insert(at, {agent});
  if (random.percent(50))
    at->low = cost;
  else
    at->high = cost;
  return leaf;
}

// From leaf to part, while cores come and go, each begins with the solution before.
TEST(LeafProgram, GoesOnFromSolutions) {
  std::size_t num_solved = 0;
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    LeafCase c = LeafCase::draw(seed);
    if (c.input.cores.empty()) continue;
    Random random(seed);
    const std::vector<LevelCore> cores = c.input.cores;
    LeafProgram program(c.input.free_costs);
    CoverLeaf leaf;
    for (int k = 0; k < 8; ++k) {
      const auto gone = random.percent(50) ? 0U : 30U;
      std::vector<std::uint32_t> numbers;
      c.input.cores.clear();
      for (std::uint32_t n = 0; n < cores.size(); ++n)
        if (!random.percent(gone)) {
          c.input.cores.push_back(cores[n]);
          numbers.push_back(n);
        }
      if (c.input.cores.empty()) break;
      const CoreTable table(c.input.pointers());
      program.set_cores(table, numbers);
      leaf = part_of(random, c.input, std::move(leaf));
      leaf.bound = 0;
      CoverLeaf anew = leaf;
      anew.solution = nullptr;
      const std::optional<Cost> least = least_price(c.input, leaf);
      Costs costs;
      ASSERT_EQ(program.solve(leaf, costs), least.has_value());
      if (!least) break;
      expect_solved(c, leaf, costs, program.is_integral(), *least);
      ASSERT_TRUE(program.solve(anew, costs));
      EXPECT_LE(std::abs(leaf.bound - anew.bound), static_cast<Cost>(c.loss()) + 1);
      if (testing::Test::HasFailure()) return;
      ++num_solved;
    }
  }
  EXPECT_GE(num_solved, scaled(3000) * 2);
}

TEST(LeafProgram, SplitsHalves) {
  // Three agents, each pair of which has a core: 1.5, and so 2 in integers.
  const LevelCores input{{0, 0, 0},
                         {{{AgentId(0), 1}, {AgentId(1), 1}},
                          {{AgentId(1), 1}, {AgentId(2), 1}},
                          {{AgentId(0), 1}, {AgentId(2), 1}}}};
  const CoreTable table(input.pointers());
  LeafProgram program(input.free_costs);
  program.set_cores(table);
  CoverLeaf leaf;
  Costs costs;
  ASSERT_TRUE(program.solve(leaf, costs));
  EXPECT_EQ(leaf.bound, 2);
  EXPECT_FALSE(program.is_integral());
  ASSERT_EQ(leaf.shares.size(), 3u);
  for (const CoverLeaf::Share& share : leaf.shares) EXPECT_NEAR(share.part, 0.5, kTiny);
}

TEST(LeafProgram, OfNoCores) {
  const CoreTable table;
  LeafProgram program({3, 4});
  program.set_cores(table);
  CoverLeaf leaf;
  leaf.ranges = {{AgentId(1), 9}};
  Costs costs;
  ASSERT_TRUE(program.solve(leaf, costs));
  EXPECT_EQ(leaf.bound, 5);
  EXPECT_FALSE(leaf.branch);
  EXPECT_TRUE(leaf.shares.empty());
  EXPECT_TRUE(program.is_integral());
  EXPECT_EQ(costs, (Costs{3, 9}));
}

TEST(LeafProgram, EndsOfRanges) {
  // The agent costs at least `low` and less than `high`.
  const LevelCores input{{0}, {{{AgentId(0), 5}}}};
  const CoreTable table(input.pointers());
  LeafProgram program(input.free_costs);
  program.set_cores(table);
  Costs costs;
  CoverLeaf below;
  below.ranges = {{AgentId(0), 0, 5}};
  EXPECT_FALSE(program.solve(below, costs));
  CoverLeaf at;
  at.ranges = {{AgentId(0), 0, 6}};
  ASSERT_TRUE(program.solve(at, costs));
  EXPECT_EQ(at.bound, 5);
  EXPECT_EQ(at.branch, (Level{AgentId(0), 5}));
  CoverLeaf above;
  above.ranges = {{AgentId(0), 5}};
  ASSERT_TRUE(program.solve(above, costs));
  EXPECT_EQ(above.bound, 5);
  EXPECT_FALSE(above.branch);
}

}  // namespace
}  // namespace quadrille::continuous::test
