// SPDX-License-Identifier: MIT
#include "continuous/support/random_instance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/under_way.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::int64_t kGroups = 3;

GroupId draw_group(Draw& draw) {
  return GroupId(static_cast<std::size_t>(draw.number(0, kGroups - 1)));
}

/// Closes some edges to some groups, or to all but one.
void close_edges(Draw& draw, std::vector<Edge>& edges) {
  for (Edge& edge : edges) {
    if (!draw.chance(25)) continue;
    edge.open_to = {draw_group(draw)};
    if (draw.chance(60)) edge.open_to.insert(draw_group(draw));
  }
}

/// Heights from a few to as many as there is room.
Length draw_height(Draw& heights, const RandomOptions& options) {
  return heights.chance(40) ? 10 * heights.length(0, 2) : heights.length(0, options.size);
}

/// `draw` says what there was before there were groups, `more` those, `heights` the heights, if
/// any.
Result<Roadmap> draw_roadmap(Draw& draw, Draw& more, Draw* heights, bool has_groups,
                             const RandomOptions& options) {
  std::vector<Point> points;
  const bool is_grid = draw.chance(30);  // right angles, equal lengths
  for (std::size_t v = 0; v < options.num_vertices; ++v) {
    if (is_grid)
      points.push_back({10 * draw.length(0, 3), 10 * draw.length(0, 3)});
    else
      points.push_back({draw.length(0, options.size), draw.length(0, options.size)});
  }
  if (heights != nullptr)
    for (Point& point : points) point.z = draw_height(*heights, options);
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
  if (has_groups) close_edges(more, edges);
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
      return std::atan2(static_cast<double>(p.y.value()), static_cast<double>(p.x.value()));
    };
    std::sort(corners.begin(), corners.end(),
              [&](const Point& p, const Point& q) { return turn(p) < turn(q); });
    auto polygon = ConvexPolygon::make(std::move(corners));
    if (polygon) return std::move(polygon).value();
  }
}

/// Up to three stops, at vertices or anywhere.
MovingObstacle draw_obstacle(Draw& draw, const Roadmap& roadmap, const RandomOptions& options) {
  MovingObstacle obstacle;
  obstacle.body = draw.chance(options.polygon_percent)
                      ? draw_polygon(draw, options.max_radius)
                      : Body(Disc{draw.length(1, options.max_radius)});
  obstacle.leaves = draw.chance(60);
  Ticks now = draw.chance(50) ? Ticks{0} : draw.ticks(1, 40);
  for (std::int64_t k = draw.number(1, 3); k > 0; --k) {
    const auto vertex = static_cast<std::size_t>(
        draw.number(0, static_cast<std::int64_t>(roadmap.num_vertices()) - 1));
    MovingObstacle::Stop stop{
        draw.chance(50) ? roadmap.position(VertexId(vertex))
                        : Point{draw.length(0, options.size), draw.length(0, options.size)},
        now, now};
    if (draw.chance(50)) stop.depart += draw.ticks(1, 40);
    now = stop.depart + draw.ticks(1, 60);
    obstacle.path.push_back(stop);
  }
  if (obstacle.path.front().arrive == obstacle.path.back().depart) obstacle.leaves = false;
  return obstacle;
}

/// Spheres in place of polygons, and heights for stops in the air.
void lift(Draw& heights, const RandomOptions& options, std::vector<Agent>& agents,
          std::vector<MovingObstacle>& obstacles) {
  const auto make_sphere = [&](Body& body) {
    const Disc sphere{heights.length(1, options.max_radius)};
    if (!std::holds_alternative<Disc>(body)) body = sphere;
  };
  for (Agent& agent : agents) make_sphere(agent.body);
  for (MovingObstacle& obstacle : obstacles) {
    make_sphere(obstacle.body);
    for (MovingObstacle::Stop& stop : obstacle.path)
      if (stop.at.z == 0) stop.at.z = draw_height(heights, options);
  }
}

