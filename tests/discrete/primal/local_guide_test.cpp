// SPDX-License-Identifier: MIT
#include "primal/local_guide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "discrete/primal/primal_support.hpp"
#include "pibt/pibt.hpp"
#include "primal/lacam.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using quadrille::support::scaled;
using support::instance_text;

constexpr std::size_t kWindow = LocalGuide::kWindow;
constexpr Cost kPenalty = LocalGuide::kPenalty;

bool has_goals_in_reach(const Instance& instance, const GoalDistances& distances) {
  for (const AgentId i : instance.agent_ids())
    if (distances(i, instance.agents()[i].start) == kUnreachable) return false;
  return true;
}

bool are_adjacent_or_same(const Graph& graph, VertexId a, VertexId b) {
  return a == b || graph.adjacent(a, b);
}

/// Of one agent among others, by what they are said to do.
class Prices {
 public:
  Prices(const Instance& instance, const GoalDistances& distances, const LocalGuide& guide,
         AgentId agent)
      : instance_(instance), distances_(distances), guide_(guide), agent_(agent) {}

  /// Whether a move that arrives at t meets others.
  [[nodiscard]] bool meets(VertexId from, VertexId to, std::size_t t) const {
    for (const AgentId other : instance_.agent_ids()) {
      if (other == agent_) continue;
      const auto path = guide_.path(other);
      if (path[t] == to || (from != to && path[t - 1] == to && path[t] == from)) return true;
    }
    return false;
  }
  /// Up to the goal, or the end of the window.
  [[nodiscard]] Cost of(std::span<const VertexId> path) const {
    Cost cost = 0;
    for (std::size_t t = 0; t < kWindow; ++t) {
      if (path[t] == goal()) return cost;
      cost += 1 + (meets(path[t], path[t + 1], t + 1) ? kPenalty : 0);
    }
    return cost + distances_(agent_, path[kWindow]);
  }
  /// The least of all paths, timestep by timestep.
  [[nodiscard]] Cost least(VertexId start) const {
    const Graph& graph = instance_.graph();
    const std::size_t size = graph.num_vertices();
    const auto vertices = IdRange<VertexId>(size);
    IdVector<VertexId, Cost> costs(size, kNone);
    costs[start] = 0;
    Cost least = kNone;
    for (std::size_t t = 0; t < kWindow; ++t) {
      IdVector<VertexId, Cost> next(size, kNone);
      least = std::min(least, costs[goal()]);
      costs[goal()] = kNone;
      for (const VertexId from : vertices)
        for (const VertexId to : vertices)
          if (costs[from] != kNone && are_adjacent_or_same(graph, from, to))
            next[to] =
                std::min(next[to], costs[from] + 1 + (meets(from, to, t + 1) ? kPenalty : 0));
      costs = next;
    }
    for (const VertexId v : vertices)
      if (costs[v] != kNone) least = std::min(least, costs[v] + distances_(agent_, v));
    return least;
  }

 private:
  static constexpr Cost kNone = INT64_MAX;
  [[nodiscard]] VertexId goal() const { return instance_.agents()[agent_].goal(); }

  const Instance& instance_;
  const GoalDistances& distances_;
  const LocalGuide& guide_;
  const AgentId agent_;
};

