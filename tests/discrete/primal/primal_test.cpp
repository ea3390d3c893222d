// SPDX-License-Identifier: MIT
#include "quadrille/discrete/primal.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "discrete/primal/primal_support.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using State = PrimalSearch::State;
using quadrille::support::scaled;
using support::instance_text;
using support::joint_search;
using support::random_graph;
using support::random_grid;
using support::replay;

TEST(PrimalSearch, FindsAPlanIfAndOnlyIfThereIsOne) {
  support::Random random(2);
  std::size_t num_feasible = 0, num_infeasible = 0;
  for (std::size_t round = 0; round < scaled(4000); ++round) {
    const Instance instance = random_instance(random);
    const auto answer = joint_search(instance, Objective::makespan);
    if (answer.status == Status::unknown) continue;
    const bool feasible = answer.status == Status::optimal;
    ++(feasible ? num_feasible : num_infeasible);
    const PrimalSearch search = searched(instance, static_cast<std::uint32_t>(round));
    ASSERT_EQ(search.state(), feasible ? State::found : State::exhausted)
        << instance_text(instance);
    if (!feasible) continue;
    ASSERT_EQ(replay(instance, search.plan()), "") << instance_text(instance);
    ASSERT_TRUE(verify(instance, search.plan()).valid());
  }
  EXPECT_GE(num_feasible, scaled(1000));
  EXPECT_GE(num_infeasible, scaled(500));
}

using Configuration = std::vector<VertexId>;

/// Appends all configurations that can follow one, the first agents of which are placed.
void append_successors(const Graph& graph, const Configuration& from, Configuration& placed,
                       std::vector<Configuration>& out) {
  const std::size_t i = placed.size();
  if (i == from.size()) {
    out.push_back(placed);
    return;
  }
  for (const VertexId to : IdRange<VertexId>(graph.num_vertices())) {
    bool allowed = to == from[i] || graph.adjacent(from[i], to);
    for (std::size_t j = 0; j < i; ++j)
      allowed = allowed && placed[j] != to && !(placed[j] == from[i] && to == from[j]);
    if (!allowed) continue;
    placed.push_back(to);
    append_successors(graph, from, placed, out);
    placed.pop_back();
  }
}

std::size_t num_reachable(const Instance& instance) {
  Configuration starts, none;
  for (const Agent& task : instance.agents()) starts.push_back(task.start);
  std::set<Configuration> seen{starts};
  std::vector<Configuration> queue{starts}, next;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    next.clear();
    append_successors(instance.graph(), queue[head], none, next);
    for (const Configuration& configuration : next)
      if (seen.insert(configuration).second) queue.push_back(configuration);
  }
  return seen.size();
}

TEST(PrimalSearch, VisitsAllConfigurationsBeforeItGivesUp) {
  // Two agents on an edge of its own cannot change places; the others can do all that the rest of
  // the graph allows.
  support::Random random(3);
  std::size_t num_ended = 0;
  for (std::size_t round = 0; round < scaled(300); ++round) {
    const Instance inner =
        random.below(2) == 0 ? random_graph(random, 5, 3) : random_grid(random, {2, 3, 30, 2, 3});
    const std::size_t size = inner.graph().num_vertices();
    std::vector<Graph::Edge> edges{{VertexId(size), VertexId(size + 1)}};
    for (const VertexId v : IdRange<VertexId>(size))
      for (const VertexId w : inner.graph().neighbours(v))
        if (v < w) edges.emplace_back(v, w);
    std::vector<Agent> tasks{{VertexId(size), VertexId(size + 1)},
                             {VertexId(size + 1), VertexId(size)}};
    tasks.insert(tasks.end(), inner.agents().begin(), inner.agents().end());
    const Instance instance =
        Instance::make(Graph::make(size + 2, edges).value(), std::move(tasks)).value();
    const PrimalSearch search = searched(instance);
    ASSERT_EQ(search.state(), State::exhausted);
    if (search.num_configurations() == 0) continue;  // There was no way to a goal.
    ASSERT_EQ(search.num_configurations(), num_reachable(instance)) << instance_text(instance);
    ++num_ended;
  }
  EXPECT_GE(num_ended, scaled(150));
}

