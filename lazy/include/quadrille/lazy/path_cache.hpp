// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "quadrille/core/ids.hpp"

namespace quadrille::lazy {

/// Which of the paths of an agent makes room for a new one.
enum class Forgets {
  oldest,  ///< The one that came first. Paths stay where they are.
  unused   ///< The one that was found longest ago. The others are in the order of that, last first.
};

/// The last different paths of each agent.
///
/// A search that backtracks often brings back obstacles that an earlier path was made for: that
/// path will do again, and a look at a few paths costs less than a search for a new one.
template <class Path, Forgets kForgets>
class PathCache {
 public:
  /// Keeps at most `capacity` paths of each agent, at least 1.
  PathCache(std::size_t num_agents, std::size_t capacity)
      : capacity_(capacity), agents_(num_agents) {}

  /// The path of the agent for which `is_same` is true; otherwise `make()` is remembered. Valid
  /// until the next call.
  template <class IsSame, class Make>
  const Path& remember(AgentId agent, const IsSame& is_same, const Make& make) {
    auto& [paths, oldest] = agents_[agent];
    auto at = std::find_if(paths.begin(), paths.end(), is_same);
    const bool is_known = at != paths.end();
    if constexpr (kForgets == Forgets::oldest) {
      if (is_known) return *at;
      if (paths.size() < capacity_) return paths.emplace_back(make());
      Path& place = paths[oldest];
      oldest = (oldest + 1) % capacity_;
      return place = make();
    } else {
      if (!is_known) {
        if (paths.size() == capacity_) paths.pop_back();
        paths.push_back(make());
        at = paths.end() - 1;
      }
      std::rotate(paths.begin(), at, at + 1);
      return paths.front();
    }
  }
  [[nodiscard]] const std::vector<Path>& paths(AgentId agent) const { return agents_[agent].paths; }

 private:
  struct Ring {
    std::vector<Path> paths;
    std::size_t oldest = 0;
  };
  std::size_t capacity_;
  IdVector<AgentId, Ring> agents_;
};

}  // namespace quadrille::lazy
