// SPDX-License-Identifier: MIT
// Sums against all integer costs that satisfy what they follow from, and against all sums of two
// and three by the definition.
#include "cover/half_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "continuous/cover/level_cores.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::scaled;
using Costs = IdVector<AgentId, Cost>;

/// The violation from which on sums are asked for.
constexpr double kEnough = 0.2, kTiny = 1e-6;

/// How many of the levels are reached.
int reached(const LevelSum& sum, const Costs& costs) {
  return static_cast<int>(
      std::count_if(sum.levels.begin(), sum.levels.end(),
                    [&](const Level& level) { return costs[level.agent] >= level.cost; }));
}

/// Levels with parts that fall with the level, and sums of these levels.
struct Case {
  std::vector<Level> levels;
  std::vector<double> parts;
  std::vector<LevelSum> sums;
  Cost num_levels = 1;
  std::size_t num_agents = 1;

  static Case draw(Random& random, bool has_doubles) {
    Case result;
    result.num_agents = random.between(2, 5);
    result.num_levels = static_cast<Cost>(random.between(1, 3));
    for (const AgentId i : IdRange<AgentId>(result.num_agents)) {
      // Halves and thirds are what programs say; the others must do as well.
      double part = random.percent(50) ? 0.5 : 0.01 * static_cast<double>(random.between(0, 100));
      for (Cost cost = 1; cost <= result.num_levels; ++cost) {
        result.levels.push_back({i, cost});
        result.parts.push_back(part);
        if (random.percent(50)) part = random.percent(50) ? part / 2 : 0;
      }
    }
    const std::size_t num_sums = random.between(2, 8);
    while (result.sums.size() < num_sums) {
      LevelSum sum;
      for (const AgentId i : IdRange<AgentId>(result.num_agents))
        if (random.percent(50))
          sum.levels.push_back({i, static_cast<Cost>(random.between(
                                       1, static_cast<std::size_t>(result.num_levels)))});
      if (random.percent(20)) sum.least = static_cast<int>(random.between(1, 2));
      if (has_doubles && random.percent(20)) {  // as sums of sums are
        sum.levels.insert(sum.levels.end(), sum.levels.begin(), sum.levels.end());
        std::sort(sum.levels.begin(), sum.levels.end());
        sum.least = static_cast<int>(random.between(1, 3));
      }
      if (!sum.levels.empty()) result.sums.push_back(sum);
    }
    return result;
  }
  [[nodiscard]] std::vector<std::uint32_t> rows_of(const LevelSum& sum) const {
    std::vector<std::uint32_t> rows;
    for (const Level& level : sum.levels)
      rows.push_back(static_cast<std::uint32_t>(
          std::lower_bound(levels.begin(), levels.end(), level) - levels.begin()));
    return rows;
  }
  [[nodiscard]] double part(const LevelSum& sum) const {
    double result = 0;
    for (const std::uint32_t r : rows_of(sum)) result += parts[r];
    return result;
  }
  [[nodiscard]] std::vector<LevelSum> find(std::size_t most) const {
    std::vector<std::vector<std::uint32_t>> rows;
    for (const LevelSum& sum : sums) rows.push_back(rows_of(sum));
    HalfSums finder(levels, parts);
    for (std::size_t k = 0; k < sums.size(); ++k) finder.add({rows[k], sums[k].least});
    return finder.find(most);
  }
  /// Whether the parts leave something to be found in it.
  [[nodiscard]] bool is_open(const LevelSum& sum) const {
    const auto rows = rows_of(sum);
    return part(sum) < sum.least + 1 && std::any_of(rows.begin(), rows.end(), [&](std::uint32_t r) {
             return parts[r] > kTiny && parts[r] < 1 - kTiny;
           });
  }
  /// All costs with which all sums hold.
  [[nodiscard]] std::vector<Costs> solutions() const {
    std::vector<Costs> result;
    Costs costs(num_agents, 0);
    while (true) {
      if (std::all_of(sums.begin(), sums.end(),
                      [&](const LevelSum& sum) { return reached(sum, costs) >= sum.least; }))
        result.push_back(costs);
      std::size_t k = 0;
      while (k < num_agents && costs[AgentId(k)] == num_levels) costs[AgentId(k++)] = 0;
      if (k == num_agents) return result;
      ++costs[AgentId(k)];
    }
  }
};

