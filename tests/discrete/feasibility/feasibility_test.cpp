// SPDX-License-Identifier: MIT
#include "quadrille/discrete/feasibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "discrete/feasibility/feasibility_support.hpp"

namespace quadrille::discrete {
namespace {

using namespace feasibility_testing;  // NOLINT: the support of this very test
using ::testing::HasSubstr;

/// How much the randomised and exhaustive tests do, relative to a normal run.
double scale() {
  const char* text = std::getenv("QUADRILLE_TEST_SCALE");
  return text != nullptr ? std::atof(text) : 1.0;
}

template <class Starts, class Goals>
Feasibility check(const std::shared_ptr<const Graph>& graph, const Starts& starts,
                  const Goals& goals) {
  std::vector<Agent> tasks;
  for (std::size_t i = 0; i < starts.size(); ++i)
    tasks.push_back({VertexId(starts[i]), VertexId(goals[i])});
  return check_feasibility(Instance::make(graph, std::move(tasks)).value());
}

Feasibility check(const std::shared_ptr<const Graph>& graph, std::vector<std::size_t> starts,
                  std::vector<std::size_t> goals) {
  return check<std::vector<std::size_t>, std::vector<std::size_t>>(graph, starts, goals);
}

std::string describe(const Graph& graph, const Configuration& start, const Configuration& goal) {
  std::string text = "edges";
  for (std::size_t v = 0; v < graph.num_vertices(); ++v)
    for (const VertexId w : graph.neighbours(VertexId(v)))
      if (v < w.index()) text += " " + std::to_string(v) + "-" + std::to_string(w.value());
  for (std::size_t i = 0; i < start.size(); ++i)
    text += "; agent " + std::to_string(i) + ": " + std::to_string(start[i]) + " to " +
            std::to_string(goal[i]);
  return text;
}

/// A wrong answer, described; empty if the answer is right.
std::string wrong_answer(const std::shared_ptr<const Graph>& graph, const Configuration& start,
                         const Configuration& goal, bool reachable) {
  const Feasibility answer = check(graph, start, goal);
  if (answer.feasible == reachable && answer.feasible == answer.reason.empty()) return {};
  return describe(*graph, start, goal) +
         "; answer: " + (answer.feasible ? "feasible" : "infeasible, " + answer.reason);
}

/// Every pair of configurations, up to a renaming of the agents: the agents of a start have
/// increasing vertices.
void compare_all_pairs(const std::shared_ptr<const Graph>& graph, std::size_t num_agents) {
  const ConfigurationSpace space(*graph, num_agents);
  for (std::size_t s = 0; s < space.all().size(); ++s) {
    const Configuration& start = space.all()[s];
    if (!std::is_sorted(start.begin(), start.end())) continue;
    for (std::size_t g = 0; g < space.all().size(); ++g) {
      const std::string wrong =
          wrong_answer(graph, start, space.all()[g], space.class_of(s) == space.class_of(g));
      if (!wrong.empty()) FAIL() << wrong;
    }
  }
}

/// Every configuration with a representative of its class, and with some other configurations.
void compare_some_pairs(const std::shared_ptr<const Graph>& graph, std::size_t num_agents,
                        Random& random) {
  const ConfigurationSpace space(*graph, num_agents);
  const auto& all = space.all();
  for (std::size_t g = 0; g < all.size(); ++g) {
    const std::size_t own = space.representatives()[space.class_of(g)];
    for (const std::size_t s : {own, below(random, all.size()), below(random, all.size())}) {
      const std::string wrong =
          wrong_answer(graph, all[s], all[g], space.class_of(s) == space.class_of(g));
      if (!wrong.empty()) FAIL() << wrong;
    }
  }
}

// ---------------------------------------------------------------- against the configuration space

void compare_all_graphs(std::size_t num_vertices) {
  const auto graphs = connected_graphs(num_vertices);
  for (const Edges& edges : graphs) {
    const auto graph = make_graph(num_vertices, edges);
    for (std::size_t agents = 1; agents <= num_vertices; ++agents) {
      compare_all_pairs(graph, agents);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Feasibility, AgreesOnAllGraphsWithUpToFiveVertices) {
  EXPECT_EQ(connected_graphs(5).size(), 21u);
  for (std::size_t size = 1; size <= 5; ++size) compare_all_graphs(size);
}

TEST(Feasibility, AgreesOnAllGraphsWithSixVertices) {
  EXPECT_EQ(connected_graphs(6).size(), 112u);
  compare_all_graphs(6);
}

TEST(Feasibility, AgreesOnAllGraphsWithSevenVertices) {
  if (scale() < 100) GTEST_SKIP() << "takes long; QUADRILLE_TEST_SCALE >= 100 runs it";
  EXPECT_EQ(connected_graphs(7).size(), 853u);
  compare_all_graphs(7);
}

TEST(Feasibility, AgreesOnTreesAndUnicyclicGraphsWithEightVertices) {
  if (scale() < 100) GTEST_SKIP() << "takes long; QUADRILLE_TEST_SCALE >= 100 runs it";
  Random random(4);
  for (const Edges& edges : connected_graphs(8, 8)) {
    const auto graph = make_graph(8, edges);
    for (std::size_t agents = 2; agents <= 8; ++agents) {
      compare_some_pairs(graph, agents, random);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Feasibility, AgreesOnRandomTreesAndCacti) {
  Random random(1);
  const auto rounds = static_cast<int>(150 * scale());
  const std::size_t largest = scale() > 1 ? 700'000 : 20'000;
  for (int round = 0; round < rounds; ++round) {
    const auto [size, edges] = random_graph(7 + below(random, 6), random);
    const std::size_t agents = 2 + below(random, size - 1);
    if (num_configurations(size, agents) > largest) continue;
    SCOPED_TRACE("round " + std::to_string(round));
    compare_some_pairs(make_graph(size, edges), agents, random);
    if (HasFatalFailure()) return;
  }
}

TEST(Feasibility, AgreesOnRandomGrids) {
  Random random(2);
  const auto rounds = static_cast<int>(100 * scale());
  for (int round = 0; round < rounds; ++round) {
    const auto width = static_cast<std::int32_t>(2 + below(random, 4)), height = std::int32_t{3};
    std::vector<bool> passable(static_cast<std::size_t>(width * height));
    for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(random, 100) < 70;
    const auto graph = std::make_shared<const Graph>(Graph::grid(width, height, passable));
    if (graph->num_vertices() < 2) continue;
    const std::size_t agents = 2 + below(random, graph->num_vertices() - 1);
    if (num_configurations(graph->num_vertices(), agents) > 20'000) continue;
    SCOPED_TRACE("round " + std::to_string(round));
    compare_some_pairs(graph, agents, random);
    if (HasFatalFailure()) return;
  }
}

// ---------------------------------------------------------------- single cases and large maps

std::shared_ptr<const Graph> path_graph(std::size_t num_vertices) {
  Edges edges;
  for (std::size_t v = 1; v < num_vertices; ++v) edges.emplace_back(v - 1, v);
  return make_graph(num_vertices, edges);
}

/// A grid drawn with '.' for passable cells and anything else for blocked ones.
std::shared_ptr<const Graph> drawn_grid(const std::vector<std::string>& rows) {
  std::vector<bool> passable;
  for (const std::string& row : rows)
    for (const char c : row) passable.push_back(c == '.');
  return std::make_shared<const Graph>(Graph::grid(
      static_cast<std::int32_t>(rows[0].size()), static_cast<std::int32_t>(rows.size()), passable));
}

/// CPU time: what the clock says depends on what else the machine does.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(Feasibility, NamesTwoAgentsThatMeetInACorridor) {
  EXPECT_EQ(check(drawn_grid({"....."}), {4, 0}, {0, 4}).reason,
            "agents 0 and 1 cannot pass each other: the component of (4, 0) is a corridor without "
            "junctions");
}

TEST(Feasibility, AllowsAgentsToKeepTheirOrderInACorridor) {
  EXPECT_TRUE(check(path_graph(5), {0, 1}, {3, 4}).feasible);
  EXPECT_TRUE(check(path_graph(2), {0, 1}, {0, 1}).feasible);
}

TEST(Feasibility, RefusesToExchangeTwoOfFourAgentsOnAFullBoard) {
  const auto board = drawn_grid({"..", ".."});
  EXPECT_EQ(check(board, {0, 1, 2, 3}, {1, 0, 2, 3}).reason,
            "agents 0 and 1 cannot change their order relative to agent 2: none of them can leave "
            "the cycle of (0, 0), on which the cyclic order never changes");
  EXPECT_TRUE(check(board, {0, 1, 2, 3}, {1, 3, 0, 2}).feasible);
  EXPECT_TRUE(check(board, {0, 1}, {1, 0}).feasible);
  EXPECT_FALSE(check(board, {0, 1, 2}, {1, 0, 2}).feasible);
}

TEST(Feasibility, ExchangesTwoAgentsOnAFullBoardOfTwoCells) {
  EXPECT_TRUE(check(drawn_grid({"...", "..."}), {0, 1, 2, 3, 4, 5}, {1, 0, 2, 3, 4, 5}).feasible);
}

TEST(Feasibility, KnowsThatFullOddCyclesOnlyMakeEvenPermutations) {
  const auto bow_tie = make_graph(5, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 2}});
  EXPECT_THAT(check(bow_tie, {0, 1, 2, 3, 4}, {1, 0, 2, 3, 4}).reason, HasSubstr("odd length"));
  EXPECT_TRUE(check(bow_tie, {0, 1, 2, 3, 4}, {1, 0, 2, 4, 3}).feasible);
  EXPECT_TRUE(check(bow_tie, {0, 1, 2, 3}, {1, 0, 2, 3}).feasible);
}

TEST(Feasibility, NamesAnAgentThatNoCycleTakesToItsGoal) {
  const auto two_triangles =
      make_graph(6, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 5}, {5, 3}});
  EXPECT_THAT(check(two_triangles, {0, 1, 2, 3, 4, 5}, {3, 1, 2, 0, 4, 5}).reason,
              HasSubstr("agent 0 cannot get from 0 to 3"));
  EXPECT_TRUE(check(two_triangles, {0, 1, 2, 3, 4}, {3, 1, 2, 0, 4}).feasible);
}

TEST(Feasibility, NamesAnAgentWithoutAWay) {
  EXPECT_EQ(check(drawn_grid({"..#.."}), {0, 1}, {1, 3}).reason,
            "agent 1 cannot reach its goal (4, 0): no way leads there from its start (1, 0)");
}

TEST(Feasibility, CountsTheFreeVerticesThatACorridorTakes) {
  // Two forks, joined by a corridor of four vertices with the forks themselves.
  const auto map = drawn_grid({".##.", "....", ".##."});
  // Vertices: 0 (0,0), 1 (3,0), 2..5 the corridor, 6 (0,2), 7 (3,2).
  const Feasibility answer = check(map, {0, 6, 1, 7}, {1, 6, 0, 7});
  EXPECT_EQ(answer.reason,
            "agents 0 and 2 cannot pass each other in the corridor from (0, 1) to (3, 1): that "
            "takes 5 free vertices, and the component has 4");
  EXPECT_TRUE(check(map, {0, 6, 1, 7}, {6, 0, 7, 1}).feasible);
  EXPECT_TRUE(check(map, {0, 6, 1}, {1, 6, 0}).feasible);
}

TEST(Feasibility, TakesNoAgentsAndLonelyAgents) {
  EXPECT_TRUE(check(path_graph(3), {}, {}).feasible);
  EXPECT_TRUE(check(path_graph(1), {0}, {0}).feasible);
  EXPECT_TRUE(check(path_graph(3), {2}, {0}).feasible);
}

TEST(Feasibility, DecidesLongCorridorsAtOnce) {
  const auto corridor = path_graph(10'000);
  const auto start = std::clock();
  EXPECT_THAT(check(corridor, {0, 9'999}, {9'999, 0}).reason,
              HasSubstr("agents 0 and 1 cannot pass"));
  EXPECT_LT(seconds_since(start), 0.5);
}

TEST(Feasibility, NeedsNoDeepStack) {
  EXPECT_FALSE(check(path_graph(1'000'000), {0, 999'999}, {999'999, 0}).feasible);
}

TEST(Feasibility, FindsACorridorBesideALargeMap) {
  std::vector<std::string> rows(301, std::string(300, '.'));
  rows[1] = std::string(300, '#');
  const auto map = drawn_grid(rows);
  // 498 agents on every third cell of the open part, in reverse order at the end.
  std::vector<std::size_t> starts, goals;
  for (std::size_t i = 0; i < 498; ++i) starts.push_back(300 + 3 * i);
  goals.assign(starts.rbegin(), starts.rend());
  auto start = std::clock();
  EXPECT_TRUE(check(map, starts, goals).feasible);
  EXPECT_LT(seconds_since(start), 0.5);
  starts.insert(starts.end(), {10, 20});
  goals.insert(goals.end(), {20, 10});
  start = std::clock();
  EXPECT_THAT(check(map, starts, goals).reason, HasSubstr("agents 498 and 499 cannot pass"));
  EXPECT_LT(seconds_since(start), 0.5);
}

TEST(Feasibility, AcceptsWhatRandomStepsLeadTo) {
  Random random(3);
  const auto rounds = static_cast<int>(200 * scale());
  for (int round = 0; round < rounds; ++round) {
    const auto [size, edges] = random_graph(20 + below(random, 40), random);
    const auto graph = make_graph(size, edges);
    std::vector<std::size_t> places(size);
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::shuffle(places.begin(), places.end(), random);
    const std::size_t agents = size - 1 - below(random, 12);
    const std::vector<std::size_t> starts(places.begin(),
                                          places.begin() + static_cast<std::ptrdiff_t>(agents));
    std::vector<std::size_t> agent_at(size, SIZE_MAX), goals = starts;
    for (std::size_t i = 0; i < agents; ++i) agent_at[starts[i]] = i;
    for (int step = 0; step < 20'000; ++step) {
      const std::size_t agent = below(random, agents), from = goals[agent];
      const auto near = graph->neighbours(VertexId(from));
      const std::size_t to = near[below(random, near.size())].index();
      if (agent_at[to] != SIZE_MAX) continue;
      std::swap(agent_at[from], agent_at[to]);
      goals[agent] = to;
    }
    EXPECT_EQ(check(graph, starts, goals).reason, "") << "round " << round;
  }
}

}  // namespace
}  // namespace quadrille::discrete
