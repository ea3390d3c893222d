// SPDX-License-Identifier: MIT
#include "reservations/soft_path_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "discrete/primal/primal_support.hpp"
#include "support/environment.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using quadrille::support::scaled;
using support::instance_text;

/// A random walk from the agent's start, with waits.
Path random_walk(support::Random& random, const Graph& graph, VertexId start) {
  Path path(1, start);
  for (std::size_t left = random.below(12); left > 0; --left) {
    const auto near = graph.neighbours(path.back());
    const std::size_t way = random.below(near.size() + 1);
    path.push_back(way == near.size() ? path.back() : near[way]);
  }
  path.resize(static_cast<std::size_t>(arrival(path)) + 1);
  return path;
}

/// When somebody is met by who goes from `from` at t - 1 to `to` at t: whoever is there, unless it
/// was met before because both wait; and whoever comes the other way.
std::int64_t met_at(const std::vector<Path>& others, VertexId from, VertexId to, Timestep t) {
  return std::count_if(others.begin(), others.end(), [&](const Path& other) {
    const VertexId before = position(other, t - 1), now = position(other, t);
    if (now == to) return from != to || before != to;
    return from != to && now == from && before == to;
  });
}

std::int64_t meetings_of(const Path& path, const std::vector<Path>& others, Timestep end) {
  auto sum = std::count_if(others.begin(), others.end(),
                           [&](const Path& other) { return other.front() == path.front(); });
  for (Timestep t = 1; t <= end; ++t)
    sum += met_at(others, position(path, t - 1), position(path, t), t);
  return sum;
}

/// Fewest meetings, then least arrival, timestep by timestep.
std::optional<std::pair<std::int64_t, Timestep>> best(const Instance& instance, AgentId agent,
                                                      const std::vector<Path>& others,
                                                      Timestep latest, Timestep end) {
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max() / 2;
  const Graph& graph = instance.graph();
  const VertexId start = instance.agents()[agent].start, goal = instance.agents()[agent].goal();
  std::vector<std::int64_t> least(graph.num_vertices(), kNever);
  least[start.index()] = meetings_of({start}, others, 0);
  std::optional<std::pair<std::int64_t, Timestep>> result;
  for (Timestep t = 0; t <= latest; ++t) {
    if (least[goal.index()] < kNever) {
      std::int64_t sum = least[goal.index()];
      for (Timestep later = t + 1; later <= end; ++later) sum += met_at(others, goal, goal, later);
      if (!result || sum < result->first) result = {sum, t};
    }
    std::vector<std::int64_t> next(graph.num_vertices(), kNever);
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      if (least[v.index()] == kNever) continue;
      const auto go = [&](VertexId to) {
        next[to.index()] =
            std::min(next[to.index()], least[v.index()] + met_at(others, v, to, t + 1));
      };
      go(v);
      for (const VertexId w : graph.neighbours(v)) go(w);
    }
    least = next;
  }
  return result;
}

