// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// The last different paths of each agent.
///
/// A search that backtracks often brings back obstacles that an earlier path was made for: that
/// path will do again, and a look at a few paths costs less than a search for a new one.
class PathCache {
 public:
  /// Keeps at most `capacity` paths of each agent.
  PathCache(std::size_t num_agents, std::size_t capacity)
      : capacity_(capacity), paths_(num_agents) {}

  /// Remembers a path, in the place of the oldest one if there is no more room.
  void add(AgentId agent, const Path& path);
  /// The paths that are remembered, in no particular but a deterministic order.
  [[nodiscard]] const std::vector<Path>& paths(AgentId agent) const { return paths_[agent].paths; }

 private:
  struct Ring {
    std::vector<Path> paths;
    std::size_t oldest = 0;
  };
  std::size_t capacity_;
  IdVector<AgentId, Ring> paths_;
};

}  // namespace quadrille::discrete
