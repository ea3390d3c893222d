// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "traffic/steps.hpp"

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

/// A path that knows nobody, at random; none if it does not come to the goal.
inline Path draw_path(Draw& draw, const Instance& instance, AgentId i) {
  const Agent& agent = instance.agent(i);
  Path path{{agent.start, 0, agent.release}};
  while (path.back().vertex != agent.goal() || draw.chance(20)) {
    if (path.size() > 30) break;
    const auto ways = instance.out_edges(instance.class_of(i), path.back().vertex);
    if (ways.empty()) break;
    const EdgeId e =
        ways[static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(ways.size()) - 1))];
    if (draw.chance(50)) path.back().depart += draw.ticks(0, 30);
    const Ticks arrive = path.back().depart + instance.duration(instance.class_of(i), e);
    path.push_back({instance.roadmap().edge(e).to, arrive, arrive});
  }
  path.back().depart = path.back().arrive;
  return path;
}

}  // namespace quadrille::continuous::test
