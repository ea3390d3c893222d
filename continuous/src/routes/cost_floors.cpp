// SPDX-License-Identifier: MIT
#include "routes/cost_floors.hpp"

#include <algorithm>
#include <utility>

#include "paths/earliest_visits.hpp"

namespace quadrille::continuous {
namespace {

/// When the contact between `passer`, if it is nowhere later than it has to be, and the goal of
/// `resident` is over at last; 0 if it can go around.
Ticks last_pass(Scene& scene, AgentId resident, AgentId passer, const std::vector<Ticks>& visits) {
  const Instance& instance = scene.instance();
  const Roadmap& roadmap = instance.roadmap();
  const ClassId mover = instance.class_of(passer), stander = instance.class_of(resident);
  const VertexId place = instance.agent(resident).goal();

  std::vector<std::pair<EdgeId, Ticks>> touching;  // edges, and how long they are in contact
  for (const EdgeId e : scene.contacts().near_vertex(stander, place, mover).edges)
    if (const auto window = scene.contacts().window(mover, e, stander, place))
      touching.emplace_back(e, window->end);
  if (touching.empty()) return 0;
  const auto touches = [&](EdgeId e) {
    return std::any_of(touching.begin(), touching.end(),
                       [&](const auto& t) { return t.first == e; });
  };

  std::vector<bool> is_past(roadmap.num_vertices(), false);  // from where it needs none of them
  std::vector<VertexId> stack{instance.agent(passer).goal()};
  is_past[stack.front().index()] = true;
  while (!stack.empty()) {
    const VertexId v = stack.back();
    stack.pop_back();
    for (const EdgeId e : instance.in_edges(mover, v)) {
      const VertexId from = roadmap.from(e);
      if (is_past[from.index()] || touches(e)) continue;
      is_past[from.index()] = true;
      stack.push_back(from);
    }
  }
  if (is_past[instance.agent(passer).start.index()]) return 0;
  Ticks end = kForever;
  for (const auto& [e, last] : touching)
    if (is_past[roadmap.to(e).index()]) end = std::min(end, visits[roadmap.from(e).index()] + last);
  return end == kForever ? Ticks{0} : end;
}

}  // namespace

std::vector<Cost> cost_floors(Scene& scene) {
  std::vector<Cost> floors;
  for (const AgentId i : scene.instance().agent_ids()) floors.push_back(scene.free_cost(i));
  for (const AgentId passer : scene.instance().agent_ids()) {
    const std::vector<Ticks> visits = earliest_visits(scene.instance(), passer);
    for (const AgentId resident : scene.instance().agent_ids())
      if (resident != passer && !scene.instance().agent(resident).leaves)
        floors[resident.index()] =
            std::max(floors[resident.index()], as_cost(last_pass(scene, resident, passer, visits)));
  }
  return floors;
}

}  // namespace quadrille::continuous
