// SPDX-License-Identifier: MIT
#include "quadrille/continuous/free_cost.hpp"

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace quadrille::continuous {

std::optional<Ticks> free_cost(const Instance& instance, AgentId agent) {
  const Roadmap& roadmap = instance.roadmap();
  const ClassId kind = instance.class_of(agent);
  const Goals& goals = instance.agent(agent).goals;
  constexpr Ticks kFar{std::numeric_limits<Ticks::Count>::max()};
  std::vector<Ticks> arrival(roadmap.num_vertices(), kFar);
  using Entry = std::pair<Ticks, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](VertexId v, Ticks then) {
    if (then >= arrival[v.index()]) return;
    arrival[v.index()] = then;
    open.emplace(then, v);
  };
  const VertexId start = instance.agent(agent).start;
  if (goals.contains(start)) return Ticks{0};
  reach(start, std::max(Ticks{0}, instance.agent(agent).release - instance.now()));
  while (!open.empty()) {
    const auto [tick, v] = open.top();
    open.pop();
    if (goals.contains(v)) return tick;
    if (tick > arrival[v.index()]) continue;
    for (const EdgeId e : instance.out_edges(kind, v))
      reach(roadmap.to(e), tick + instance.duration(kind, e));
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous
