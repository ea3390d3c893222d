// SPDX-License-Identifier: MIT
#include "continuous/support/random_instance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace quadrille::continuous::test {
namespace {

Result<Roadmap> draw_roadmap(Draw& draw, const RandomOptions& options) {
  std::vector<Point> points;
  const bool is_grid = draw.chance(30);  // right angles, equal lengths
  for (std::size_t v = 0; v < options.num_vertices; ++v) {
    if (is_grid)
      points.push_back({10 * draw.length(0, 3), 10 * draw.length(0, 3)});
    else
      points.push_back({draw.length(0, options.size), draw.length(0, options.size)});
  }
  std::vector<Edge> edges;
  for (std::size_t u = 0; u < points.size(); ++u)
    for (std::size_t v = u + 1; v < points.size(); ++v) {
      if (!draw.chance(options.edge_percent)) continue;
      Edge edge{VertexId(u), VertexId(v), std::nullopt};
      if (draw.chance(15)) edge.duration = draw.ticks(1, 60);
      edges.push_back(edge);
      if (draw.chance(options.one_way_percent)) continue;
      std::swap(edge.from, edge.to);
      edges.push_back(edge);
    }
  return Roadmap::make(std::move(points), std::move(edges));
}

/// Three to six corners; the agent's position may be outside.
Body draw_polygon(Draw& draw, Length max_radius) {
  while (true) {
    std::vector<Point> corners;
    for (std::int64_t k = draw.number(3, 6); k > 0; --k)
      corners.push_back(
          {draw.length(-max_radius, max_radius), draw.length(-max_radius, max_radius)});
    // Around their middle, so that many are convex.
    const auto turn = [](const Point& p) {
      return std::atan2(static_cast<double>(p.y.count()), static_cast<double>(p.x.count()));
    };
    std::sort(corners.begin(), corners.end(),
              [&](const Point& p, const Point& q) { return turn(p) < turn(q); });
    auto polygon = ConvexPolygon::make(std::move(corners));
    if (polygon) return std::move(polygon).value();
  }
}

std::string describe(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body))
    return "r" + std::to_string(disc->radius.count());
  std::string text = "p";
  for (const Point& corner : std::get<ConvexPolygon>(body).vertices())
    text += "(" + std::to_string(corner.x.count()) + "," + std::to_string(corner.y.count()) + ")";
  return text;
}

}  // namespace

Instance random_instance(std::uint32_t seed, const RandomOptions& options) {
  Draw draw(seed);
  while (true) {
    auto roadmap = draw_roadmap(draw, options);
    if (!roadmap) continue;
    const auto shared = std::make_shared<const Roadmap>(std::move(roadmap).value());
    std::vector<Agent> agents;
    const bool are_equal = options.equal_agents || draw.chance(30);
    for (std::size_t i = 0; i < options.num_agents; ++i) {
      const auto vertex = [&] {
        return VertexId(static_cast<std::size_t>(
            draw.number(0, static_cast<std::int64_t>(shared->num_vertices()) - 1)));
      };
      const VertexId start = vertex(), goal = vertex();
      Body body = draw.chance(options.polygon_percent)
                      ? draw_polygon(draw, options.max_radius)
                      : Body(Disc{draw.length(1, options.max_radius)});
      const Speed speed = draw.chance(70) ? kUnitSpeed : kUnitSpeed * draw.number(1, 6) / 3;
      if (are_equal && i > 0)
        agents.push_back({start, goal, agents[0].body, agents[0].speed});
      else
        agents.push_back({start, goal, std::move(body), speed});
    }
    auto instance = Instance::make(shared, std::move(agents));
    if (instance) return std::move(instance).value();
  }
}

Instance random_pair(std::uint32_t seed) {
  RandomOptions random;
  random.num_agents = 2;
  random.num_vertices = 4 + seed % 4;
  random.edge_percent = 30 + static_cast<int>(seed / 4 % 3) * 15;
  return random_instance(seed, random);
}

std::string describe(const Instance& instance) {
  std::string text = "vertices";
  for (const Point& p : instance.roadmap().positions())
    text += " (" + std::to_string(p.x.count()) + "," + std::to_string(p.y.count()) + ")";
  text += "; edges";
  for (const Edge& e : instance.roadmap().edges()) {
    text += " " + std::to_string(e.from.index()) + ">" + std::to_string(e.to.index());
    if (e.duration) text += ":" + std::to_string(e.duration->count());
  }
  text += "; agents";
  for (const Agent& a : instance.agents())
    text += " " + std::to_string(a.start.index()) + "->" + std::to_string(a.goal.index()) + " " +
            describe(a.body) + " v" + std::to_string(a.speed.count());
  return text;
}

}  // namespace quadrille::continuous::test
