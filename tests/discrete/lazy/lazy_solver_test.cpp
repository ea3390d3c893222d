// SPDX-License-Identifier: MIT
// The lazy path model against the MDD path model, on small random instances, with all its lemmas
// audited.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "quadrille/discrete/solver.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/tuned_options.hpp"

namespace quadrille::discrete {
namespace {

using support::TunedOptions;

/// A grid or a graph with random obstacles (edges), and tasks within one component.
std::optional<Instance> random_instance(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::optional<Graph> graph;
  if (below(4) > 0) {
    const auto width = static_cast<std::int32_t>(2 + below(5));
    const auto height = static_cast<std::int32_t>(1 + below(5));
    const std::size_t blocked = below(40);
    std::vector<bool> passable(static_cast<std::size_t>(width * height));
    for (std::size_t c = 0; c < passable.size(); ++c) passable[c] = below(100) >= blocked;
    graph = Graph::grid(width, height, passable);
  } else {
    const std::size_t n = 3 + below(12);
    std::vector<Graph::Edge> edges;
    for (std::size_t v = 1; v < n; ++v) edges.emplace_back(VertexId(below(v)), VertexId(v));
    for (std::size_t u = 0; u < n; ++u)
      for (std::size_t v = u + 1; v < n; ++v)
        if (below(n) == 0 && std::find(edges.begin(), edges.end(),
                                       Graph::Edge(VertexId(u), VertexId(v))) == edges.end())
          edges.emplace_back(VertexId(u), VertexId(v));
    graph = Graph::make(n, edges).value();
  }
  if (graph->num_vertices() == 0) return std::nullopt;
  const auto distances = distances_from(*graph, VertexId(below(graph->num_vertices())));
  std::vector<VertexId> component;
  for (const VertexId v : IdRange<VertexId>(graph->num_vertices()))
    if (distances[v] != kUnreachable) component.push_back(v);
  if (component.size() < 3) return std::nullopt;
  const std::size_t num_agents = 1 + below(std::min<std::size_t>(component.size() - 1, 7));
  std::vector<Agent> tasks(num_agents);
  std::shuffle(component.begin(), component.end(), random);
  for (std::size_t i = 0; i < num_agents; ++i) tasks[i].start = component[i];
  std::shuffle(component.begin(), component.end(), random);
  for (std::size_t i = 0; i < num_agents; ++i) tasks[i].goals = component[i];
  return Instance::make(*graph, tasks).value();
}

class LazySolver : public testing::TestWithParam<Objective> {};

TEST_P(LazySolver, AgreesWithTheMddModelAndPassesItsAudit) {
  int solved = 0;
  for (unsigned seed = 0; seed < 250; ++seed) {
    SCOPED_TRACE(seed);
    const auto instance = random_instance(seed);
    if (!instance) continue;
    TunedOptions options;
    options.objective = GetParam();
    options.limits.conflicts = 300;  // ends the search where there is no plan
    options.system = System::dpll_mdd;
    options.cost_search = CostSearch::core_guided;
    const SolveOutcome expected = solve(*instance, options).value();
    if (expected.status != Status::optimal) continue;
    options.limits = {};
    options.system = System::dpll;
    options.cost_search = seed % 4 == 0 ? CostSearch::iterative : CostSearch::core_guided;
    options.debug.audit = true;
    options.debug.known_plan = expected.plan;
    options.seed = seed;
    const SolveOutcome outcome = solve(*instance, options).value();
    ASSERT_EQ(outcome.status, Status::optimal) << outcome.explanation;
    ASSERT_EQ(outcome.cost, expected.cost);
    ++solved;
  }
  EXPECT_GT(solved, 150);
}

// Without first plans, in which a seed may have its say too.
TEST(LazySolverSeeds, ReachTheProof) {
  quadrille::support::Random random(2);
  const auto rounds = static_cast<int>(quadrille::support::scaled(30));
  int hard = 0, different = 0;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    const Instance instance = support::random_grid(random, {6, 8, 15, 12, 18});
    TunedOptions options;
    options.limits.conflicts = 4000;
    options.first_plan = false;
    const SolveOutcome usual = solve(instance, options).value();
    if (usual.status != Status::optimal || usual.statistics.conflicts < 20) continue;
    ++hard;
    options.limits = {};
    options.debug.audit = true;
    options.debug.known_plan = usual.plan;
    options.seed = 1 + static_cast<std::uint32_t>(round);
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_EQ(outcome.status, Status::optimal) << outcome.explanation;
    ASSERT_EQ(outcome.cost, usual.cost);
    const SolveOutcome again = solve(instance, options).value();
    EXPECT_EQ(again.statistics.conflicts, outcome.statistics.conflicts);
    EXPECT_EQ(*again.plan, *outcome.plan);
    if (outcome.statistics.conflicts != usual.statistics.conflicts) ++different;
  }
  if (rounds < 30) return;
  EXPECT_GE(hard, 10);
  EXPECT_GE(2 * different, hard);
}

// Larger and denser, so that the first plan is mostly not the best one: the search from above has
// the first word in each hard core.
TEST(LazySolverFromAbove, AgreesWithCoresAlone) {
  quadrille::support::Random random(1);
  int solved = 0, hard = 0, different = 0;
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    const Instance instance = support::random_grid(random, {6, 8, 15, 12, 18});
    TunedOptions options;
    options.limits.conflicts = 4000;
    options.first_plan = false;
    const SolveOutcome expected = solve(instance, options).value();
    if (expected.status != Status::optimal) continue;
    options.limits = {};
    options.first_plan = true;
    options.first_turn = 1;
    options.debug.known_plan = expected.plan;
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_EQ(outcome.status, Status::optimal) << outcome.explanation;
    ASSERT_EQ(outcome.cost, expected.cost);
    ++solved;
    if (expected.statistics.conflicts >= 20) ++hard;
    options.first_turn = INT32_MAX;
    if (solve(instance, options).value().statistics.sat_calls != outcome.statistics.sat_calls)
      ++different;
  }
  EXPECT_GE(solved, 20);
  EXPECT_GE(hard, 10);
  EXPECT_GE(different, 10) << "there are turns from above";
}

INSTANTIATE_TEST_SUITE_P(Objectives, LazySolver,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& trial) {
                           return trial.param == Objective::makespan ? "Makespan" : "SumOfCosts";
                         });

}  // namespace
}  // namespace quadrille::discrete