TEST(PrimalSearch, SolvesWhatIsTight) {
  const std::vector<std::string> texts{
      // All turn round.
      "map\n..\n..\ntask 0 0 -> 1 0\ntask 1 0 -> 1 1\ntask 1 1 -> 0 1\ntask 0 1 -> 0 0\n",
      // They change places in an alcove.
      "map\n@@.@@\n.....\ntask 0 1 -> 4 1\ntask 4 1 -> 0 1\n",
      "map\n.@@@@@@@@\n.........\n@@@@.@@@@\ntask 0 1 -> 8 1\ntask 8 1 -> 0 1\ntask 4 1 -> 4 2\n",
      // A long corridor with the alcove at one end only.
      "map\n.@@@@@@@\n........\n.@@@@@@@\ntask 2 1 -> 7 1\ntask 7 1 -> 2 1\n",
      // Nothing to do; nobody there.
      "map\n..\ntask 0 0 -> 0 0\ntask 1 0 -> 1 0\n", "map\n..\n"};
  for (const std::string& text : texts) {
    const PrimalSearch search = searched(instance_of(text));
    ASSERT_EQ(search.state(), State::found) << text;
    EXPECT_EQ(replay(instance_of(text), search.plan()), "") << text;
  }
}

TEST(PrimalSearch, EndsWithoutAPlanWhereThereIsNone) {
  const std::vector<std::string> texts{
      "map\n......\ntask 0 0 -> 5 0\ntask 5 0 -> 0 0\n", "map\n.@.\ntask 0 0 -> 2 0\n",
      "map\n..\n..\ntask 0 0 -> 1 0\ntask 1 0 -> 0 0\ntask 0 1 -> 0 1\ntask 1 1 -> 1 1\n"};
  for (const std::string& text : texts) {
    EXPECT_EQ(searched(instance_of(text)).state(), State::exhausted) << text;
    LimitMonitor limits{Limits{}};
    EXPECT_EQ(find_plan(instance_of(text), limits, 0), std::nullopt);
    EXPECT_EQ(limits.reason(), StopReason::none);
  }
}

TEST(PrimalSearch, MovesLargeCrowds) {
  // The longer way of pushing: nearly all of 1600 cells are taken.
  for (const std::size_t num_agents : {500U, 1000U, 1400U}) {
    const Instance instance = crowd(40, num_agents, num_agents);
    const PrimalSearch search = searched(instance);
    ASSERT_EQ(search.state(), State::found);
    EXPECT_TRUE(verify(instance, search.plan()).valid());
  }
}

TEST(PrimalSearch, PushesALongQueue) {
  // Every vertex of a ring is taken and all want to go one on: whoever begins pushes all others.
  constexpr std::size_t kLength = 4000;
  std::vector<Graph::Edge> edges;
  std::vector<Agent> tasks;
  for (std::size_t k = 0; k < kLength; ++k) {
    edges.emplace_back(VertexId(k), VertexId((k + 1) % kLength));
    tasks.push_back({edges.back().first, edges.back().second});
  }
  const PrimalSearch search =
      searched(Instance::make(Graph::make(kLength, edges).value(), std::move(tasks)).value());
  ASSERT_EQ(search.state(), State::found);
  EXPECT_EQ(search.plan().cost(Objective::makespan), 1);
}

TEST(PrimalSearch, DependsOnTheSeedAndNotOnSlicesOrRepetition) {
  const Instance instance = crowd(10, 60, 3);
  const Plan once = searched(instance, 7).plan();
  EXPECT_EQ(searched(instance, 7).plan(), once);
  EXPECT_NE(searched(instance, 8).plan(), once);
  LimitMonitor limits{Limits{}};
  PrimalSearch sliced(instance, distances_of(instance), 7);
  int slices = 0;
  for (; !sliced.is_over(); ++slices) static_cast<void>(sliced.advance(1, limits));
  EXPECT_GT(slices, 5);
  EXPECT_EQ(sliced.plan(), once);
}

TEST(PrimalSearch, StopsAtLimitsAndGoesOn) {
  const Instance instance = crowd(10, 60, 3);
  std::atomic<bool> interrupt = true;
  Limits limits;
  limits.interrupt = &interrupt;
  LimitMonitor interrupted(limits), free{Limits{}};
  PrimalSearch search(instance, distances_of(instance), 7);
  EXPECT_EQ(search.advance(kNoEnd, interrupted), State::searching);
  EXPECT_EQ(find_plan(instance, interrupted, 7), std::nullopt);
  EXPECT_EQ(search.advance(kNoEnd, free), State::found);
  EXPECT_EQ(search.plan(), searched(instance, 7).plan());
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