void add_goals(Draw& draw, std::size_t num_vertices, int percent, std::vector<Agent>& agents) {
  for (Agent& agent : agents) {
    if (!draw.chance(percent)) continue;
    std::vector<VertexId> goals{agent.goal()};
    for (std::int64_t k = draw.number(1, 2); k > 0; --k)
      goals.emplace_back(
          static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(num_vertices) - 1)));
    agent.goals = Goals(std::move(goals));
  }
}

/// Some agents begin in the middle of a move, which need not be open to them.
std::shared_ptr<const Roadmap> put_under_way(Draw& draw, const Roadmap& roadmap,
                                             std::vector<Agent>& agents) {
  RoadmapParts parts(roadmap);
  for (Agent& agent : agents) {
    if (roadmap.num_edges() == 0 || !draw.chance(60)) continue;
    const Edge edge = parts.edges[static_cast<std::size_t>(
        draw.number(0, static_cast<std::int64_t>(roadmap.num_edges()) - 1))];
    const auto whole = travel_time(roadmap, edge, agent.speed);
    if (!whole) continue;
    const Ticks left = draw.ticks(1, whole->value());
    agent.start = add_lane_place(parts, edge.from, edge.to, *whole, *whole - left);
    agent.release = 0;
    agent.under_way = left.value() % 4 != 0;  // the others may wait there
  }
  return std::make_shared<const Roadmap>(std::move(parts).make().value());
}

/// Lets some edges be slow, and, if there are groups, some take one of these another time.
std::shared_ptr<const Roadmap> give_paces(Draw& draw, const Roadmap& roadmap, bool has_groups) {
  RoadmapParts parts(roadmap);
  const auto give = [&](Edge& edge) { edge.speed_limit = kUnitSpeed * draw.number(1, 5) / 4; };
  for (std::size_t e = 0; e < roadmap.num_edges(); ++e) {
    if (!parts.edges[e].duration && draw.chance(40)) give(parts.edges[e]);
    const GroupId group = draw_group(draw);
    Groups others;
    for (std::size_t g = 0; g < kMaxGroups; ++g)
      if (parts.edges[e].open_to.contains(GroupId(g)) && GroupId(g) != group)
        others.insert(GroupId(g));
    if (!has_groups || others.is_empty() || others == parts.edges[e].open_to || !draw.chance(40))
      continue;
    Edge own = parts.edges[e];
    parts.edges[e].open_to = others;
    own.open_to = {group};
    if (own.duration || draw.chance(50)) {
      own.speed_limit = std::nullopt;
      own.duration = draw.ticks(1, 60);
    } else {
      give(own);
    }
    parts.edges.push_back(own);
  }
  return std::make_shared<const Roadmap>(std::move(parts).make().value());
}

/// Of vertices where nobody begins or stays.
std::shared_ptr<const Roadmap> forbid_waiting(Draw& draw, const Roadmap& roadmap,
                                              const std::vector<Agent>& agents) {
  RoadmapParts parts(roadmap);
  for (const VertexId v : IdRange<VertexId>(roadmap.num_vertices())) {
    const bool is_needed = std::any_of(agents.begin(), agents.end(), [&](const Agent& agent) {
      return agent.start == v || (!agent.leaves && agent.goals.contains(v));
    });
    if (!is_needed && draw.chance(60)) parts.no_waiting.push_back(v);
  }
  return std::make_shared<const Roadmap>(std::move(parts).make().value());
}

/// The corners around which a body is, of a disc those of a square.
std::vector<Point> corners_around(const Body& body) {
  const auto* disc = std::get_if<Disc>(&body);
  if (disc == nullptr) return std::get<ConvexPolygon>(body).vertices();
  const Length r = disc->radius;
  return {{-r, -r}, {r, -r}, {r, r}, {-r, r}};
}

