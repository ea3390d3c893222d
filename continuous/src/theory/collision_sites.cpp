// SPDX-License-Identifier: MIT
#include "theory/collision_sites.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

/// When a move that begins during the ban is under way; of a stay, when it is.
TickInterval span_of(const Instance& instance, const Obstacle& obstacle) {
  TickInterval span = obstacle.cause.when;
  if (obstacle.cause.kind == Ban::Kind::start)
    span.end += instance.duration(instance.class_of(obstacle.agent), EdgeId(obstacle.cause.place));
  return span;
}

Place at_vertex(VertexId v) { return {Place::Kind::vertex, v, v}; }

Place on_edge(Place::Kind kind, const Edge& edge) {
  return {kind, std::min(edge.from, edge.to), std::max(edge.from, edge.to)};
}

/// Where the roads of two moves meet; the second place only if neither is the other's.
void set_crossing(const Roadmap& roadmap, const Obstacle& one, const Obstacle& other,
                  CollisionSite& site) {
  const Edge& e = roadmap.edge(EdgeId(one.cause.place));
  const Edge& f = roadmap.edge(EdgeId(other.cause.place));
  site.place = on_edge(Place::Kind::edge, e);
  const Place second = on_edge(Place::Kind::edge, f);
  if (site.place == second) return;
  if (e.to == f.to || e.to == f.from)
    site.place = at_vertex(e.to);
  else if (e.from == f.to || e.from == f.from)
    site.place = at_vertex(e.from);
  else {
    site.place.kind = Place::Kind::crossing;
    site.other = second;
  }
}

CollisionSite site_of(const Instance& instance, const Obstacle& one, const Obstacle& other) {
  CollisionSite site{one.agent, other.agent, {}, {}, 0, 0, 1};
  if (one.cause.is_end()) {
    const VertexId goal(one.cause.place);
    site.place = {Place::Kind::goal, goal, goal};
    site.end = CollisionSite::kForever;
    return site;
  }
  if (one.cause.kind == Ban::Kind::stay)
    site.place = at_vertex(VertexId(one.cause.place));
  else if (other.cause.kind == Ban::Kind::stay)
    site.place = at_vertex(VertexId(other.cause.place));
  else
    set_crossing(instance.roadmap(), one, other, site);
  const TickInterval a = span_of(instance, one), b = span_of(instance, other);
  const bool do_overlap = a.overlaps(b);
  const Ticks begin = do_overlap ? std::max(a.begin, b.begin) : std::min(a.begin, b.begin);
  const Ticks end = do_overlap ? std::min(a.end, b.end) : std::max(a.end, b.end);
  site.begin = std::max<Cost>(as_cost(begin), 0);
  site.end = end >= kForever ? CollisionSite::kForever : std::max(as_cost(end), site.begin + 1);
  return site;
}

}  // namespace

std::vector<CollisionSite> collision_sites(const Model& model, const lazy::Recorder& recorder) {
  std::vector<CollisionSite> sites;
  recorder.for_each_collision([&](const sat::Why& why, std::span<const sat::Usage> usages) {
    // What a pair does together has no place.
    if (std::holds_alternative<sat::why::Pair>(why)) return;
    const auto obstacle = [&](const sat::Usage& usage) -> const Obstacle& {
      return model.obstacles()[ObstacleId(static_cast<std::size_t>(usage.resource))];
    };
    const Obstacle &one = obstacle(usages[0]), &other = obstacle(usages[1]);
    sites.push_back(one.agent < other.agent ? site_of(model.instance(), one, other)
                                            : site_of(model.instance(), other, one));
  });
  for (const lazy::Vocabulary::GoalObstacle& goal : model.goal_obstacles()) {
    sites.push_back({goal.agent,
                     goal.resident,
                     {Place::Kind::goal, goal.goal, goal.goal},
                     {},
                     std::max<Cost>(goal.cost - 1, 0),
                     CollisionSite::kForever,
                     1});
  }
  return merged(std::move(sites));
}

}  // namespace quadrille::continuous
