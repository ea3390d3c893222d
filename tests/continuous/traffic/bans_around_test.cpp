// SPDX-License-Identifier: MIT
#include "traffic/bans_around.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::continuous::test {
namespace {

/// A cheapest path of the agent alone, with random waits before its moves.
TimedPath walk(Scene& scene, AgentId i, Random& random) {
  PathFinder finder(scene.instance());
  BanTable nothing(scene.instance().roadmap());
  TimedPath path;
  static_cast<void>(finder.find(scene.task(i), nothing, kForever, &path));
  Ticks late{0};
  for (Move& move : path.moves) {
    late += Ticks{static_cast<std::int64_t>(random.below(3) * random.below(1'500'000))};
    move.start += late;
  }
  path.arrival += late;
  return path;
}

// Twice for each instance, so that what was looked up is used again, at other times.
TEST(BansAround, AreBrokenIfAndOnlyIfTheAgentsMeet) {
  Random random(5);
  int meetings = 0, count = 0;
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    RandomOptions options;
    options.num_agents = 2;
    options.num_vertices = 5 + seed % 4;
    const Instance instance = random_instance(seed, options);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    LimitMonitor limits({});
    Scene scene(instance, limits);
    BansAround around(scene);
    const AgentId i(0), j(1);
    if (scene.free_cost(i) >= kAnyCost || scene.free_cost(j) >= kAnyCost) continue;
    for (int round = 0; round < 4; ++round) {
      const TimedPath path = walk(scene, i, random), other = walk(scene, j, random);
      std::vector<Step> steps, other_steps;
      list_steps(instance, i, path, steps);
      list_steps(instance, j, other, other_steps);
      std::vector<Ban> bans;
      around.add(instance.class_of(i), instance.class_of(j), other_steps, bans);
      PathUses uses;
      uses.assign(instance, i, path);
      const bool meet = first_encounter(scene, i, steps, j, other_steps).has_value();
      ASSERT_EQ(uses.breaks(bans), meet);
      meetings += static_cast<int>(meet);
      ++count;
    }
  }
  EXPECT_GT(meetings, 50);
  EXPECT_GT(count - meetings, 50);
}

}  // namespace
}  // namespace quadrille::continuous::test
