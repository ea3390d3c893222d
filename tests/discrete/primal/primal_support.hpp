// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "quadrille/discrete/plan_improver.hpp"
#include "quadrille/discrete/primal.hpp"
#include "support/case_text.hpp"
#include "support/generators.hpp"

namespace quadrille::discrete::primal_test {

inline constexpr std::int64_t kNoEnd = INT64_MAX;

[[nodiscard]] inline Instance instance_of(const std::string& text) {
  return support::parse_case(text, "test").value().instance;
}

[[nodiscard]] inline std::shared_ptr<const GoalDistances> distances_of(const Instance& instance) {
  LimitMonitor limits{Limits{}};
  return GoalDistances::make(instance, limits);
}

/// A search that is over, with a plan or without.
[[nodiscard]] inline PrimalSearch searched(const Instance& instance, std::uint32_t seed = 0) {
  LimitMonitor limits{Limits{}};
  PrimalSearch search(instance, distances_of(instance), seed);
  search.advance(kNoEnd, limits);
  return search;
}

[[nodiscard]] inline Cost sum_of_distances(const Instance& instance) {
  Cost sum = 0;
  for (const AgentId agent : instance.agent_ids())
    sum += distances_from(instance.graph(),
                          instance.agents()[agent].start)[instance.agents()[agent].goal()];
  return sum;
}

/// Random small instances of all kinds: grids (some of them full of agents) and other graphs, small
/// enough for the joint search, and for the search to end when there is no plan.
[[nodiscard]] inline Instance random_instance(support::Random& random) {
  switch (random.below(4)) {
    case 0:
      return support::random_graph(random, 6, 4);
    case 1:
      return support::random_grid(random, {2, 2, 25, 2, 4});
    case 2:
      return support::random_grid(random, {1, 3, 40, 2, 6});
    default:
      return support::random_grid(random, {2, 5, 40, 2, 3});
  }
}

/// An empty grid in which the agents of a square change sides.
[[nodiscard]] inline Instance crowd(std::int32_t side, std::size_t num_agents, std::uint64_t seed) {
  const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  support::Random random(seed);
  return support::random_tasks(random, Graph::grid(side, side, std::vector<bool>(cells, true)),
                               num_agents);
}

}  // namespace quadrille::discrete::primal_test