TEST(SoftPathPlanner, MeetsAsFewAsPossibleAndThenArrivesAsSoonAsPossible) {
  support::Random random(1);
  Random draws(1);
  LimitMonitor limits{Limits{}};
  std::size_t num_free = 0, num_meeting = 0, num_none = 0, num_late = 0;
  for (std::size_t round = 0; round < scaled(6000); ++round) {
    const Instance instance = random.below(3) == 0 ? support::random_graph(random, 8, 5)
                                                   : support::random_grid(random, {1, 5, 40, 2, 6});
    SCOPED_TRACE(instance_text(instance));
    const auto distances = distances_of(instance);
    const AgentId agent(0);
    std::vector<Path> others;
    SoftReservations reservations(instance.graph().num_vertices());
    for (const AgentId other : instance.agent_ids()) {
      if (other == agent) continue;
      // Several start in the same place, even in that of the agent.
      const VertexId start = instance.agents()[random.below(3) == 0 ? agent : other].start;
      others.push_back(random_walk(random, instance.graph(), start));
      reservations.add(other, others.back());
    }
    const auto latest = static_cast<Timestep>(random.below(25));
    const Timestep end = latest + 20;
    const auto expected = best(instance, agent, others, latest, end);
    SoftPathPlanner planner(instance, *distances, draws);
    const auto found = planner.find(agent, reservations, latest, 1000, 1'000'000, limits);
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (!found) {
      ++num_none;
      continue;
    }
    const auto& [path, num_meetings] = *found;
    ASSERT_EQ(num_meetings, expected->first);
    ASSERT_EQ(path.size(), static_cast<std::size_t>(expected->second) + 1);
    ASSERT_EQ(arrival(path), expected->second);
    ASSERT_EQ(meetings_of(path, others, end), num_meetings);
    ASSERT_EQ(path.front(), instance.agents()[agent].start);
    ASSERT_EQ(path.back(), instance.agents()[agent].goal());
    for (std::size_t t = 1; t < path.size(); ++t)
      ASSERT_TRUE(path[t - 1] == path[t] || instance.graph().adjacent(path[t - 1], path[t]));
    std::int64_t num_reserved = 0;
    reservations.for_each_meeting(agent, path, [&](AgentId) { ++num_reserved; });
    ASSERT_EQ(num_reserved, num_meetings);
    ASSERT_FALSE(planner.find(agent, reservations, latest, num_meetings - 1, 1'000'000, limits));
    ++(num_meetings == 0 ? num_free : num_meeting);
    if (expected->second > (*distances)(agent, path.front())) ++num_late;
  }
  EXPECT_GE(num_free, scaled(500));
  EXPECT_GE(num_meeting, scaled(500));
  EXPECT_GE(num_none, scaled(300));
  EXPECT_GE(num_late, scaled(300));
}

TEST(SoftPathPlanner, GivesUpWhenToldTo) {
  const Instance instance =
      Instance::make(Graph::grid(20, 1, std::vector<bool>(20, true)), {{VertexId(0), VertexId(19)}})
          .value();
  Random draws(1);
  const auto distances = distances_of(instance);
  SoftPathPlanner planner(instance, *distances, draws);
  LimitMonitor limits{Limits{}};
  const SoftReservations nothing(20);
  EXPECT_FALSE(planner.find(AgentId(0), nothing, 100, 0, 10, limits));
  EXPECT_EQ(planner.effort(), 10);
  EXPECT_FALSE(planner.find(AgentId(0), nothing, 18, 0, 1000, limits));
  EXPECT_TRUE(planner.find(AgentId(0), nothing, 19, 0, 1000, limits));
  // It looks at the limits after 64 labels at the latest.
  const std::atomic<bool> interrupt{true};
  Limits interrupted;
  interrupted.interrupt = &interrupt;
  LimitMonitor over(interrupted);
  std::size_t num_found = 0;
  for (int k = 0; k < 10; ++k)
    if (planner.find(AgentId(0), nothing, 100, 0, 1000, over)) ++num_found;
  EXPECT_GE(num_found, 5U);
  EXPECT_LT(num_found, 10U);
}

TEST(SoftReservations, ForgetWhatIsTakenOut) {
  support::Random random(2);
  for (std::size_t round = 0; round < scaled(500); ++round) {
    const Instance instance = support::random_grid(random, {2, 4, 30, 2, 6});
    const Graph& graph = instance.graph();
    SoftReservations reservations(graph.num_vertices()), expected(graph.num_vertices());
    std::vector<std::pair<AgentId, Path>> paths;
    for (const AgentId agent : instance.agent_ids()) {
      paths.emplace_back(agent, random_walk(random, graph, instance.agents()[AgentId(0)].start));
      reservations.add(agent, paths.back().second);
    }
    for (const auto& [agent, path] : paths) {
      if (random.below(2) == 0)
        reservations.remove(agent, path);
      else
        expected.add(agent, path);
    }
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      const auto pieces = reservations.pieces(v), others = expected.pieces(v);
      ASSERT_EQ(reservations.stays(v).size(), expected.stays(v).size());
      ASSERT_EQ(pieces.size(), others.size());
      ASSERT_LE(pieces.size(), 2 * expected.stays(v).size() + 1);
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        ASSERT_EQ(pieces[k].begin, others[k].begin);
        ASSERT_EQ(pieces[k].present, others[k].present);
        ASSERT_EQ(pieces[k].begins, others[k].begins);
        ASSERT_EQ(pieces[k].ends, others[k].ends);
      }
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
