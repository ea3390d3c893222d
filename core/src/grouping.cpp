// SPDX-License-Identifier: MIT
#include "quadrille/core/grouping.hpp"

#include <map>

namespace quadrille {

AgentGroups groups_by(const IdVector<AgentId, std::size_t>& number) {
  AgentGroups groups;
  std::map<std::size_t, std::size_t> place;
  for (const AgentId i : IdRange<AgentId>(number.size())) {
    const std::size_t at = place.emplace(number[i], groups.size()).first->second;
    if (at == groups.size()) groups.emplace_back();
    groups[at].push_back(i);
  }
  return groups;
}

}  // namespace quadrille
