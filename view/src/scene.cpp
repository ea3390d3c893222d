// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>

namespace quadrille::view {

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
