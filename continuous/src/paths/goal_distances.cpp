// SPDX-License-Identifier: MIT
#include "paths/goal_distances.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

namespace quadrille::continuous {

GoalDistances::GoalDistances(const Instance& instance, AgentId agent)
    : ticks_(instance.roadmap().num_vertices(), kForever) {
  const ClassId c = instance.class_of(agent);
  using Entry = std::pair<Ticks, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const VertexId goal : instance.agent(agent).goals.vertices()) {
    ticks_[goal.index()] = 0;
    queue.emplace(Ticks{0}, goal);
  }
  while (!queue.empty()) {
    const auto [ticks, v] = queue.top();
    queue.pop();
    if (ticks > ticks_[v.index()]) continue;
    for (const EdgeId e : instance.in_edges(c, v)) {
      const VertexId u = instance.roadmap().from(e);
      const Ticks via = ticks + instance.duration(c, e);
      if (via >= ticks_[u.index()]) continue;
      ticks_[u.index()] = via;
      queue.emplace(via, u);
    }
  }
}

Detours::Detours(const Instance& instance, AgentId agent, const GoalDistances& distances)
    : instance_(instance), agent_(agent), distances_(distances) {}

std::span<const Detours::Detour> Detours::from(VertexId v) {
  const Roadmap& roadmap = instance_.roadmap();
  if (ranges_.empty()) ranges_.resize(roadmap.num_vertices());
  Range& range = ranges_[v.index()];
  if (range.begin == kUnknown) {
    const ClassId c = instance_.class_of(agent_);
    range.begin = static_cast<std::uint32_t>(detours_.size());
    for (const EdgeId e : instance_.out_edges(c, v)) {
      const VertexId w = roadmap.to(e);
      const Ticks duration = instance_.duration(c, e);
      if (distances_[w] >= kForever) continue;
      detours_.push_back({e, w, duration, duration + distances_[w] - distances_[v]});
    }
    range.end = static_cast<std::uint32_t>(detours_.size());
    std::sort(detours_.begin() + static_cast<std::ptrdiff_t>(range.begin), detours_.end(),
              [](const Detour& a, const Detour& b) {
                return std::tie(a.extra, a.edge) < std::tie(b.extra, b.edge);
              });
  }
  return {detours_.data() + range.begin, detours_.data() + range.end};
}

}  // namespace quadrille::continuous