TEST(LocalGuide, TheLastPathIsTheCheapestAmongTheOthers) {
  support::Random random(21);
  std::size_t num_paths = 0, num_dear = 0;
  for (std::size_t round = 0; round < scaled(300); ++round) {
    const Instance instance = random_instance(random);
    const auto distances = distances_of(instance);
    if (!has_goals_in_reach(instance, *distances)) continue;
    Random draws(round);
    LocalGuide guide(instance, *distances, draws);
    std::vector<VertexId> now;
    std::vector<AgentId> order;
    for (const AgentId i : instance.agent_ids()) {
      now.push_back(instance.agents()[i].start);
      order.push_back(i);
    }
    for (int step = 0; step < 8; ++step) {
      draws.shuffle_front(order, order.size());
      guide.renew(now, order);
      for (const AgentId i : order) {
        const auto path = guide.path(i);
        ASSERT_EQ(path.size(), kWindow + 1);
        ASSERT_EQ(path[0], now[i.index()]);
        ASSERT_EQ(guide.next(i, now[i.index()]), path[1]);
        for (std::size_t t = 1; t <= kWindow; ++t)
          ASSERT_TRUE(are_adjacent_or_same(instance.graph(), path[t - 1], path[t]));
        for (const VertexId v : IdRange<VertexId>(instance.graph().num_vertices()))
          if (v != path[0]) {
            ASSERT_EQ(guide.next(i, v), std::nullopt);
          }
      }
      const AgentId last = order.back();
      const VertexId here = now[last.index()];
      if (here == instance.agents()[last].goal()) {
        ASSERT_EQ(guide.path(last)[kWindow], here);
      } else {
        const Prices prices(instance, *distances, guide, last);
        ASSERT_EQ(prices.of(guide.path(last)), prices.least(here)) << instance_text(instance);
        num_dear += prices.least(here) > (*distances)(last, here) ? 1 : 0;
        ++num_paths;
      }
      // Most follow their paths; the others stay, and their paths are forgotten.
      for (const AgentId i : order)
        if (random.percent(80)) now[i.index()] = guide.path(i)[1];
    }
  }
  EXPECT_GE(num_paths, scaled(300));
  EXPECT_GE(num_dear, scaled(50));
}

TEST(LocalGuide, TheSameSeedGivesTheSamePlan) {
  const Instance instance = crowd(14, 90, 3);
  const auto distances = distances_of(instance);
  const auto found = [&](std::int64_t slice) {
    LimitMonitor limits{Limits{}};
    const auto search = Lacam::guided_locally(instance, distances, 5);
    while (search->advance(slice, limits) == Lacam::State::searching) {
    }
    return search->plan();
  };
  const Plan plan = found(kNoEnd);
  EXPECT_TRUE(verify(instance, plan).valid());
  EXPECT_EQ(found(kNoEnd), plan);
  EXPECT_EQ(found(1), plan);
  EXPECT_EQ(found(777), plan);
}

TEST(LocalGuide, MakesCheaperPlansForCrowds) {
  Cost with = 0, without = 0;
  for (std::uint64_t seed = 0; seed < scaled(10); ++seed) {
    const Instance instance = crowd(20, 200, seed);
    const auto distances = distances_of(instance);
    LimitMonitor limits{Limits{}};
    Lacam plain(instance, distances, 0, nullptr);
    const auto guided = Lacam::guided_locally(instance, distances, 0);
    ASSERT_EQ(plain.advance(kNoEnd, limits), Lacam::State::found);
    ASSERT_EQ(guided->advance(kNoEnd, limits), Lacam::State::found);
    ASSERT_TRUE(verify(instance, guided->plan()).valid());
    with += guided->plan().cost(Objective::sum_of_costs);
    without += plain.plan().cost(Objective::sum_of_costs);
  }
  EXPECT_LT(10 * with, 9 * without);
}

/// One agent may go down or to the right; the other one, above it, would like to go to the right.
TEST(Pibt, LeavesToOthersWhatTheyWant) {
  const auto graph = std::make_shared<const Graph>(Graph::grid(4, 3, std::vector<bool>(12, true)));
  const auto at = [&](std::int32_t x, std::int32_t y) {
    return *graph->layout()->vertex_at({x, y});
  };
  const Instance instance =
      Instance::make(graph, {{at(1, 1), at(2, 2)}, {at(1, 0), at(3, 1)}}).value();
  const auto distances = distances_of(instance);
  const std::vector<VertexId> from{at(1, 1), at(1, 0)};
  const std::vector<AgentId> order{AgentId(0), AgentId(1)};
  std::size_t num_right = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random draws(seed), others(seed);
    Pibt considerate(instance, *distances, draws, nullptr, Pibt::Ties::least_wanted);
    Pibt indifferent(instance, *distances, others);
    std::vector<VertexId> to;
    ASSERT_TRUE(considerate.advance(from, order, {}, to));
    EXPECT_EQ(to[0], at(1, 2));
    ASSERT_TRUE(indifferent.advance(from, order, {}, to));
    num_right += to[0] == at(2, 1) ? 1 : 0;
  }
  EXPECT_GE(num_right, 10);
  EXPECT_LE(num_right, 30);
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
