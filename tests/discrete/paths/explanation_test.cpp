// SPDX-License-Identifier: MIT
// Path search and explanations against a breadth-first search over the time-expanded graph.
#include "paths/explanation.hpp"

#include <gtest/gtest.h>

#include <set>

#include "discrete/paths/obstacle_trial.hpp"
#include "paths/path_finder.hpp"
#include "paths/safe_interval_search.hpp"
#include "support/distances.hpp"

namespace quadrille::discrete {
namespace {

/// Of a search of either kind, with what the reasons are made from.
struct Answer {
  bool found = false;
  Path path;
  std::vector<Timestep> first_hits;
};

/// The cost, the path and the reasons. Returns how many bounds were explained.
int expect_right(const Trial& trial, const AgentDistances& distances, const ObstacleMap& map,
                 Timestep cap, const Answer& answer) {
  const auto expected = least_cost(trial, trial.active, cap);
  EXPECT_EQ(answer.found, expected.has_value());
  if (answer.found != expected.has_value()) return 0;
  if (expected) {
    EXPECT_EQ(static_cast<Timestep>(answer.path.size()) - 1 + distances.price(answer.path.back()),
              *expected);
    expect_path(trial, answer.path);
  }
  Explainer explainer(trial.graph->num_vertices());
  int explained = 0;
  for (Timestep bound = distances.free_cost(); bound < expected.value_or(cap + 1); ++bound) {
    std::vector<std::size_t> slots;
    explainer.explain(distances, map, answer.first_hits, bound, slots);
    std::vector<ObstacleId> reasons;
    for (const std::size_t slot : slots) reasons.push_back(trial.active.at(slot));
    EXPECT_FALSE(least_cost(trial, reasons, bound).has_value()) << "bound " << bound;
    EXPECT_EQ(std::set<std::size_t>(slots.begin(), slots.end()).size(), slots.size());
    ++explained;
  }
  return explained;
}

void expect_right_answers(Trial (*draw)(unsigned seed)) {
  int explained = 0;
  for (unsigned seed = 0; seed < 5000 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const Trial trial = draw(seed);
    const Instance instance = Instance::make(*trial.graph, {trial.task}).value();
    LimitMonitor limits{Limits{}};
    const auto table = trial.prices ? GoalDistances::make(instance, *trial.prices, limits)
                                    : support::distances_of(instance);
    const AgentDistances distances(instance, *table, AgentId(0),
                                   trial.prices ? &*trial.prices : nullptr);
    ObstacleMap map(trial.graph->num_vertices());
    map.load(trial.table, trial.active, distances);
    const auto cap = static_cast<Timestep>(distances.free_cost() + static_cast<int>(seed % 19));
    PathFinder finder(trial.graph->num_vertices());
    Answer answer;
    answer.found = finder.find_cheapest({AgentId(0), distances, map, cap, nullptr}, answer.path);
    answer.first_hits.assign(finder.first_hits().begin(), finder.first_hits().end());
    explained += expect_right(trial, distances, map, cap, answer);
    SafeIntervalSearch search(trial.graph->num_vertices());
    answer.first_hits.assign(map.num_slots(), PathFinder::kNoHit);
    answer.found = search.find(distances, map, cap, answer.first_hits, answer.path);
    explained += expect_right(trial, distances, map, cap, answer);
  }
  EXPECT_GT(explained, 2000);
}

TEST(Explanation, CutsOffEveryCheapPathAndPathsAreCheapest) { expect_right_answers(random_trial); }

TEST(Explanation, CountsThePricesOfGoals) { expect_right_answers(random_priced_trial); }

TEST(Explanation, LeavesOutWhatIsNotInTheWay) {
  // A line 0-1-2 with a side vertex 3 at 0: only the block in front of the goal matters.
  Trial trial;
  trial.graph =
      Graph::make(
          4, {{VertexId(0), VertexId(1)}, {VertexId(1), VertexId(2)}, {VertexId(0), VertexId(3)}})
          .value();
  trial.task = {VertexId(0), VertexId(2)};
  trial.active = {trial.table.add_point(AgentId(0), {}, {VertexId(3), 1}),
                  trial.table.add_point(AgentId(0), {}, {VertexId(1), 1}),
                  trial.table.add_point(AgentId(0), {}, {VertexId(2), 1})};
  const Instance instance = Instance::make(*trial.graph, {trial.task}).value();
  const auto table = support::distances_of(instance);
  const AgentDistances distances(instance, *table, AgentId(0));
  ObstacleMap map(4);
  PathFinder finder(4);
  Explainer explainer(4);
  map.load(trial.table, trial.active, distances);
  Path path;
  EXPECT_FALSE(finder.find_cheapest({AgentId(0), distances, map, 2, nullptr}, path));
  std::vector<std::size_t> slots;
  explainer.explain(distances, map, finder.first_hits(), 2, slots);
  EXPECT_EQ(slots, std::vector<std::size_t>{1});
}

}  // namespace
}  // namespace quadrille::discrete
