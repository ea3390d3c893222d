// SPDX-License-Identifier: MIT
#include "paths/earliest_visits.hpp"

#include <functional>
#include <queue>
#include <utility>

namespace quadrille::continuous {

std::vector<Ticks> earliest_visits(const Instance& instance, AgentId agent) {
  const Roadmap& roadmap = instance.roadmap();
  const ClassId c = instance.class_of(agent);
  std::vector<Ticks> ticks(roadmap.num_vertices(), kForever);
  using Entry = std::pair<Ticks, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto visit = [&](VertexId v, Ticks tick) {
    if (tick >= ticks[v.index()]) return;
    ticks[v.index()] = tick;
    open.emplace(tick, v.index());
  };
  visit(instance.agent(agent).start, instance.agent(agent).release);
  while (!open.empty()) {
    const auto [tick, v] = open.top();
    open.pop();
    if (tick > ticks[v]) continue;
    for (const EdgeId e : instance.out_edges(c, VertexId(v)))
      visit(roadmap.to(e), tick + instance.duration(c, e));
  }
  return ticks;
}

}  // namespace quadrille::continuous
