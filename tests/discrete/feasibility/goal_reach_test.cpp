// SPDX-License-Identifier: MIT
// Prices of goals against all choices of goals on small graphs.
#include "feasibility/goal_reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "support/generators.hpp"

namespace quadrille::discrete::support {
namespace {

/// The distances from a vertex, by the definition.
std::vector<Cost> ways_from(const Graph& graph, VertexId start) {
  std::vector<Cost> distance(graph.num_vertices(), -1);
  std::vector<VertexId> queue{start};
  distance[start.index()] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (const VertexId w : graph.neighbours(queue[head]))
      if (distance[w.index()] < 0) {
        distance[w.index()] = distance[queue[head].index()] + 1;
        queue.push_back(w);
      }
  return distance;
}

/// All choices of different goals that can be reached.
class Choices {
 public:
  explicit Choices(const Instance& instance) : instance_(instance) {
    for (const Agent& task : instance.agents())
      distances_.push_back(ways_from(instance.graph(), task.start));
    choose(0, 0);
  }
  [[nodiscard]] std::optional<Cost> least() const { return least_; }
  /// Whether some choice leaves the vertex over.
  [[nodiscard]] bool may_be_left_over(VertexId v) const {
    return std::any_of(choices_.begin(), choices_.end(), [&](const std::vector<VertexId>& choice) {
      return std::find(choice.begin(), choice.end(), v) == choice.end();
    });
  }

 private:
  void choose(std::size_t agent, Cost cost) {
    if (agent == instance_.num_agents()) {
      least_ = std::min(least_.value_or(cost), cost);
      choices_.push_back(chosen_);
      return;
    }
    for (const VertexId goal : instance_.agents()[AgentId(agent)].goals.vertices()) {
      const Cost there = distances_[agent][goal.index()];
      if (there < 0 || std::find(chosen_.begin(), chosen_.end(), goal) != chosen_.end()) continue;
      chosen_.push_back(goal);
      choose(agent + 1, cost + there);
      chosen_.pop_back();
    }
  }

  const Instance& instance_;
  std::vector<std::vector<Cost>> distances_;
  std::vector<VertexId> chosen_;
  std::vector<std::vector<VertexId>> choices_;
  std::optional<Cost> least_;
};

// With prices too low, or too high, the least costs would not come to that: every plan's cost would
// still be told right, and the bound would be a worse one.
TEST(GoalPrices, RaiseTheLeastCostsToACheapestChoice) {
  int num_priced = 0, num_left_over = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    const Instance instance = with_more_goals(random, random_graph(random, 8, 5));
    if (!instance.has_goal_sets()) continue;
    const Choices choices(instance);
    LimitMonitor limits{Limits{}};
    const auto priced = price_goals(instance, limits);
    if (!choices.least()) {
      ASSERT_FALSE(priced) << seed;
      continue;
    }
    Cost bound = 0;
    const auto nearest = GoalDistances::make(instance, limits);
    const GoalDistances& distances = priced ? *priced->distances : *nearest;
    for (const AgentId i : instance.agent_ids()) bound += distances(i, instance.agents()[i].start);
    if (priced) {
      ++num_priced;
      Cost all = 0;
      for (const Timestep price : *priced->prices) {
        ASSERT_GE(price, 0) << seed;
        all += price;
      }
      ASSERT_EQ(all, priced->paid) << seed;
      num_left_over += priced->left_over.empty() ? 0 : 1;
      for (const VertexId v : IdRange<VertexId>(instance.graph().num_vertices()))
        if ((*priced->prices)[v] > 0 && choices.may_be_left_over(v)) {
          ASSERT_EQ(std::count(priced->left_over.begin(), priced->left_over.end(), v), 1) << seed;
        }
      bound -= priced->paid;
    }
    ASSERT_EQ(bound, *choices.least()) << seed;
  }
  EXPECT_GT(num_priced, 500);
  EXPECT_GT(num_left_over, 200);
}

}  // namespace
}  // namespace quadrille::discrete::support