/// The hull of both; of two discs the larger one.
Body around_both(const Body& a, const Body& b) {
  if (std::holds_alternative<Disc>(a) && std::holds_alternative<Disc>(b))
    return std::get<Disc>(a).radius < std::get<Disc>(b).radius ? b : a;
  std::vector<Point> points = corners_around(a);
  for (const Point& p : corners_around(b)) points.push_back(p);
  // Gift wrapping: from the lowest of the leftmost ones on, all others to the left.
  const auto before = [](const Point& p, const Point& q) {
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  };
  std::vector<Point> hull{*std::min_element(points.begin(), points.end(), before)};
  while (true) {
    const Point& at = hull.back();
    const Point* next = nullptr;
    for (const Point& p : points) {
      if (p == at) continue;
      if (next == nullptr) {
        next = &p;
        continue;
      }
      const std::int64_t ax = (next->x - at.x).value(), ay = (next->y - at.y).value();
      const std::int64_t bx = (p.x - at.x).value(), by = (p.y - at.y).value();
      const std::int64_t side = ax * by - ay * bx;
      if (side < 0 || (side == 0 && bx * bx + by * by > ax * ax + ay * ay)) next = &p;
    }
    if (*next == hull.front()) break;
    hull.push_back(*next);
  }
  return ConvexPolygon::make(std::move(hull)).value();
}

/// Up to three shapes of vertices, and one for each two of these on edges between them, which now
/// and then is larger than it has to be.
std::shared_ptr<const Roadmap> give_shapes(Draw& draw, const Roadmap& roadmap,
                                           const RandomOptions& options,
                                           std::vector<Agent>& agents) {
  const auto num = static_cast<std::size_t>(draw.number(1, 3));
  const auto any = [&] {
    return static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(num) - 1));
  };
  std::vector<ShapeId> shapes;
  for (std::size_t v = 0; v < roadmap.num_vertices(); ++v) shapes.emplace_back(any());
  std::vector<Edge> edges = roadmap.edges();
  const auto pair = [&](std::size_t a, std::size_t b) { return num + a * num + b; };
  for (Edge& edge : edges) {
    const ShapeId from = shapes[edge.from.index()], to = shapes[edge.to.index()];
    edge.shape = from == to && draw.chance(50) ? from : ShapeId(pair(from.index(), to.index()));
  }
  const auto body = [&](int percent) {
    return draw.chance(percent) ? draw_polygon(draw, options.max_radius)
                                : Body(Disc{draw.length(1, options.max_radius)});
  };
  for (Agent& agent : agents) {
    if (draw.chance(15)) continue;
    const int percent = draw.chance(50) ? 100 : 40;
    std::vector<Body> bodies{agent.body};
    for (std::size_t k = 1; k < num; ++k) bodies.push_back(body(percent));
    for (std::size_t a = 0; a < num; ++a)
      for (std::size_t b = 0; b < num; ++b) {
        Body both = around_both(bodies[a], bodies[b]);
        bodies.push_back(draw.chance(60) ? both : around_both(both, body(percent)));
      }
    agent.shapes.assign(bodies.begin() + 1, bodies.end());
  }
  return std::make_shared<const Roadmap>(
      Roadmap::make(roadmap.positions(), std::move(edges), {}, std::move(shapes)).value());
}

std::string describe(const Point& p) {
  return "(" + std::to_string(p.x.value()) + "," + std::to_string(p.y.value()) +
         (p.z == 0 ? "" : "," + std::to_string(p.z.value())) + ")";
}

std::string describe(const Goals& goals) {
  std::string text;
  for (const VertexId goal : goals.vertices())
    text += (text.empty() ? "" : "|") + std::to_string(goal.index());
  return text;
}

std::string describe(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body))
    return "r" + std::to_string(disc->radius.value());
  std::string text = "p";
  for (const Point& corner : std::get<ConvexPolygon>(body).vertices()) text += describe(corner);
  return text;
}

std::string describe(const std::vector<Body>& shapes) {
  std::string text;
  for (const Body& body : shapes) text += "#" + describe(body);
  return text;
}

}  // namespace

