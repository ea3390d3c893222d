// SPDX-License-Identifier: MIT
#include "quadrille/sat/dependence.hpp"

#include <algorithm>

namespace quadrille::sat {

void Dependence::link(AgentId a, AgentId b) {
  if (a == b) return;
  links_[a].insert(b);
  links_[b].insert(a);
}

void Dependence::imply(const std::vector<AgentId>& agents, std::vector<AgentId> others) {
  if (others.empty()) return;
  if (agents.empty()) {
    always_.insert(always_.end(), others.begin(), others.end());
    return;
  }
  for (const AgentId i : agents) cores_of_[i].push_back(implications_.size());
  implications_.push_back({agents.size(), std::move(others)});
}

void Dependence::add_bystanders(Raise& raise) const {
  IdVector<AgentId, bool> counts(links_.size(), false);
  std::vector<AgentId> queue;
  const auto add = [&](AgentId i) {
    if (counts[i]) return;
    counts[i] = true;
    queue.push_back(i);
  };
  for (const AgentId i : raise.agents) add(i);
  for (const AgentId i : always_) add(i);
  std::vector<std::size_t> num_missing;
  for (const Implication& implication : implications_)
    num_missing.push_back(implication.num_agents);
  for (std::size_t at = 0; at < queue.size(); ++at) {
    const AgentId i = queue[at];
    for (const AgentId j : links_[i])
      if (is_unconditional_[j]) add(j);
    for (const std::size_t number : cores_of_[i])
      if (--num_missing[number] == 0)
        for (const AgentId j : implications_[number].others) add(j);
  }
  for (const AgentId i : raise.agents) counts[i] = false;
  raise.bystanders.clear();
  for (const AgentId i : IdRange<AgentId>(counts.size()))
    if (counts[i]) raise.bystanders.push_back(i);
}

}  // namespace quadrille::sat
