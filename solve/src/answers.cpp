// SPDX-License-Identifier: MIT
#include "quadrille/solve/answers.hpp"

#include "quadrille/core/grouping.hpp"

namespace quadrille::solve {
namespace {

/// The agents then as those of now, who have spent at most so much of the cost.
GroupBound later(const std::vector<AgentId>& then,
                 const IdVector<AgentId, std::optional<AgentId>>& same, Cost cost) {
  GroupBound bound{{}, cost};
  for (const AgentId i : then) bound.agents.push_back(*same[i]);
  std::sort(bound.agents.begin(), bound.agents.end());
  return bound;
}

std::vector<AgentId> all_of(const Raise& raise) {
  std::vector<AgentId> agents = raise.agents;
  agents.insert(agents.end(), raise.bystanders.begin(), raise.bystanders.end());
  std::sort(agents.begin(), agents.end());
  agents.erase(std::unique(agents.begin(), agents.end()), agents.end());
  return agents;
}

}  // namespace

Cost bound_of_all(std::vector<GroupBound> groups, const IdVector<AgentId, Cost>& free_costs,
                  Objective objective) {
  Cost bound = 0;
  if (objective == Objective::makespan) {
    for (const Cost cost : free_costs) bound = std::max(bound, cost);
    for (const GroupBound& group : groups) bound = std::max(bound, group.cost);
    return bound;
  }
  for (const Cost cost : free_costs) bound += cost;
  for (GroupBound& group : groups)
    for (const AgentId i : group.agents) group.cost -= free_costs[i];
  std::stable_sort(groups.begin(), groups.end(),
                   [](const GroupBound& a, const GroupBound& b) { return a.cost > b.cost; });
  IdVector<AgentId, bool> is_in(free_costs.size(), false);
  for (const GroupBound& group : groups) {
    const auto& agents = group.agents;
    if (group.cost <= 0) break;
    if (std::any_of(agents.begin(), agents.end(), [&](AgentId i) { return is_in[i]; })) continue;
    for (const AgentId i : agents) is_in[i] = true;
    bound += group.cost;
  }
  return bound;
}

void add_bounds(const Attribution& proved, const IdVector<AgentId, std::optional<AgentId>>& same,
                Cost elapsed, std::vector<GroupBound>& bounds) {
  const auto is_kept = [&](const std::vector<AgentId>& agents) {
    return std::all_of(agents.begin(), agents.end(), [&](AgentId i) { return same[i]; });
  };
  if (proved.objective == Objective::makespan) {
    // A raise of it is what the last one has raised further.
    std::optional<GroupBound> last;
    Cost raised = proved.free_bound;
    for (const Raise& raise : proved.raises) {
      raised += raise.amount;
      if (const auto agents = all_of(raise); is_kept(agents))
        last = later(agents, same, raised - elapsed);
    }
    if (last) bounds.push_back(*std::move(last));
    return;
  }
  Grouping groups(same.size());
  std::vector<std::pair<std::vector<AgentId>, Cost>> kept;
  for (const Raise& raise : proved.raises) {
    std::vector<AgentId> agents = all_of(raise);
    if (agents.empty() || !is_kept(agents)) continue;
    for (const AgentId i : agents) groups.join(agents.front().index(), i.index());
    kept.emplace_back(std::move(agents), raise.amount);
  }
  struct Group {
    std::set<AgentId> agents;
    Cost cost = 0;
  };
  std::map<std::size_t, Group> found;
  for (const auto& [agents, amount] : kept) {
    Group& group = found[groups.root(agents.front().index())];
    group.agents.insert(agents.begin(), agents.end());
    group.cost += amount;
  }
  for (const auto& [root, group] : found) {
    Cost cost = group.cost;
    for (const AgentId i : group.agents) cost += proved.agents[i].free_cost - elapsed;
    bounds.push_back(later({group.agents.begin(), group.agents.end()}, same, cost));
  }
}

}  // namespace quadrille::solve
