// SPDX-License-Identifier: MIT
#include "model/obstacle_leg.hpp"

#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous {

std::optional<ObstacleLeg> leg_at(const MovingObstacle& obstacle, Ticks tick) {
  const auto& path = obstacle.path;
  if (tick < path.front().arrive) return std::nullopt;
  std::size_t k = 0;
  while (k + 1 < path.size() && path[k + 1].arrive <= tick) ++k;
  const bool is_last = k + 1 == path.size(), has_departed = tick > path[k].depart;
  if (is_last && obstacle.leaves && tick >= path[k].depart) return std::nullopt;
  return ObstacleLeg{k, !is_last && has_departed};
}

bool is_in_the_way(const MovingObstacle& obstacle, Ticks tick, const Body& body,
                   const geometry::Place& place) {
  const auto leg = leg_at(obstacle, tick);
  if (!leg) return false;
  const MovingObstacle::Stop& from = obstacle.path[leg->stop];
  if (!leg->is_moving) return geometry::bodies_overlap(body, place, obstacle.body, from.at);
  const MovingObstacle::Stop& to = obstacle.path[leg->stop + 1];
  const auto contact = geometry::BodyPair(obstacle.body, body)
                           .contact_window({from.at, to.at, to.arrive - from.depart}, place);
  // Ends are rounded outwards to whole ticks.
  return contact && contact->begin < tick - from.depart && tick - from.depart < contact->end;
}

}  // namespace quadrille::continuous
