// SPDX-License-Identifier: MIT
// Linear programs of leaves against all integer solutions of the leaf, and against the fractional
// cover that proves them optimal.
#include "cover/leaf_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "continuous/cover/level_cores.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;
using Costs = IdVector<AgentId, Cost>;

constexpr double kTiny = 1e-6;
constexpr Cost kMax = std::numeric_limits<Cost>::max();

/// What the leaf says about the agent.
CoverLeaf::Range range_of(const LevelCores& input, const CoverLeaf& leaf, AgentId agent) {
  for (const CoverLeaf::Range& range : leaf.ranges)
    if (range.agent == agent)
      return {agent, std::max(range.low, input.free_costs[agent]), range.high};
  return {agent, input.free_costs[agent], kMax};
}

Costs low_ends(const LevelCores& input, const CoverLeaf& leaf) {
  Costs costs = input.free_costs;
  for (const AgentId i : input.agents()) costs[i] = range_of(input, leaf, i).low;
  return costs;
}

/// The least price of costs in the leaf that hit all cores, from the given agent on.
std::optional<Cost> least_price(const LevelCores& input, const CoverLeaf& leaf, Costs& costs,
                                std::size_t agent = 0) {
  if (agent == costs.size())
    return hit_all(costs, input.cores) ? std::optional(input.price(costs)) : std::nullopt;
  const AgentId i(agent);
  const CoverLeaf::Range range = range_of(input, leaf, i);
  std::optional<Cost> best;
  std::vector<Cost> choices = input.levels_of(i);
  choices.insert(choices.begin(), range.low);
  for (std::size_t n = 0; n < choices.size(); ++n) {
    if (choices[n] < range.low || choices[n] >= range.high ||
        (n > 0 && choices[n] == choices[n - 1]))
      continue;
    costs[i] = choices[n];
    const auto price = least_price(input, leaf, costs, agent + 1);
    if (price && (!best || *price < *best)) best = price;
  }
  return best;
}
std::optional<Cost> least_price(const LevelCores& input, const CoverLeaf& leaf) {
  Costs costs = input.free_costs;
  return least_price(input, leaf, costs);
}

/// How much of the agent the leaf's fractional cover has at the level or above.
double part_at(const LevelCores& input, const CoverLeaf& leaf, const Level& level) {
  const CoverLeaf::Range range = range_of(input, leaf, level.agent);
  if (level.cost <= range.low) return 1;
  if (level.cost >= range.high) return 0;
  double part = 0;  // of the lowest level that is not below this one
  for (const CoverLeaf::Share& share : leaf.shares)  // by falling level
    if (share.level.agent == level.agent && share.level.cost >= level.cost) part = share.part;
  return part;
}

bool covers(const LevelCores& input, const CoverLeaf& leaf, const LevelCore& core) {
  double covered = 0;
  for (const Level& level : core) covered += part_at(input, leaf, level);
  return covered >= 1 - kTiny;
}
bool covers_all(const LevelCores& input, const CoverLeaf& leaf) {
  return std::all_of(input.cores.begin(), input.cores.end(),
                     [&](const LevelCore& core) { return covers(input, leaf, core); });
}

/// What the fractional cover costs above the free costs.
double price_of_shares(const LevelCores& input, const CoverLeaf& leaf) {
  double sum = static_cast<double>(input.price(low_ends(input, leaf)));
  for (std::size_t n = 0; n < leaf.shares.size(); ++n) {
    const auto& [level, part] = leaf.shares[n];
    // The part goes on from the next lower level of the agent to this one.
    Cost below = range_of(input, leaf, level.agent).low;
    if (n + 1 < leaf.shares.size() && leaf.shares[n + 1].level.agent == level.agent)
      below = leaf.shares[n + 1].level.cost;
    sum += part * static_cast<double>(level.cost - below);
  }
  return sum;
}

CoverLeaf draw_leaf(Random& random, const LevelCores& input) {
  CoverLeaf leaf;
  for (const AgentId i : input.agents()) {
    std::vector<Cost> ends = input.levels_of(i);
    ends.push_back(input.free_costs[i]);
    if (random.percent(40)) continue;
    CoverLeaf::Range range{i};
    if (random.percent(50)) range.low = random.pick(ends);
    const Cost high = random.pick(ends);
    if (random.percent(50) && high > std::max(range.low, input.free_costs[i])) range.high = high;
    leaf.ranges.push_back(range);
  }
  return leaf;
}

struct Case {
  LevelCores input;
  CoverLeaf leaf;
  Cost step;

  static Case draw(std::size_t seed) {
    Random random(seed);
    Case result;
    result.step = random.percent(50) ? 1 : 50'000'000;
    // Low levels and many cores make linear programs take halves.
    const std::size_t num_agents = random.percent(50) ? 6 : random.between(1, 5);
    const std::size_t num_levels = num_agents > 4 ? 2 : 6;
    result.input = LevelCores::draw(random, num_agents, random.below(16),
                                    random.between(1, num_levels), result.step);
    if (random.percent(50)) result.leaf = draw_leaf(random, result.input);
    return result;
  }
  /// What integers may lose of the bound of a linear program: a fraction of a tick per core, and
  /// what floating point does to large numbers.
  [[nodiscard]] double loss() const {
    return static_cast<double>(input.cores.size()) *
           (1.0 / 1024 + 1e-9 * static_cast<double>(step));
  }
};

