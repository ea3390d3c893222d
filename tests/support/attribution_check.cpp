// SPDX-License-Identifier: MIT
#include "support/attribution_check.hpp"

#include <algorithm>
#include <cstddef>

namespace quadrille::support {
namespace {

bool is_increasing(const std::vector<AgentId>& agents, std::size_t num_agents) {
  return std::is_sorted(agents.begin(), agents.end()) &&
         std::adjacent_find(agents.begin(), agents.end()) == agents.end() &&
         (agents.empty() || agents.back().index() < num_agents);
}

bool has_all(const std::vector<AgentId>& agents, const std::vector<AgentId>& wanted) {
  return std::includes(agents.begin(), agents.end(), wanted.begin(), wanted.end());
}

std::string find_fault_of_form(const Attribution& attribution, Cost lower_bound) {
  const std::size_t num_agents = attribution.agents.size();
  const bool is_sum = attribution.objective == Objective::sum_of_costs;
  if (attribution.lower_bound != lower_bound) return "another bound than that of the outcome";
  Cost free_bound = 0, bound = attribution.free_bound;
  for (const AgentCharge& charge : attribution.agents) {
    free_bound = is_sum ? free_bound + charge.free_cost : std::max(free_bound, charge.free_cost);
    if (charge.cost && *charge.cost < charge.free_cost) return "an agent is cheaper than alone";
  }
  if (free_bound != attribution.free_bound) return "the free costs do not make the free bound";
  for (const Raise& raise : attribution.raises) {
    bound += raise.amount;
    if (raise.amount < 1) return "a raise by nothing";
    if (raise.agents.empty() || !is_increasing(raise.agents, num_agents) ||
        !is_increasing(raise.bystanders, num_agents))
      return "a raise of nobody, or out of order";
    for (const AgentId i : raise.bystanders)
      if (has_all(raise.agents, {i})) return "an agent is a bystander, too";
  }
  if (bound != lower_bound) return "the raises do not make the bound";
  for (const CollisionSite& site : attribution.sites) {
    const bool is_ordered = site.place.kind == Place::Kind::goal || site.first < site.second;
    if (!is_ordered || site.first == site.second || site.begin < 0 || site.begin >= site.end ||
        site.num_lemmas < 1 || site.other.has_value() != (site.place.kind == Place::Kind::crossing))
      return "a site that cannot be";
  }
  return "";
}

/// What the attribution says that these agents cost at least.
Cost claimed(const Attribution& attribution, const std::vector<AgentId>& agents) {
  const bool is_sum = attribution.objective == Objective::sum_of_costs;
  Cost cost = 0, steps = attribution.free_bound;
  for (const AgentId i : agents) {
    const Cost free_cost = attribution.agents[i].free_cost;
    cost = is_sum ? cost + free_cost : std::max(cost, free_cost);
  }
  for (const Raise& raise : attribution.raises) {
    steps += raise.amount;
    if (!has_all(agents, raise.agents) || !has_all(agents, raise.bystanders)) continue;
    cost = is_sum ? cost + raise.amount : steps;
  }
  return cost;
}

}  // namespace

std::string find_fault(const Attribution& attribution, Cost lower_bound, const LeastCost& least) {
  if (std::string fault = find_fault_of_form(attribution, lower_bound); !fault.empty())
    return fault;
  const std::size_t num_agents = attribution.agents.size();
  for (std::size_t set = 1; set < std::size_t{1} << num_agents; ++set) {
    std::vector<AgentId> agents;
    for (const AgentId i : IdRange<AgentId>(num_agents))
      if ((set >> i.index() & 1U) != 0) agents.push_back(i);
    const Cost claim = claimed(attribution, agents);
    const auto cost = least(agents);
    if (!cost || *cost >= claim) continue;
    std::string text = "agents";
    for (const AgentId i : agents) text += " " + std::to_string(i.index());
    return text + " cost " + std::to_string(*cost) + ", less than the " + std::to_string(claim) +
           " that is claimed";
  }
  return "";
}

int num_partial_raises(const Attribution& attribution) {
  return static_cast<int>(
      std::count_if(attribution.raises.begin(), attribution.raises.end(), [&](const Raise& raise) {
        return raise.agents.size() + raise.bystanders.size() < attribution.agents.size();
      }));
}

}  // namespace quadrille::support
