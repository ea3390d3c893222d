// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous::test {

/// The same instance in length units so small that places in the middle of moves have whole
/// coordinates: they are vertices as any other, and the rest of a move is an edge as any other. For
/// oracles, which know nothing of places that are not whole. The places of the roadmap may be so
/// many that a unit would be too small: then its `make` fails.
[[nodiscard]] inline Result<Instance> in_whole_places(const Instance& instance) {
  const Roadmap& roadmap = instance.roadmap();
  if (roadmap.lane_places().empty()) return instance;
  std::int64_t scale = 1;
  for (const LanePlace& place : roadmap.lane_places()) scale = std::lcm(scale, place.whole.value());
  const auto scaled = [&](const Point& p) { return Point{scale * p.x, scale * p.y, scale * p.z}; };
  std::vector<Point> points;
  for (const Point& p : roadmap.positions()) points.push_back(scaled(p));
  for (const LanePlace& place : roadmap.lane_places()) {
    const Point &from = points[place.from.index()], &to = points[place.to.index()];
    const auto between = [&](Length a, Length b) {
      return a + Length((b - a).value() / place.whole.value() * place.behind.value());
    };
    points[place.vertex.index()] = {between(from.x, to.x), between(from.y, to.y),
                                    between(from.z, to.z)};
  }
  std::optional<Error> error;
  const auto larger = [&](const Body& body) -> Body {
    if (const auto* const disc = std::get_if<Disc>(&body)) return Disc{scale * disc->radius};
    std::vector<Point> corners;
    for (const Point& corner : std::get<ConvexPolygon>(body).vertices())
      corners.push_back(scaled(corner));
    auto polygon = ConvexPolygon::make(std::move(corners));
    if (polygon) return std::move(polygon).value();
    error = polygon.error();
    return body;
  };
  std::vector<Edge> edges = roadmap.edges();
  for (Edge& edge : edges)
    if (edge.speed_limit) edge.speed_limit = scale * *edge.speed_limit;
  std::vector<Agent> agents(instance.agents().begin(), instance.agents().end());
  for (Agent& agent : agents) {
    agent.body = larger(agent.body);
    for (Body& body : agent.shapes) body = larger(body);
    agent.speed = scale * agent.speed;
  }
  std::vector<MovingObstacle> obstacles = instance.obstacles();
  for (MovingObstacle& obstacle : obstacles) {
    obstacle.body = larger(obstacle.body);
    for (MovingObstacle::Stop& stop : obstacle.path) stop.at = scaled(stop.at);
  }
  auto made = Roadmap::make(std::move(points), std::move(edges), {}, roadmap.shapes(),
                            roadmap.no_waiting());
  if (error || !made) return error ? *error : made.error();
  auto same = Instance::make(std::move(made).value(), std::move(agents), instance.resolution(), {},
                             std::move(obstacles), instance.now());
  if (!same) return same;
  return same->with_whole_moves(instance.has_whole_moves());
}

/// The same. Requires that nothing becomes too large.
[[nodiscard]] inline Instance with_whole_places(const Instance& instance) {
  return in_whole_places(instance).value();
}

}  // namespace quadrille::continuous::test
