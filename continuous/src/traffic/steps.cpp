// SPDX-License-Identifier: MIT
#include "traffic/steps.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

/// Whether two steps are so far apart that they cannot collide. May say no to such as well.
bool are_far(const Instance& instance, const Step& a, const Step& b, Length reach) {
  const auto ends = [&](const Step& step) {
    const Roadmap& roadmap = instance.roadmap();
    if (!step.is_move)
      return std::pair{&roadmap.position(step.vertex), &roadmap.position(step.vertex)};
    const Edge& edge = roadmap.edge(step.edge);
    return std::pair{&roadmap.position(edge.from), &roadmap.position(edge.to)};
  };
  const auto [p0, p1] = ends(a);
  const auto [q0, q1] = ends(b);
  const auto apart = [&, p0 = p0, p1 = p1, q0 = q0, q1 = q1](Length Point::*axis) {
    return std::min(p0->*axis, p1->*axis) - std::max(q0->*axis, q1->*axis) >= reach ||
           std::min(q0->*axis, q1->*axis) - std::max(p0->*axis, p1->*axis) >= reach;
  };
  return apart(&Point::x) || apart(&Point::y) || apart(&Point::z);
}

bool collide(Scene& scene, ClassId a, const Step& p, ClassId b, const Step& q) {
  if (are_far(scene.instance(), p, q, scene.instance().reach(a) + scene.instance().reach(b)))
    return false;
  if (p.is_move && q.is_move) {
    const auto& offsets = scene.contacts().offsets(a, p.edge, b, q.edge);
    return offsets && offsets->contains(q.begin - p.begin);
  }
  // Two stays that are too near: whoever came later collides on its way already, as a move.
  if (!p.is_move && !q.is_move) return false;
  const Step& move = p.is_move ? p : q;
  const Step& stay = p.is_move ? q : p;
  const auto window = p.is_move ? scene.contacts().window(a, move.edge, b, stay.vertex)
                                : scene.contacts().window(b, move.edge, a, stay.vertex);
  return window && window->meets(stay.begin - move.begin, stay.end - move.begin);
}

}  // namespace

void list_steps(const Instance& instance, AgentId agent, const TimedPath& path,
                std::vector<Step>& steps) {
  steps.clear();
  const ClassId c = instance.class_of(agent);
  VertexId at = instance.agent(agent).start;
  Ticks now = 0;
  for (const Move& move : path.moves) {
    if (move.start > now) steps.push_back({false, EdgeId(), at, now, move.start});
    now = move.start + instance.duration(c, move.edge);
    steps.push_back({true, move.edge, VertexId(), move.start, now});
    at = instance.roadmap().edge(move.edge).to;
  }
  if (!instance.agent(agent).leaves) steps.push_back({false, EdgeId(), at, now, kForever});
}

std::optional<Encounter> first_encounter(Scene& scene, AgentId i, const std::vector<Step>& steps_i,
                                         AgentId j, const std::vector<Step>& steps_j) {
  const ClassId a = scene.instance().class_of(i), b = scene.instance().class_of(j);
  // A collision lasts: interiors that meet do so for some time. So steps that overlap at one tick
  // only need no look.
  for (std::size_t k = 0, l = 0; k < steps_i.size() && l < steps_j.size();) {
    const Step &p = steps_i[k], &q = steps_j[l];
    if (std::max(p.begin, q.begin) < std::min(p.end, q.end) && collide(scene, a, p, b, q))
      return Encounter{i, j, p, q};
    if (p.end <= q.end)
      ++k;
    else
      ++l;
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous
