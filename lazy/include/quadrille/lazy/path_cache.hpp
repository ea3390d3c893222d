// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "quadrille/core/ids.hpp"

namespace quadrille::lazy {

/// The last different paths of each agent.
///
/// A search that backtracks often brings back obstacles that an earlier path was made for: that
/// path will do again, and a look at a few paths costs less than a search for a new one. Where
/// there is no room the one goes that was found longest ago.
template <class Path>
class PathCache {
 public:
  /// Keeps at most `capacity` paths of each agent, at least 1.
  PathCache(std::size_t num_agents, std::size_t capacity)
      : capacity_(capacity), agents_(num_agents) {}

  /// The path of the agent for which `is_same` is true; otherwise `make()` is remembered. Valid
  /// until the next call.
  template <class IsSame, class Make>
  const Path& remember(AgentId agent, const IsSame& is_same, const Make& make) {
    std::vector<Path>& paths = agents_[agent];
    auto at = std::find_if(paths.begin(), paths.end(), is_same);
    if (at == paths.end()) {
      if (paths.size() == capacity_) paths.pop_back();
      paths.push_back(make());
      at = paths.end() - 1;
    }
    std::rotate(paths.begin(), at, at + 1);
    return paths.front();
  }
  /// In the order of that, the last one first.
  [[nodiscard]] const std::vector<Path>& paths(AgentId agent) const { return agents_[agent]; }

 private:
  std::size_t capacity_;
  IdVector<AgentId, std::vector<Path>> agents_;
};

}  // namespace quadrille::lazy
