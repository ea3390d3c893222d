// SPDX-License-Identifier: MIT
#include "neighbourhoods/plan_merger.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// What a part costs more in the one plan than in the other. For the makespan, which is that of the
/// dearest part, the largest costs are compared first.
struct Difference {
  Cost largest = 0, other_largest = 0;
  Cost sum = 0;

  void add(Cost cost, Cost other_cost) {
    largest = std::max(largest, cost);
    other_largest = std::max(other_largest, other_cost);
    sum += cost - other_cost;
  }
  [[nodiscard]] bool other_is_better(Objective objective) const {
    if (objective == Objective::sum_of_costs) return sum > 0;
    return std::make_pair(other_largest, Cost{0}) < std::make_pair(largest, sum);
  }
};

}  // namespace

AgentId PlanMerger::root(AgentId agent) {
  while (parent_[agent] != agent) agent = parent_[agent] = parent_[parent_[agent]];
  return agent;
}

/// Two paths collide if a stay of one overlaps a stay of the other in the same vertex, or if they
/// swap vertices.
void PlanMerger::join_with_met(AgentId agent, const Path& path) {
  const auto join = [&](AgentId met) {
    const AgentId a = root(agent), b = root(met);
    parent_[std::max(a, b)] = std::min(a, b);
  };
  for_each_stay(agent, path, [&](VertexId v, const Stay& stay) {
    const std::span<const Stay> here = reservations_.stays(v);
    for (std::size_t k = reservations_.first_ending_from(v, stay.begin);
         k < here.size() && here[k].begin <= stay.end; ++k)
      join(here[k].agent);
    if (stay.end == kForever) return;
    const Stay* ahead = reservations_.stay_at(stay.next, stay.end);
    if (ahead != nullptr && ahead->end == stay.end && ahead->next == v) join(ahead->agent);
  });
}

Plan PlanMerger::merge(Plan plan, const Plan& other, Objective objective) {
  QUADRILLE_REQUIRE(
      plan.paths.size() == instance_.num_agents() && other.paths.size() == instance_.num_agents(),
      "one path per agent");
  std::vector<AgentId> differing;
  for (const AgentId i : instance_.agent_ids())
    if (plan.paths[i] != other.paths[i]) differing.push_back(i);
  for (const AgentId i : differing) {
    parent_[i] = i;
    reservations_.add(i, plan.paths[i]);
  }
  for (const AgentId i : differing) join_with_met(i, other.paths[i]);
  for (const AgentId i : differing) reservations_.remove(plan.paths[i]);
  IdVector<AgentId, Difference> parts(instance_.num_agents());
  for (const AgentId i : differing)
    parts[root(i)].add(arrival(plan.paths[i]), arrival(other.paths[i]));
  for (const AgentId i : differing)
    if (parts[root(i)].other_is_better(objective)) plan.paths[i] = other.paths[i];
  return plan;
}

}  // namespace quadrille::discrete
