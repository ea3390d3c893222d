// SPDX-License-Identifier: MIT
#include "primal/guide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "discrete/primal/primal_support.hpp"
#include "reservations/soft_reservations.hpp"
#include "support/environment.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using quadrille::support::scaled;
using support::instance_text;

/// Where the guide leads from the start, until it leads nowhere.
Path followed(const Guide& guide, const Instance& instance, AgentId agent) {
  Path path(1, instance.agents()[agent].start);
  while (const auto next = guide.next(agent, path.back())) {
    path.push_back(*next);
    if (path.size() > instance.graph().num_vertices()) break;  // A circle.
  }
  return path;
}

/// Along shortest paths that are chosen without a look at the others.
Path descent(const Instance& instance, const GoalDistances& distances, AgentId agent) {
  const auto row = distances.row(agent);
  Path path(1, instance.agents()[agent].start);
  while (row[path.back()] > 0)
    for (const VertexId v : instance.graph().neighbours(path.back()))
      if (row[v] < row[path.back()]) {
        path.push_back(v);
        break;
      }
  return path;
}

std::int64_t num_meetings(const Instance& instance, const IdVector<AgentId, Path>& paths) {
  SoftReservations reservations(instance.graph().num_vertices());
  std::int64_t count = 0;
  for (const AgentId agent : instance.agent_ids()) {
    reservations.for_each_meeting(agent, paths[agent], [&](AgentId) { ++count; });
    reservations.add(agent, paths[agent]);
  }
  return count;
}

TEST(Guide, LeadsEachAgentToItsGoalWithinTheMargin) {
  support::Random random(11);
  std::size_t num_paths = 0;
  for (std::size_t round = 0; round < scaled(500); ++round) {
    const Instance instance = random_instance(random);
    const auto distances = distances_of(instance);
    bool is_cut_off = false;
    for (const AgentId i : instance.agent_ids())
      is_cut_off = is_cut_off || (*distances)(i, instance.agents()[i].start) == kUnreachable;
    if (is_cut_off) continue;
    LimitMonitor limits{Limits{}};
    const auto margin = static_cast<Timestep>(random.below(4));
    const Guide guide(instance, *distances, margin, static_cast<std::uint32_t>(round), limits);
    for (const AgentId agent : instance.agent_ids()) {
      const Path path = followed(guide, instance, agent);
      const VertexId start = instance.agents()[agent].start, goal = instance.agents()[agent].goal();
      ASSERT_EQ(path.back(), goal) << instance_text(instance);
      EXPECT_LE(static_cast<Timestep>(path.size()) - 1, (*distances)(agent, start) + margin);
      for (std::size_t t = 1; t < path.size(); ++t) {
        const auto near = instance.graph().neighbours(path[t - 1]);
        EXPECT_NE(std::find(near.begin(), near.end(), path[t]), near.end());
      }
      for (const VertexId v : IdRange<VertexId>(instance.graph().num_vertices()))
        if (std::find(path.begin(), path.end(), v) == path.end()) {
          EXPECT_EQ(guide.next(agent, v), std::nullopt);
        }
      ++num_paths;
    }
  }
  EXPECT_GE(num_paths, scaled(600));
}

TEST(Guide, ItsPathsMeetInFewerPlaces) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Instance instance = crowd(30, 150, seed);
    const auto distances = distances_of(instance);
    LimitMonitor limits{Limits{}};
    IdVector<AgentId, Path> shortest, narrow, wide;
    const Guide without(instance, *distances, 0, 0, limits),
        with(instance, *distances, 10, 0, limits);
    for (const AgentId agent : instance.agent_ids()) {
      shortest.push_back(descent(instance, *distances, agent));
      narrow.push_back(followed(without, instance, agent));
      wide.push_back(followed(with, instance, agent));
    }
    EXPECT_LT(2 * num_meetings(instance, narrow), num_meetings(instance, shortest));
    EXPECT_LT(2 * num_meetings(instance, wide), num_meetings(instance, narrow));
  }
}

TEST(Guide, TheSameSeedGivesTheSameGuide) {
  const Instance instance = crowd(20, 100, 4);
  const auto distances = distances_of(instance);
  LimitMonitor limits{Limits{}};
  const Guide one(instance, *distances, 5, 7, limits), two(instance, *distances, 5, 7, limits);
  EXPECT_EQ(one.effort(), two.effort());
  for (const AgentId agent : instance.agent_ids())
    EXPECT_EQ(followed(one, instance, agent), followed(two, instance, agent));
}

TEST(Guide, StopsAtLimits) {
  const Instance instance = crowd(20, 100, 4);
  std::atomic<bool> interrupt = true;
  Limits limits;
  limits.interrupt = &interrupt;
  LimitMonitor interrupted(limits);
  const Guide guide(instance, *distances_of(instance), 5, 7, interrupted);
  EXPECT_EQ(guide.effort(), 0);
  for (const AgentId agent : instance.agent_ids())
    EXPECT_EQ(guide.next(agent, instance.agents()[agent].start), std::nullopt);
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