/// Every second level of each agent, of all levels of the three; two of them may be the same.
LevelSum half_of(const std::vector<const LevelSum*>& summands) {
  std::vector<Level> all;
  int least = 0;
  for (const LevelSum* sum : summands) {
    all.insert(all.end(), sum->levels.begin(), sum->levels.end());
    least += sum->least;
  }
  std::sort(all.begin(), all.end());
  LevelSum half{{}, (least + 1) / 2};
  std::size_t of_agent = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    of_agent = k > 0 && all[k].agent == all[k - 1].agent ? of_agent + 1 : 0;
    if (of_agent % 2 == 0) half.levels.push_back(all[k]);
  }
  return half;
}

/// The largest violation of a sum of two or three open ones.
double most_violated(const Case& c) {
  double most = 0;
  const auto look = [&](const std::vector<const LevelSum*>& summands) {
    int n = 0;
    for (const LevelSum* sum : summands) {
      if (!c.is_open(*sum)) return;
      n += sum->least;
    }
    if (n % 2 == 0) return;
    const LevelSum half = half_of(summands);
    most = std::max(most, half.least - c.part(half));
  };
  for (std::size_t a = 0; a < c.sums.size(); ++a)
    for (std::size_t b = a + 1; b < c.sums.size(); ++b) {
      look({&c.sums[a], &c.sums[b]});
      for (std::size_t d = b + 1; d < c.sums.size(); ++d)
        look({&c.sums[a], &c.sums[b], &c.sums[d]});
    }
  return most;
}

TEST(HalfSums, HoldAndAreViolated) {
  std::size_t num_found = 0, num_tight = 0;
  for (std::size_t seed = 0; seed < scaled(20'000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Case c = Case::draw(random, true);
    const std::vector<LevelSum> found = c.find(100);
    num_found += static_cast<std::size_t>(!found.empty());
    const std::vector<Costs> solutions = c.solutions();
    double last = INFINITY;
    for (const LevelSum& sum : found) {
      EXPECT_TRUE(std::is_sorted(sum.levels.begin(), sum.levels.end()));
      const double violation = sum.least - c.part(sum);
      EXPECT_GT(violation, kEnough - kTiny);
      EXPECT_LE(violation, last + kTiny);
      last = violation;
      bool is_tight = false;
      for (const Costs& costs : solutions) {
        EXPECT_GE(reached(sum, costs), sum.least);
        is_tight |= reached(sum, costs) == sum.least;
      }
      num_tight += static_cast<std::size_t>(is_tight);
    }
    EXPECT_EQ(std::set<LevelSum>(found.begin(), found.end()).size(), found.size());
    const std::vector<LevelSum> best = c.find(1);
    EXPECT_EQ(best.size(), std::min<std::size_t>(1, found.size()));
    if (!best.empty()) {
      EXPECT_EQ(best.front(), found.front());
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(num_found, scaled(20'000) / 50);
  EXPECT_GE(num_tight, scaled(20'000) / 100);  // one more would be wrong
}

// Where no summand lists an agent twice.
TEST(HalfSums, MissNone) {
  std::size_t num_found = 0;
  for (std::size_t seed = 0; seed < scaled(20'000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Case c = Case::draw(random, false);
    const std::vector<LevelSum> found = c.find(100);
    const double most = most_violated(c);
    if (std::abs(most - kEnough) < kTiny) continue;
    ASSERT_EQ(!found.empty(), most > kEnough);
    if (found.empty()) continue;
    ++num_found;
    ASSERT_NEAR(found.front().least - c.part(found.front()), most, kTiny);
  }
  EXPECT_GE(num_found, scaled(20'000) / 50);
}

TEST(HalfSums, OfATriangle) {
  // Of three agents each pair has a core; halves satisfy these, and two agents must pay.
  const std::vector<Level> levels{{AgentId(0), 1}, {AgentId(1), 1}, {AgentId(2), 1}};
  const std::vector<double> halves{0.5, 0.5, 0.5};
  const std::vector<std::uint32_t> a{0, 1}, b{1, 2}, c{0, 2};
  HalfSums finder(levels, halves);
  for (const auto* rows : {&a, &b, &c}) finder.add({*rows, 1});
  EXPECT_EQ(finder.find(5), (std::vector<LevelSum>{{levels, 2}}));
}

}  // namespace
}  // namespace quadrille::continuous::test
