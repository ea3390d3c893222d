// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/verify.hpp"
#include "scene.hpp"

namespace quadrille::view {
namespace {

using continuous::Violation;

/// More links than this make a page heavy and a picture grey.
constexpr std::size_t kMostLinks = 100'000;
/// Pairs of agents whose least clearance is listed.
constexpr std::size_t kMostNearest = 200;

std::string name_of(Violation::Kind kind) {
  switch (kind) {
    case Violation::Kind::path_count:
      return "number of paths";
    case Violation::Kind::empty_path:
      return "empty path";
    case Violation::Kind::bad_vertex:
      return "no such vertex";
    case Violation::Kind::bad_time:
      return "impossible time";
    case Violation::Kind::wrong_start:
      return "wrong start";
    case Violation::Kind::wrong_goal:
      return "wrong goal";
    case Violation::Kind::not_adjacent:
      return "jump";
    case Violation::Kind::too_early:
      return "before its release";
    case Violation::Kind::too_late:
      return "after its deadline";
    case Violation::Kind::closed_edge:
      return "closed edge";
    case Violation::Kind::waits:
      return "wait in a move";
    case Violation::Kind::duration:
      return "wrong duration";
    case Violation::Kind::collision:
      return "collision";
    case Violation::Kind::obstacle:
      return "collision with an obstacle";
    case Violation::Kind::whole_moves:
      return "two moves at one time";
  }
  return "violation";
}

Position position_of(const continuous::Point& point) {
  return {static_cast<double>(point.x.value()), static_cast<double>(point.y.value()),
          static_cast<double>(point.z.value())};
}

/// The path as far as it can be laid out in space and time.
std::vector<SceneStop> stops_of(const continuous::Roadmap& roadmap, const continuous::Path& path) {
  std::vector<SceneStop> stops;
  std::int64_t now = 0;
  for (const continuous::Stop& stop : path) {
    const std::int64_t arrive = stop.arrive.value(), depart = stop.depart.value();
    if (stop.vertex.index() >= roadmap.num_vertices() || arrive < now || depart < arrive) break;
    if (!stops.empty() && arrive == now && stops.back().place != stop.vertex.index()) break;
    stops.push_back({stop.vertex.index(), arrive, depart});
    now = depart;
  }
  return stops;
}

void add_cells(const continuous::GridRoadmap& grid, Scene& scene) {
  Cells cells{grid.width(), grid.height(), {}, 1 / scene.length_unit};
  for (std::int32_t y = 0; y < grid.height(); ++y)
    for (std::int32_t x = 0; x < grid.width(); ++x)
      cells.passable.push_back(grid.vertex({x, y}).has_value());
  scene.cells = std::move(cells);
}

void add_links(const continuous::Roadmap& roadmap, Scene& scene) {
  std::map<std::pair<std::size_t, std::size_t>, int> directions;  // 1: upwards, 2: downwards
  for (const continuous::Edge& edge : roadmap.edges()) {
    const std::size_t v = edge.from.index(), w = edge.to.index();
    directions[{std::min(v, w), std::max(v, w)}] |= v < w ? 1 : 2;
  }
  for (const auto& [ends, direction] : directions) {
    if (scene.links.size() == kMostLinks) break;
    const auto [v, w] = ends;
    scene.links.push_back(direction == 2 ? Link{w, v, true} : Link{v, w, direction == 1});
  }
  scene.hidden_links = directions.size() - scene.links.size();
}

void add_report(const continuous::VerifyReport& report, Scene& scene) {
  scene.sum_of_costs = report.sum_of_costs;
  scene.makespan = report.makespan;
  for (const continuous::Clearance& c : report.clearances)
    scene.nearest.push_back({c.agent.index(), c.other.index(), c.gap, c.tick});
  for (const Violation& violation : report.violations) {
    // A collision is best looked at where the two are nearest.
    const double time = violation.nearest.value_or(static_cast<double>(violation.tick.value()));
    std::optional<std::size_t> other;
    if (violation.other) other = violation.other->index();
    scene.violations.push_back(
        {name_of(violation.kind), violation.message, violation.agent.index(), other, time});
  }
}

/// At each stop, and between it and the next one. The path need not be one of the roadmap.
template <class BodyOf>
std::vector<std::size_t> looks_of(const continuous::Roadmap& roadmap, AgentId i,
                                  const continuous::Path& path, const BodyOf& body) {
  std::vector<std::size_t> looks;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const VertexId at = path[k].vertex;
    if (at.index() >= roadmap.num_vertices()) return {};
    if (k > 0) {
      const auto out = roadmap.out_edges(path[k - 1].vertex);
      const auto lane = std::find_if(
          out.begin(), out.end(), [&](continuous::EdgeId e) { return roadmap.edge(e).to == at; });
      if (lane == out.end()) return {};
      looks.push_back(body(i, roadmap.edge(*lane).shape));
    }
    looks.push_back(body(i, roadmap.shape(at)));
  }
  return looks;
}

}  // namespace

