// SPDX-License-Identifier: MIT
#include "traffic/meetings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/random_walk.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

std::string text(const Encounter& e) {
  const auto step = [](const Step& s) {
    return std::string(s.is_move ? " e" : " v") +
           std::to_string(s.is_move ? s.edge.value() : s.vertex.value()) + " " +
           std::to_string(s.begin.value()) + ".." + std::to_string(s.end.value());
  };
  return std::to_string(e.first.value()) + "," + std::to_string(e.second.value()) + step(e.a) +
         step(e.b) + "; ";
}

// Against a comparison of all pairs, while paths are replaced one by one.
TEST(Meetings, AreThoseOfAllPairs) {
  std::size_t num_found = 0;
  std::int64_t num_pairs = 0, num_comparisons = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(300) && !testing::Test::HasFailure();
       ++seed) {
    SCOPED_TRACE(seed);
    RandomOptions options;
    options.num_agents = 2 + seed % 5;
    options.num_vertices = 8 + seed / 5 % 8;
    options.size = 120;
    const Instance instance = random_instance(seed, options);
    LimitMonitor limits{Limits{}};
    Scene scene(instance, limits);
    Meetings meetings(scene);
    Draw draw(seed);
    IdVector<AgentId, std::vector<Step>> paths(instance.num_agents());
    for (std::uint64_t version = 1; version <= 8; ++version) {
      for (const AgentId i : instance.agent_ids()) {
        if (version > 1 && draw.chance(60)) continue;
        paths[i] = draw_steps(draw, instance, i);
        meetings.put(i, paths[i], version);
      }
      std::string expected, found;
      for (const AgentId i : instance.agent_ids())
        for (const AgentId j : instance.agent_ids()) {
          if (!(i < j)) continue;
          ++num_pairs;
          if (const auto e = first_encounter(scene, i, paths[i], j, paths[j])) {
            expected += text(*e);
            ++num_found;
          }
        }
      for (const Encounter& e : meetings.encounters()) found += text(e);
      ASSERT_EQ(found, expected);
      const std::int64_t before = meetings.num_comparisons();
      for (const AgentId i : instance.agent_ids()) meetings.put(i, paths[i], 0);
      found.clear();
      for (const Encounter& e : meetings.encounters()) found += text(e);
      ASSERT_EQ(found, expected);
      EXPECT_GE(meetings.num_comparisons(), before);
    }
    num_comparisons += meetings.num_comparisons();
  }
  if (support::scaled(300) < 300) return;  // too few to count on chance
  EXPECT_GT(num_found, 1000u);
  EXPECT_LT(num_comparisons, 2 * num_pairs);
}

TEST(Meetings, PathsThatStayAreNotComparedAgain) {
  const Instance instance = random_instance(1, RandomOptions{});
  LimitMonitor limits{Limits{}};
  Scene scene(instance, limits);
  Meetings meetings(scene);
  Draw draw(1);
  IdVector<AgentId, std::vector<Step>> paths(instance.num_agents());
  for (const AgentId i : instance.agent_ids()) paths[i] = draw_steps(draw, instance, i);
  for (const AgentId i : instance.agent_ids()) meetings.put(i, paths[i], 1);
  static_cast<void>(meetings.encounters());
  const std::int64_t before = meetings.num_comparisons();
  for (const AgentId i : instance.agent_ids()) meetings.put(i, paths[i], 1);
  static_cast<void>(meetings.encounters());
  EXPECT_EQ(meetings.num_comparisons(), before);
  meetings.put(AgentId(0), paths[AgentId(0)], 2);
  static_cast<void>(meetings.encounters());
  EXPECT_LT(meetings.num_comparisons(), before + std::ssize(paths));
}

}  // namespace
}  // namespace quadrille::continuous::test
