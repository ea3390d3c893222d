// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "continuous/cover/level_cores.hpp"
#include "cover/leaf_program.hpp"

namespace quadrille::continuous::test {

using Costs = IdVector<AgentId, Cost>;

inline constexpr double kTiny = 1e-6;
inline constexpr Cost kMax = std::numeric_limits<Cost>::max();

/// What the leaf says about the agent.
inline CoverLeaf::Range range_of(const LevelCores& input, const CoverLeaf& leaf, AgentId agent) {
  for (const CoverLeaf::Range& range : leaf.ranges)
    if (range.agent == agent)
      return {agent, std::max(range.low, input.free_costs[agent]), range.high};
  return {agent, input.free_costs[agent], kMax};
}

inline Costs low_ends(const LevelCores& input, const CoverLeaf& leaf) {
  Costs costs = input.free_costs;
  for (const AgentId i : input.agents()) costs[i] = range_of(input, leaf, i).low;
  return costs;
}

/// The least price of costs in the leaf that hit all cores, from the given agent on.
inline std::optional<Cost> least_price(const LevelCores& input, const CoverLeaf& leaf, Costs& costs,
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
inline std::optional<Cost> least_price(const LevelCores& input, const CoverLeaf& leaf) {
  Costs costs = input.free_costs;
  return least_price(input, leaf, costs);
}

/// How much of the agent the leaf's fractional cover has at the level or above.
inline double part_at(const LevelCores& input, const CoverLeaf& leaf, const Level& level) {
  const CoverLeaf::Range range = range_of(input, leaf, level.agent);
  if (level.cost <= range.low) return 1;
  if (level.cost >= range.high) return 0;
  double part = 0;  // of the lowest level that is not below this one
  for (const CoverLeaf::Share& share : leaf.shares)  // by falling level
    if (share.level.agent == level.agent && share.level.cost >= level.cost) part = share.part;
  return part;
}

inline bool covers(const LevelCores& input, const CoverLeaf& leaf, const LevelCore& core) {
  double covered = 0;
  for (const Level& level : core) covered += part_at(input, leaf, level);
  return covered >= 1 - kTiny;
}
inline bool covers_all(const LevelCores& input, const CoverLeaf& leaf) {
  return std::all_of(input.cores.begin(), input.cores.end(),
                     [&](const LevelCore& core) { return covers(input, leaf, core); });
}

/// What the fractional cover costs above the free costs.
inline double price_of_shares(const LevelCores& input, const CoverLeaf& leaf) {
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

inline CoverLeaf draw_leaf(Random& random, const LevelCores& input) {
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

/// Some cores, and a leaf of their tree.
struct LeafCase {
  LevelCores input;
  CoverLeaf leaf;
  Cost step;

  static LeafCase draw(std::size_t seed) {
    Random random(seed);
    LeafCase result;
    result.step = random.percent(50) ? 1 : 50'000'000;
    // Low levels and many cores make linear programs take halves.
    const std::size_t num_agents = random.percent(50) ? 6 : random.between(1, 5);
    const std::size_t num_levels = num_agents > 4 ? 2 : 6;
    const std::size_t num_cores = random.below(16), highest = random.between(1, num_levels);
    result.input = LevelCores::draw(random, num_agents, num_cores, highest, result.step);
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
inline double undecided(const LevelCores& input, const CoverLeaf& leaf,
                        const CoverLeaf::Share& share) {
  const double part = std::min(share.part, 1 - share.part);
  const Cost low = range_of(input, leaf, share.level.agent).low;
  return part > kTiny ? part * static_cast<double>(share.level.cost - low) : 0;
}

inline void expect_form(const LevelCores& input, const CoverLeaf& leaf) {
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

}  // namespace quadrille::continuous::test