Scene make_scene(const continuous::Instance& instance, const continuous::Plan& plan,
                 const continuous::GridRoadmap* grid) {
  Scene scene;
  scene.now = instance.now().value();
  scene.is_continuous = true;
  scene.time_unit = instance.resolution().time;
  scene.length_unit = instance.resolution().length;
  scene.y_up = grid == nullptr;
  scene.has_heights = !instance.is_flat();
  for (const continuous::Point& point : instance.roadmap().positions())
    scene.places.push_back(position_of(point));
  if (grid != nullptr)
    add_cells(*grid, scene);
  else
    add_links(instance.roadmap(), scene);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> body_of;  // by class and shape
  const auto body = [&](AgentId i, continuous::ShapeId shape) {
    const continuous::Agent& agent = instance.agent(i);
    if (agent.shapes.empty()) shape = {};
    const auto [known, is_new] = body_of.try_emplace(
        std::pair(instance.class_of(i).index(), shape.index()), scene.bodies.size());
    if (is_new) scene.bodies.push_back(agent.body_as(shape));
    return known->second;
  };
  for (const AgentId i : instance.agent_ids()) {
    const continuous::Agent& task = instance.agent(i);
    const bool has_path = i.index() < plan.paths.size() && !plan.paths[i].empty();
    const auto goal = goal_shown(task.goals, has_path ? plan.paths[i].back().vertex : VertexId());
    const continuous::Roadmap& roadmap = instance.roadmap();
    const std::size_t look = body(i, roadmap.shape(task.start));
    SceneAgent agent{task.start.index(),
                     goal.index(),
                     look,
                     {},
                     {},
                     {},
                     task.leaves,
                     goals_not_shown(task.goals, goal)};
    agent.goal_body = body(i, roadmap.shape(goal));
    if (!task.shapes.empty() && has_path) agent.looks = looks_of(roadmap, i, plan.paths[i], body);
    if (const auto alone = continuous::free_cost(instance, i)) agent.free_cost = alone->value();
    if (i.index() < plan.paths.size()) agent.stops = stops_of(instance.roadmap(), plan.paths[i]);
    if (!agent.stops.empty()) agent.cost = agent.stops.back().arrive - scene.now;
    scene.agents.push_back(std::move(agent));
  }
  for (const continuous::MovingObstacle& obstacle : instance.obstacles()) {
    SceneObstacle shown{scene.bodies.size(), {}, obstacle.leaves};
    scene.bodies.push_back(obstacle.body);
    for (const auto& stop : obstacle.path)
      shown.stops.push_back({position_of(stop.at), stop.arrive.value(), stop.depart.value()});
    scene.obstacles.push_back(std::move(shown));
  }
  add_report(verify(instance, plan, kMostNearest), scene);
  count_from_now(scene);
  return scene;
}

// A quarter turn to the right on the map is one from the axis of x to that of y, as y goes down.
void add_headings(const continuous::PoseGrid& poses, Scene& scene) {
  for (std::size_t v = 0; v < scene.places.size(); ++v)
    scene.headings.push_back(90.0 * static_cast<double>(poses.pose(VertexId(v)).heading));
}

void add_tracks(const std::vector<Track>& tracks, Scene& scene) {
  scene.violations.clear();
  scene.nearest.clear();
  scene.sum_of_costs = scene.makespan = 0;
  const std::size_t num_vertices = scene.places.size();
  const bool have_headings = std::ranges::all_of(tracks, [](const Track& track) {
    return std::ranges::all_of(track, [](const Sight& sight) { return sight.heading.has_value(); });
  });
  if (have_headings) scene.headings.assign(num_vertices, 0);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    SceneAgent& agent = scene.agents[i];
    for (const Sight& sight : tracks[i]) {
      agent.stops.push_back(
          {scene.places.size(), sight.arrive - scene.now, sight.depart - scene.now});
      scene.places.push_back({sight.x, sight.y, sight.z});
      if (have_headings) scene.headings.push_back(*sight.heading);
    }
    agent.start = agent.stops.front().place;
    agent.goal = agent.stops.back().place;
    agent.goal_body = agent.body;
    agent.cost = agent.stops.back().arrive;
    agent.free_cost.reset();
    agent.other_goals.clear();
    scene.sum_of_costs += *agent.cost;
    scene.makespan = std::max(scene.makespan, *agent.cost);
  }
  scene.num_vertices = num_vertices;
}

}  // namespace quadrille::view
