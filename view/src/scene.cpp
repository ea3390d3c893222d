// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>

namespace quadrille::view {

void count_from_now(Scene& scene) {
  const auto shift = [now = scene.now](auto& stops) {
    for (auto& stop : stops) {
      stop.arrive -= now;
      stop.depart -= now;
    }
  };
  for (SceneAgent& agent : scene.agents) shift(agent.stops);
  for (SceneObstacle& obstacle : scene.obstacles) shift(obstacle.stops);
  for (SceneViolation& violation : scene.violations)
    violation.time -= static_cast<double>(scene.now);
  for (Nearness& near : scene.nearest) near.time -= static_cast<double>(scene.now);
}

Position position_at(const Scene& scene, const SceneAgent& agent, double time) {
  const std::vector<SceneStop>& stops = agent.stops;
  const auto after = std::upper_bound(
      stops.begin(), stops.end(), time,
      [](double t, const SceneStop& stop) { return t < static_cast<double>(stop.arrive); });
  if (after == stops.begin()) return scene.places[stops.front().place];
  const SceneStop& last = *(after - 1);
  const Position from = scene.places[last.place];
  if (after == stops.end() || time <= static_cast<double>(last.depart)) return from;
  const Position to = scene.places[after->place];
  const double share =
      (time - static_cast<double>(last.depart)) / static_cast<double>(after->arrive - last.depart);
  return {from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share,
          from.z + (to.z - from.z) * share};
}

}  // namespace quadrille::view
