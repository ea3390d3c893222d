// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "paths/steps.hpp"

namespace quadrille::continuous::test {

/// A walk that need not lead to the goal.
inline std::vector<Step> draw_steps(Draw& draw, const Instance& instance, AgentId i) {
  TimedPath path;
  VertexId at = instance.agent(i).start;
  Ticks now = 0;
  for (std::int64_t k = draw.number(0, 6); k > 0; --k) {
    const auto edges = instance.out_edges(instance.class_of(i), at);
    if (edges.empty()) break;
    const EdgeId e = edges[static_cast<std::size_t>(draw.number(0, std::ssize(edges) - 1))];
    now += draw.chance(50) ? Ticks{0} : draw.ticks(1, 40);
    path.moves.push_back({e, now});
    now += instance.duration(instance.class_of(i), e);
    at = instance.roadmap().edge(e).to;
  }
  path.arrival = now;
  std::vector<Step> steps;
  list_steps(instance, i, path, steps);
  return steps;
}

}  // namespace quadrille::continuous::test