/// How much it matters whether the level is reached, as far as that is open; 0: it is decided.
double undecided(const LevelCores& input, const CoverLeaf& leaf, const CoverLeaf::Share& share) {
  const double part = std::min(share.part, 1 - share.part);
  const Cost low = range_of(input, leaf, share.level.agent).low;
  return part > kTiny ? part * static_cast<double>(share.level.cost - low) : 0;
}

void expect_form(const LevelCores& input, const CoverLeaf& leaf) {
  for (std::size_t n = 0; n < leaf.shares.size(); ++n) {
    const auto& [level, part] = leaf.shares[n];
    const CoverLeaf::Range range = range_of(input, leaf, level.agent);
    EXPECT_GT(part, 0);
    EXPECT_LT(range.low, level.cost);
    EXPECT_LT(level.cost, range.high);
    if (n == 0) continue;
    EXPECT_GT(leaf.shares[n - 1].level, level);
    if (leaf.shares[n - 1].level.agent == level.agent) {
      EXPECT_LE(leaf.shares[n - 1].part, part + kTiny);
    }
  }
  if (!leaf.branch) return;
  double most = 0;
  for (const CoverLeaf::Share& share : leaf.shares)
    most = std::max(most, undecided(input, leaf, share));
  const auto chosen =
      std::find_if(leaf.shares.begin(), leaf.shares.end(),
                   [&](const CoverLeaf::Share& share) { return share.level == *leaf.branch; });
  if (most > 0) {
    ASSERT_NE(chosen, leaf.shares.end());
    EXPECT_GE(undecided(input, leaf, *chosen), most * (1 - kTiny));
  }
  const CoverLeaf::Range range = range_of(input, leaf, leaf.branch->agent);
  const std::vector<Cost> levels = input.levels_of(leaf.branch->agent);
  EXPECT_TRUE(std::binary_search(levels.begin(), levels.end(), leaf.branch->cost));
  EXPECT_LT(range.low, leaf.branch->cost);
  EXPECT_LT(leaf.branch->cost, range.high);
}

void expect_solved(const Case& c, const CoverLeaf& leaf, const Costs& costs, bool is_integral,
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
    const Case c = Case::draw(seed);
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
    const Case c = Case::draw(seed);
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
    Case c = Case::draw(seed);
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

// A leaf that is solved again and again: sums raise its bound, never above the least price; they
// hold whatever the leaf is, and serve other leaves.
TEST(LeafProgram, IsTightenedBySums) {
  std::size_t num_tightened = 0, num_served = 0;
  for (std::size_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE(seed);
    const Case c = Case::draw(seed);
    Random random(seed);
    const CoreTable table(c.input.pointers());
    LeafProgram program(c.input.free_costs);
    program.set_cores(table);
    CoverLeaf leaf = c.leaf, plain = c.leaf;
    Costs costs;
    const std::optional<Cost> least = least_price(c.input, c.leaf);
    ASSERT_EQ(program.solve(plain, costs), least.has_value());
    std::vector<CoverSum> sums;
    program.set_sums(sums);
    for (int k = 0; k < 30; ++k) {
      ASSERT_EQ(program.solve(leaf, costs), least.has_value());
      if (!least) break;
      ASSERT_LE(leaf.bound, *least);
      if (program.is_integral()) {
        ASSERT_TRUE(hit_all(costs, c.input.cores));
        ASSERT_EQ(c.input.price(costs), *least);
      }
    }
    num_tightened += static_cast<std::size_t>(leaf.bound > plain.bound);
    program.set_cores(table);
    program.set_sums(sums);  // without those of no use
    for (int k = 0; k < 5; ++k) {
      const CoverLeaf drawn = draw_leaf(random, c.input);
      CoverLeaf with = drawn, without = drawn;
      const std::optional<Cost> price = least_price(c.input, drawn);
      const bool has_solution = program.solve(with, costs);
      // Sums may see it where cores do not: then there is none.
      ASSERT_TRUE(has_solution || !price);
      LeafProgram other(c.input.free_costs);
      other.set_cores(table);
      ASSERT_EQ(other.solve(without, costs), price.has_value());
      if (!price) continue;
      ASSERT_LE(with.bound, *price);
      ASSERT_GE(static_cast<double>(with.bound), static_cast<double>(without.bound) - c.loss() - 1);
      num_served += static_cast<std::size_t>(with.bound > without.bound);
      expect_form(c.input, with);
      ASSERT_EQ(with.branch.has_value(), !hit_all(low_ends(c.input, with), c.input.cores));
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(num_tightened, scaled(3000) / 200);
  EXPECT_GE(num_served, scaled(3000) / 200);
}

TEST(LeafProgram, KeepsNoSumOfLevelsThatAreGone) {
  const LevelCores input{{0, 0}, {{{AgentId(0), 2}, {AgentId(1), 3}}}};
  const CoreTable table(input.pointers());
  LeafProgram program(input.free_costs);
  program.set_cores(table);
  const LevelSum known{{{AgentId(0), 2}, {AgentId(1), 3}}, 1};
  std::vector<CoverSum> sums{{known, true}, {known, false}, {{{{AgentId(0), 1}}, 1}, true}};
  program.set_sums(sums);
  ASSERT_EQ(sums.size(), 1u);
  EXPECT_EQ(sums.front().sum, known);
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
