// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "quadrille/core/goals.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/input/source.hpp"

namespace quadrille::input {

/// The instance in which the agents of each group may end at all goals that the group has; the same
/// one without `--share-goals`. For both domains.
template <class Instance>
Result<Instance> with_shared_goals(Instance instance, const InputOptions& options) {
  if (!options.sharing) return instance;
  auto agents = instance.agents().items();
  const std::size_t size = std::min(*options.sharing, agents.size());
  for (std::size_t first = 0; first < agents.size(); first += size) {
    const std::size_t end = std::min(first + size, agents.size());
    std::vector<VertexId> all;
    for (std::size_t i = first; i < end; ++i) {
      const auto own = agents[i].goals.vertices();
      all.insert(all.end(), own.begin(), own.end());
    }
    const Goals shared(std::move(all));
    for (std::size_t i = first; i < end; ++i) agents[i].goals = shared;
  }
  return instance.with_agents(std::move(agents));
}

}  // namespace quadrille::input
