// SPDX-License-Identifier: MIT
#include "quadrille/solve/apart.hpp"

#include <cstddef>
#include <iterator>

namespace quadrille::solve {
namespace {

void rename(std::vector<AgentId>& agents, const std::vector<AgentId>& names) {
  for (AgentId& i : agents) i = names[i.index()];
}

/// The raises of a makespan from `begin` on: those of a group whose agents take less when they are
/// alone lead up to it first.
std::vector<Raise> raises_above(Cost begin, const Attribution& attribution) {
  std::vector<Raise> above;
  Cost bound = attribution.free_bound;
  for (const Raise& raise : attribution.raises) {
    bound += raise.amount;
    if (bound <= begin) continue;
    above.push_back(raise);
    above.back().amount = std::min(raise.amount, bound - begin);
  }
  return above;
}

}  // namespace

AgentGroups with_lone_agents_together(AgentGroups groups) {
  IdVector<AgentId, std::size_t> number;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const AgentId i : groups[g]) {
      if (number.size() <= i.index()) number.resize(i.index() + 1);
      number[i] = groups[g].size() == 1 ? groups.size() : g;
    }
  return groups_by(number);
}

Attribution joined(Objective objective, const AgentGroups& groups,
                   const std::vector<Attribution>& attributions, std::span<const Cost> bounds) {
  const bool is_sum = objective == Objective::sum_of_costs;
  Attribution all;
  all.objective = objective;
  for (const Attribution& attribution : attributions)
    all.free_bound = is_sum ? all.free_bound + attribution.free_bound
                            : std::max(all.free_bound, attribution.free_bound);
  const std::size_t highest = static_cast<std::size_t>(
      std::distance(bounds.begin(), std::max_element(bounds.begin(), bounds.end())));
  std::vector<CollisionSite> sites;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Attribution& attribution = attributions[g];
    for (std::size_t k = 0; k < groups[g].size(); ++k) {
      const AgentId i = groups[g][k];
      if (all.agents.size() <= i.index()) all.agents.resize(i.index() + 1);
      all.agents[i] = attribution.agents[AgentId(k)];
    }
    std::vector<Raise> raises = attribution.raises;
    // That of a makespan is what the highest group makes it.
    if (!is_sum)
      raises = g == highest ? raises_above(all.free_bound, attribution) : std::vector<Raise>();
    for (Raise& raise : raises) {
      rename(raise.agents, groups[g]);
      rename(raise.bystanders, groups[g]);
      all.raises.push_back(std::move(raise));
    }
    for (CollisionSite site : attribution.sites) {
      site.first = groups[g][site.first.index()];
      site.second = groups[g][site.second.index()];
      sites.push_back(site);
    }
  }
  all.sites = merged(std::move(sites));
  return all;
}

}  // namespace quadrille::solve