Instance random_instance(std::uint32_t seed, const RandomOptions& options) {
  Draw draw(seed), more(seed ^ 0x9e3779b9u), last(seed ^ 0x7f4a7c15u), heights(seed ^ 0x5bd1e995u);
  Draw sets(seed ^ 0x27d4eb2fu), turns(seed ^ 0x165667b1u), lanes(seed ^ 0x2545f491u);
  const bool is_in_space = heights.chance(options.space_percent);
  while (true) {
    const bool has_groups = more.chance(options.groups_percent);
    auto roadmap = draw_roadmap(draw, more, is_in_space ? &heights : nullptr, has_groups, options);
    if (!roadmap) continue;
    auto shared = std::make_shared<const Roadmap>(std::move(roadmap).value());
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
    if (has_groups)
      for (Agent& agent : agents) agent.group = draw_group(more);
    if (more.chance(options.release_percent))
      for (Agent& agent : agents)
        if (more.chance(50)) agent.release = more.ticks(1, 60);
    if (more.chance(options.deadline_percent))
      for (Agent& agent : agents)
        if (more.chance(50)) agent.deadline = agent.release + more.ticks(10, 120);
    if (more.chance(options.leaves_percent))
      for (Agent& agent : agents) agent.leaves = more.chance(60);
    std::vector<MovingObstacle> obstacles;
    if (more.chance(options.obstacles_percent))
      for (std::int64_t k = more.number(1, 2); k > 0; --k)
        obstacles.push_back(draw_obstacle(more, *shared, options));
    if (is_in_space) lift(heights, options, agents, obstacles);
    add_goals(sets, shared->num_vertices(), options.goal_sets_percent, agents);
    if (turns.chance(options.shapes_percent) && !is_in_space)
      shared = give_shapes(turns, *shared, options, agents);
    if (lanes.chance(options.paces_percent)) shared = give_paces(lanes, *shared, has_groups);
    if (lanes.chance(options.no_waiting_percent)) shared = forbid_waiting(lanes, *shared, agents);
    if (last.chance(options.under_way_percent)) shared = put_under_way(last, *shared, agents);
    auto instance =
        Instance::make(shared, std::move(agents), kDefaultResolution, {}, std::move(obstacles));
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
  for (const Point& p : instance.roadmap().positions()) text += " " + describe(p);
  text += "; edges";
  for (const Edge& e : instance.roadmap().edges()) {
    text += " " + std::to_string(e.from.index()) + ">" + std::to_string(e.to.index());
    if (e.duration) text += ":" + std::to_string(e.duration->value());
    if (e.speed_limit) text += ":v" + std::to_string(e.speed_limit->value());
    if (e.shape != ShapeId()) text += "#" + std::to_string(e.shape.index());
    if (e.open_to == Groups::all()) continue;
    text += "{";
    for (std::size_t g = 0; g < kMaxGroups; ++g)
      if (e.open_to.contains(GroupId(g))) text += " " + std::to_string(g);
    text += " }";
  }
  if (!instance.roadmap().shapes().empty()) text += "; shapes";
  for (const ShapeId shape : instance.roadmap().shapes())
    text += " " + std::to_string(shape.index());
  if (!instance.roadmap().no_waiting().empty()) text += "; no waiting at";
  for (const VertexId v : instance.roadmap().no_waiting()) text += " " + std::to_string(v.index());
  text += "; agents";
  for (const Agent& a : instance.agents())
    text += " " + std::to_string(a.start.index()) + "->" + describe(a.goals) + " " +
            describe(a.body) + describe(a.shapes) + " v" + std::to_string(a.speed.value()) +
            (a.group == GroupId() ? "" : " g" + std::to_string(a.group.index())) +
            (a.release == 0 ? "" : " from " + std::to_string(a.release.value())) +
            (a.deadline ? " by " + std::to_string(a.deadline->value()) : "") +
            (a.under_way ? " under way" : "") + (a.leaves ? " leaves" : "");
  if (!instance.obstacles().empty()) text += "; obstacles";
  for (const MovingObstacle& o : instance.obstacles()) {
    text += " " + describe(o.body);
    for (const MovingObstacle::Stop& s : o.path)
      text += " " + describe(s.at) + "@" + std::to_string(s.arrive.value()) + "-" +
              std::to_string(s.depart.value());
    if (o.leaves) text += " leaves";
  }
  return text;
}

}  // namespace quadrille::continuous::test
