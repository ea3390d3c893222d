// SPDX-License-Identifier: MIT
#include "session/history.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace quadrille::discrete {

Later later(const Path& path, Timestep time) {
  Later later{position(path, time), arrival(path) <= time, {}};
  const auto done = std::min(static_cast<std::size_t>(time), path.size() - 1);
  later.rest.assign(path.begin() + static_cast<std::ptrdiff_t>(done), path.end());
  return later;
}

Agent rest_of(const Agent& agent, const Path& path, Timestep time) {
  Agent rest = agent;
  rest.start = position(path, time);
  std::size_t visited = 0;
  const auto& waypoints = agent.waypoints;
  const auto last = std::min(static_cast<std::size_t>(time), path.size() - 1);
  for (std::size_t t = 0; t <= last; ++t)
    while (visited < waypoints.size() && path[t] == waypoints[visited]) ++visited;
  rest.waypoints.erase(rest.waypoints.begin(),
                       rest.waypoints.begin() + static_cast<std::ptrdiff_t>(visited));
  return rest;
}

// Only what is closed for good is looked at: the rest is seen when the plan is replayed.
bool AnswerDomain::adopt(const Path& path, const Instance& instance, AgentId agent) {
  if (path.front() != instance.agents()[agent].start) return false;
  const auto& blockages = instance.rules().blockages;
  return std::none_of(blockages.begin(), blockages.end(), [&](const Blockage& blockage) {
    if (blockage.last) return false;
    if (!blockage.to) return std::find(path.begin(), path.end(), blockage.vertex) != path.end();
    for (std::size_t t = 0; t + 1 < path.size(); ++t)
      if (std::minmax(path[t], path[t + 1]) == std::minmax(blockage.vertex, *blockage.to))
        return true;
    return false;
  });
}

}  // namespace quadrille::discrete
