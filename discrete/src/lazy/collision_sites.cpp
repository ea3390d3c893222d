// SPDX-License-Identifier: MIT
#include "lazy/collision_sites.hpp"

#include <algorithm>
#include <optional>
#include <span>

namespace quadrille::discrete {
namespace {

using Usages = std::span<const sat::Usage>;

ObstacleId obstacle_of(const sat::Usage& usage) {
  return ObstacleId(static_cast<std::size_t>(usage.resource));
}

/// What a lemma's usages extend over, in time.
struct Extent {
  Visit earliest, latest;
};

Extent extent_of(const ObstacleTable& table, Usages usages) {
  std::optional<Visit> earliest, latest;
  const auto add = [&](VertexId vertex, Timestep from, Timestep to) {
    if (!earliest || from < earliest->timestep) earliest = {vertex, from};
    if (!latest || to > latest->timestep) latest = {vertex, to};
  };
  for (const sat::Usage& usage : usages) {
    const Obstacle& o = table[obstacle_of(usage)];
    if (o.kind == Obstacle::Kind::barrier)
      for (const Visit& visit : table.visits(o)) add(visit.vertex, visit.timestep, visit.timestep);
    else
      add(o.vertex, o.first, o.kind == Obstacle::Kind::range ? o.last : o.first);
  }
  return {*earliest, *latest};
}

Place place_of(const sat::Why& why, const ObstacleTable& table, Usages usages,
               const Extent& extent) {
  if (std::holds_alternative<sat::why::Rectangle>(why))
    return {Place::Kind::rectangle, extent.earliest.vertex, extent.latest.vertex};
  const Obstacle& one = table[obstacle_of(usages.front())];
  if (one.kind == Obstacle::Kind::end) return {Place::Kind::goal, one.vertex, one.vertex};
  if (std::holds_alternative<sat::why::Edge>(why)) return {Place::Kind::edge, one.vertex, one.to};
  const VertexId other = table[obstacle_of(usages.back())].vertex;
  if (std::holds_alternative<sat::why::Corridor>(why))
    return {Place::Kind::corridor, std::min(one.vertex, other), std::max(one.vertex, other)};
  return {Place::Kind::vertex, one.vertex, one.vertex};
}

CollisionSite site_of(const sat::Why& why, const ObstacleTable& table, Usages usages) {
  AgentId a = usages.front().agent, b = usages.back().agent;
  if (const auto* rectangle = std::get_if<sat::why::Rectangle>(&why)) {
    a = rectangle->horizontal;
    b = rectangle->vertical;
  }
  CollisionSite site{std::min(a, b), std::max(a, b), {}, {}, 0, 0, 1};
  const Extent extent = extent_of(table, usages);
  site.place = place_of(why, table, usages, extent);
  site.begin = extent.earliest.timestep;
  // A move takes from one timestep to the next.
  const Timestep last =
      extent.latest.timestep + (std::holds_alternative<sat::why::Edge>(why) ? 1 : 0);
  const bool is_end = site.place.kind == Place::Kind::goal;
  site.end =
      is_end || extent.latest.timestep == kForever ? CollisionSite::kForever : Cost{last} + 1;
  return site;
}

}  // namespace

std::vector<CollisionSite> collision_sites(const LazyModel& model, const lazy::Recorder& recorder) {
  std::vector<CollisionSite> sites;
  recorder.for_each_collision([&](const sat::Why& why, Usages usages) {
    sites.push_back(site_of(why, model.obstacles(), usages));
  });
  for (const lazy::Vocabulary::GoalObstacle& goal : model.goal_obstacles()) {
    const Obstacle& o = model.obstacles()[goal.obstacle];
    sites.push_back({goal.agent,
                     goal.resident,
                     {Place::Kind::goal, o.vertex, o.vertex},
                     {},
                     o.first,
                     CollisionSite::kForever,
                     1});
  }
  return merged(std::move(sites));
}

}  // namespace quadrille::discrete
