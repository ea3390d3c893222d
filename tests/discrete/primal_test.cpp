// SPDX-License-Identifier: MIT
#include "quadrille/discrete/primal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "quadrille/discrete/movingai.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete {
namespace {

using State = PrimalSearch::State;
using quadrille::support::scaled;
using support::instance_text;
using support::joint_search;
using support::random_graph;
using support::random_grid;
using support::replay;

constexpr std::int64_t kNoEnd = INT64_MAX;

Instance instance_of(const std::string& text) {
  return support::parse_case(text, "test").value().instance;
}

std::shared_ptr<const GoalDistances> distances_of(const Instance& instance) {
  LimitMonitor limits{Limits{}};
  return GoalDistances::make(instance, limits);
}

/// A search that is over, with a plan or without.
PrimalSearch searched(const Instance& instance, std::uint32_t seed = 0) {
  LimitMonitor limits{Limits{}};
  PrimalSearch search(instance, distances_of(instance), seed);
  search.advance(kNoEnd, limits);
  return search;
}

Cost sum_of_distances(const Instance& instance) {
  Cost sum = 0;
  for (const AgentId agent : instance.agents())
    sum += distances_from(instance.graph(),
                          instance.tasks()[agent].start)[instance.tasks()[agent].goal];
  return sum;
}

/// Random small instances of all kinds: grids (some of them full of agents) and other graphs, small
/// enough for the joint search, and for the search to end when there is no plan.
Instance random_instance(support::Random& random) {
  switch (random.below(4)) {
    case 0:
      return random_graph(random, 6, 4);
    case 1:
      return random_grid(random, {2, 2, 25, 2, 4});
    case 2:
      return random_grid(random, {1, 3, 40, 2, 6});
    default:
      return random_grid(random, {2, 5, 40, 2, 3});
  }
}

TEST(GoalDistances, AreThoseOfABreadthFirstSearch) {
  support::Random random(1);
  for (int round = 0; round < 200; ++round) {
    const Instance instance = random_instance(random);
    const auto distances = distances_of(instance);
    for (const AgentId agent : instance.agents()) {
      const auto expected = distances_from(instance.graph(), instance.tasks()[agent].goal);
      for (const VertexId v : IdRange<VertexId>(instance.graph().num_vertices()))
        ASSERT_EQ((*distances)(agent, v), expected[v]) << instance_text(instance);
    }
  }
}

TEST(GoalDistances, ServesLargeGraphsAndStopsAtLimits) {
  // Longer than what fits into two bytes.
  const Instance instance = Instance::make(Graph::grid(70'000, 1, std::vector<bool>(70'000, true)),
                                           {{VertexId(0), VertexId(69'999)}})
                                .value();
  EXPECT_EQ((*distances_of(instance))(AgentId(0), VertexId(0)), 69'999);
  const std::atomic<bool> interrupt = true;
  Limits limits;
  limits.interrupt = &interrupt;
  LimitMonitor monitor(limits);
  EXPECT_EQ(GoalDistances::make(instance, monitor), nullptr);
}

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
  for (const Task& task : instance.tasks()) starts.push_back(task.start);
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
    std::vector<Task> tasks{{VertexId(size), VertexId(size + 1)},
                            {VertexId(size + 1), VertexId(size)}};
    tasks.insert(tasks.end(), inner.tasks().begin(), inner.tasks().end());
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

/// An empty grid in which the agents of a square change sides.
Instance crowd(std::int32_t side, std::size_t num_agents, std::uint64_t seed) {
  const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  support::Random random(seed);
  return support::random_tasks(random, Graph::grid(side, side, std::vector<bool>(cells, true)),
                               num_agents);
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
  std::vector<Task> tasks;
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
  while (sliced.advance(1, limits) == State::searching) ++slices;
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

TEST(PlanImprover, NeverWorsensAndStaysAboveTheOptimum) {
  support::Random random(4);
  std::size_t num_plans[2] = {0, 0}, num_optimal[2] = {0, 0};
  for (std::size_t round = 0; round < scaled(1200); ++round) {
    const Instance instance = random_instance(random);
    const auto objective = round % 2 == 0 ? Objective::sum_of_costs : Objective::makespan;
    const auto answer = joint_search(instance, objective, 100'000);
    if (answer.status != Status::optimal) continue;
    SCOPED_TRACE(instance_text(instance));
    const PrimalSearch search = searched(instance, 1);
    ASSERT_EQ(search.state(), State::found);
    LimitMonitor limits{Limits{}};
    PlanImprover improver(instance, distances_of(instance), objective, search.plan(), 1);
    ASSERT_EQ(improver.plan(), search.plan());
    for (int step = 0; step < 60; ++step) {
      const Cost cost = improver.cost();
      const Cost sum = improver.plan().cost(Objective::sum_of_costs);
      const bool improved = improver.step(limits);
      ASSERT_EQ(replay(instance, improver.plan()), "");
      ASSERT_EQ(improver.cost(), improver.plan().cost(objective));
      ASSERT_LE(improver.cost(), cost);
      const Cost new_sum = improver.plan().cost(Objective::sum_of_costs);
      ASSERT_TRUE(improver.cost() < cost || new_sum <= sum);
      ASSERT_EQ(improved, improver.cost() < cost || new_sum < sum);
    }
    ASSERT_GE(improver.cost(), answer.cost);
    ++num_plans[round % 2];
    if (improver.cost() == answer.cost) ++num_optimal[round % 2];
  }
  for (const int k : {0, 1}) {
    EXPECT_GE(num_plans[k], scaled(200));
    EXPECT_GE(num_optimal[k], num_plans[k] * 9 / 10);  // It is a local search; measured: 97 %.
  }
}

TEST(PlanImprover, PaysForASmallerMakespanWithTheSumOfCosts) {
  // Either the first agent waits once, or the second one three times.
  const Instance instance = instance_of(
      "map\n@@@@.@@@@@\n@@@@.@@@@@\n..........\n@@@.@@@@@@\n"
      "task 0 2 -> 9 2\ntask 4 0 -> 3 3\n");
  const auto distances = distances_of(instance);
  LimitMonitor limits{Limits{}};
  PlanImprover sum(instance, distances, Objective::sum_of_costs, searched(instance).plan(), 0);
  sum.improve(1000, limits);
  ASSERT_EQ(sum.cost(), 14);
  ASSERT_EQ(sum.plan().cost(Objective::makespan), 10);
  PlanImprover makespan(instance, distances, Objective::makespan, sum.plan(), 0);
  EXPECT_TRUE(makespan.improve(1000, limits));
  EXPECT_EQ(makespan.cost(), 9);
  EXPECT_EQ(makespan.plan().cost(Objective::sum_of_costs), 16);
}

TEST(PlanImprover, ImprovesCrowdsByMuch) {
  for (const auto objective : {Objective::sum_of_costs, Objective::makespan}) {
    const Instance instance = crowd(20, 150, 5);
    const Plan first = searched(instance).plan();
    LimitMonitor limits{Limits{}};
    PlanImprover improver(instance, distances_of(instance), objective, first, 0);
    EXPECT_TRUE(improver.improve(400'000, limits));
    ASSERT_TRUE(verify(instance, improver.plan()).valid());
    if (objective == Objective::makespan) {
      EXPECT_LE(improver.cost(), first.cost(objective));
      continue;
    }
    const Cost ideal = sum_of_distances(instance);
    EXPECT_LT(improver.cost() - ideal, (first.cost(objective) - ideal) / 4);
  }
}

TEST(PlanImprover, ReachesTheIdealPlanAndStops) {
  const Instance instance = crowd(30, 10, 6);
  LimitMonitor limits{Limits{}};
  PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                        searched(instance).plan(), 0);
  improver.improve(kNoEnd, limits);  // Ends, since there is such a plan.
  EXPECT_TRUE(improver.is_ideal());
  EXPECT_EQ(improver.cost(), sum_of_distances(instance));
  EXPECT_FALSE(improver.step(limits));
}

TEST(PlanImprover, StopsAtTheTarget) {
  const Instance instance = crowd(20, 150, 5);
  LimitMonitor limits{Limits{}};
  PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                        searched(instance).plan(), 0);
  const Cost target = improver.cost() - 20;
  EXPECT_TRUE(improver.improve(kNoEnd, limits, target));
  EXPECT_LE(improver.cost(), target);
  const std::int64_t effort = improver.effort();
  EXPECT_FALSE(improver.improve(kNoEnd, limits, target));
  EXPECT_EQ(improver.effort(), effort);
}

TEST(PlanImprover, DependsOnTheSeedAndNotOnSlicesOrRepetition) {
  const Instance instance = crowd(15, 100, 8);
  const Plan first = searched(instance).plan();
  const auto distances = distances_of(instance);
  LimitMonitor limits{Limits{}};
  const auto improved = [&](std::uint32_t seed, std::int64_t slice) {
    PlanImprover improver(instance, distances, Objective::sum_of_costs, first, seed);
    while (improver.effort() < 50'000) improver.improve(slice, limits);
    return improver.plan();
  };
  const Plan once = improved(1, 50'000);
  EXPECT_EQ(improved(1, 50'000), once);
  EXPECT_EQ(improved(1, 1), once);
  EXPECT_NE(improved(2, 50'000), once);
}

TEST(PlanImprover, GoesOnFromAnotherPlan) {
  const Instance instance = crowd(15, 100, 8);
  LimitMonitor limits{Limits{}};
  PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                        searched(instance, 1).plan(), 0);
  improver.improve(20'000, limits);
  Plan other = searched(instance, 2).plan();
  for (Path& path : other.paths) path.resize(path.size() + 3, path.back());  // Not trimmed.
  improver.restart_from(other);
  EXPECT_EQ(improver.cost(), other.cost(Objective::sum_of_costs));
  trim(other);
  EXPECT_EQ(improver.plan(), other);
  improver.improve(20'000, limits);
  EXPECT_TRUE(verify(instance, improver.plan()).valid());
  EXPECT_LT(improver.cost(), other.cost(Objective::sum_of_costs));
}

TEST(PlanImprover, KeepsAValidPlanWhereverItIsCut) {
  const Instance instance = crowd(30, 300, 9);
  const auto distances = distances_of(instance);
  const Plan first = searched(instance).plan();
  std::size_t num_cut_within = 0;
  for (int calls = 1; calls <= 60; ++calls) {
    // The ticker is called within every 16th look at the limits, many of them inside a step.
    std::atomic<bool> interrupt = false;
    Limits limits;
    limits.interrupt = &interrupt;
    LimitMonitor monitor(limits);
    int left = calls;
    monitor.set_ticker(0, [&] { interrupt = --left <= 0; });
    PlanImprover improver(instance, distances, Objective::sum_of_costs, first, 0);
    Cost cost = improver.cost();
    Plan plan = improver.plan();
    while (!monitor.exhausted()) {
      const bool improved = improver.step(monitor);
      if (interrupt && !improved && improver.plan() == plan) ++num_cut_within;
      plan = improver.plan();
      ASSERT_LE(improver.cost(), cost);
      cost = improver.cost();
    }
    ASSERT_TRUE(verify(instance, improver.plan()).valid());
    ASSERT_FALSE(improver.step(monitor));
    ASSERT_EQ(improver.plan(), plan);
  }
  EXPECT_GE(num_cut_within, 10u);
}

TEST(Primal, ComesCloseToTheReferenceCostsOfBenchmarks) {
  const auto folder = quadrille::support::data_folder();
  if (!folder) GTEST_SKIP() << "QUADRILLE_DATA is not set";
  struct Row {
    std::string map;
    std::size_t num_agents;
    Cost optimum;
  };
  const std::vector<Row> rows{{"random-32-32-20", 50, 1147}, {"maze-32-32-2", 25, 1407},
                              {"room-32-32-4", 35, 962},     {"den312d", 80, 4332},
                              {"empty-16-16", 70, 753},      {"Berlin_1_256", 200, 35309}};
  for (const Row& row : rows) {
    const auto map = read_map(*folder + "/movingai/maps/" + row.map + ".map").value();
    const auto scenario =
        read_scenario(*folder + "/movingai/scens/" + row.map + "-random-1.scen").value();
    const Instance instance =
        make_instance(std::make_shared<const Graph>(map.graph()), scenario, row.num_agents).value();
    LimitMonitor limits{Limits{}};
    PlanImprover improver(instance, distances_of(instance), Objective::sum_of_costs,
                          searched(instance).plan(), 0);
    improver.improve(1'000'000, limits);
    EXPECT_TRUE(verify(instance, improver.plan()).valid()) << row.map;
    EXPECT_GE(improver.cost(), row.optimum) << row.map;
    EXPECT_LE(improver.cost(), row.optimum + row.optimum / 100) << row.map;
  }
}

}  // namespace
}  // namespace quadrille::discrete
