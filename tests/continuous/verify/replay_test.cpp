// SPDX-License-Identifier: MIT
//
// All agents at once, looked up by place, against each pair of agents alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/random_walk.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous {
namespace {

using test::Draw;

/// The instance with these agents alone, and no obstacles.
Instance only(const Instance& instance, std::vector<AgentId> agents) {
  std::vector<Agent> kept;
  for (const AgentId i : agents) kept.push_back(instance.agent(i));
  return Instance::make(std::make_shared<const Roadmap>(instance.roadmap()), std::move(kept),
                        instance.resolution())
      .value();
}

struct Seen {
  std::size_t collisions = 0, obstacles = 0;
};

void compare_with_pairs(const Instance& instance, const Plan& plan, Seen& seen) {
  const VerifyReport whole = verify(instance, plan, kAllClearances);
  std::map<std::pair<AgentId, AgentId>, Clearance> clearances;
  for (const Clearance& c : whole.clearances)
    EXPECT_TRUE(clearances.emplace(std::pair(c.agent, c.other), c).second);
  for (const AgentId i : instance.agent_ids())
    for (const AgentId j : instance.agent_ids()) {
      if (i >= j) continue;
      const VerifyReport pair =
          verify(only(instance, {i, j}), Plan{{plan.paths[i], plan.paths[j]}}, kAllClearances);
      const auto found = clearances.find({i, j});
      ASSERT_EQ(found != clearances.end(), !pair.clearances.empty());
      // Who stands at the end stands for longer where others arrive later.
      if (found != clearances.end()) {
        EXPECT_NEAR(found->second.gap, pair.clearances[0].gap, 1e-9);
      }
      std::vector<std::pair<Ticks, double>> here, alone;
      for (const Violation& v : whole.violations)
        if (v.agent == i && v.other == j) here.emplace_back(v.tick, v.nearest.value());
      for (const Violation& v : pair.violations)
        if (v.other) alone.emplace_back(v.tick, v.nearest.value());
      ASSERT_EQ(here.size(), alone.size());
      for (std::size_t k = 0; k < here.size(); ++k) {
        EXPECT_EQ(here[k].first, alone[k].first);
        EXPECT_NEAR(here[k].second, alone[k].second, 1e-9);
      }
      seen.collisions += here.size();
    }
  for (const Violation& v : whole.violations)
    if (v.kind == Violation::Kind::obstacle) ++seen.obstacles;
  EXPECT_TRUE(std::is_sorted(whole.clearances.begin(), whole.clearances.end(),
                             [](const Clearance& a, const Clearance& b) { return a.gap < b.gap; }));
  // The least ones are the first of all, however few are asked for.
  for (const std::size_t num : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
    const VerifyReport least = verify(instance, plan, num);
    ASSERT_EQ(least.clearances.size(), std::min(num, whole.clearances.size()));
    for (std::size_t k = 0; k < least.clearances.size(); ++k) {
      EXPECT_EQ(least.clearances[k].gap, whole.clearances[k].gap);
      EXPECT_EQ(least.clearances[k].tick, whole.clearances[k].tick);
      EXPECT_EQ(least.clearances[k].agent, whole.clearances[k].agent);
      EXPECT_EQ(least.clearances[k].other, whole.clearances[k].other);
    }
    ASSERT_EQ(least.violations.size(), whole.violations.size());
    for (std::size_t k = 0; k < least.violations.size(); ++k)
      EXPECT_EQ(least.violations[k].message, whole.violations[k].message);
  }
}

TEST(Replay, FindsWhatPairsFind) {
  Seen seen;
  for (std::uint32_t seed = 0; seed < support::scaled(300); ++seed) {
    test::RandomOptions random;
    random.num_vertices = 12;
    random.num_agents = 5;
    random.edge_percent = 25;
    random.obstacles_percent = random.leaves_percent = random.release_percent = 25;
    if (seed % 3 == 1) random.size = 20'000, random.max_radius = 3'000;
    const Instance instance = test::random_instance(seed, random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << test::describe(instance));
    Draw draw(seed);
    for (int k = 0; k < 4; ++k) {
      Plan plan;
      for (const AgentId i : instance.agent_ids())
        plan.paths.push_back(test::draw_path(draw, instance, i));
      compare_with_pairs(instance, plan, seen);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(seen.collisions, 300U);
  EXPECT_GT(seen.obstacles, 30U);
}

}  // namespace
}  // namespace quadrille::continuous
