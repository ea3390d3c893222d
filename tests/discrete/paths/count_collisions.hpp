// SPDX-License-Identifier: MIT
#pragma once

#include "paths/path_index.hpp"

namespace quadrille::discrete::test {

/// How many collisions a path of the agent has with those of the others in the index. It begins at
/// the agent's start and ends with its arrival at a goal.
inline int count_collisions(const PathIndex& index, AgentId agent, const Path& path) {
  int count = 0;
  for (std::size_t t = 1; t < path.size(); ++t)
    count += index.collisions_of_step(agent, path[t - 1], path[t], static_cast<Timestep>(t));
  return count +
         index.collisions_of_rest(agent, path.back(), static_cast<Timestep>(path.size()) - 1);
}

}  // namespace quadrille::discrete::test
