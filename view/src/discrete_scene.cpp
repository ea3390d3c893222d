// SPDX-License-Identifier: MIT
#include <string>

#include "quadrille/discrete/verify.hpp"
#include "scene.hpp"

namespace quadrille::view {
namespace {

using discrete::Violation;

std::string name_of(Violation::Kind kind) {
  switch (kind) {
    case Violation::Kind::path_count:
      return "number of paths";
    case Violation::Kind::bad_time:
      return "wrong beginning";
    case Violation::Kind::empty_path:
      return "empty path";
    case Violation::Kind::bad_vertex:
      return "no such vertex";
    case Violation::Kind::wrong_start:
      return "wrong start";
    case Violation::Kind::wrong_goal:
      return "wrong goal";
    case Violation::Kind::not_adjacent:
      return "jump";
    case Violation::Kind::turn:
      return "no time to turn";
    case Violation::Kind::too_early:
      return "too early";
    case Violation::Kind::too_late:
      return "too late";
    case Violation::Kind::waypoint:
      return "waypoint missed";
    case Violation::Kind::obstacle:
      return "blocked";
    case Violation::Kind::vertex:
      return "vertex conflict";
    case Violation::Kind::too_close:
      return "too close in time";
    case Violation::Kind::swap:
      return "swap conflict";
  }
  return "";
}

/// A move is best looked at half way.
bool is_move(Violation::Kind kind) {
  return kind == Violation::Kind::swap || kind == Violation::Kind::not_adjacent ||
         kind == Violation::Kind::turn;
}

/// One stop per stay, up to the first vertex that the graph does not have.
std::vector<SceneStop> stops_of(const discrete::Graph& graph, const discrete::Path& path,
                                Timestep now) {
  std::vector<SceneStop> stops;
  for (std::size_t t = 0; t < path.size(); ++t) {
    const std::size_t place = path[t].index();
    const auto time = now + static_cast<std::int64_t>(t);
    if (place >= graph.num_vertices()) break;
    if (!stops.empty() && stops.back().place == place)
      stops.back().depart = time;
    else
      stops.push_back({place, time, time});
  }
  if (!stops.empty()) stops.back().depart = stops.back().arrive;
  return stops;
}

void add_map(const discrete::Graph& graph, Scene& scene) {
  const auto& layout = graph.layout();
  if (layout) {
    Cells cells{layout->width(), layout->height(), {}, 1};
    cells.passable.resize(static_cast<std::size_t>(cells.width) *
                          static_cast<std::size_t>(cells.height));
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      const discrete::Cell cell = layout->cell_of(v);
      scene.places.push_back({static_cast<double>(cell.x), static_cast<double>(cell.y)});
      cells.passable[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(cells.width) +
                     static_cast<std::size_t>(cell.x)] = true;
    }
    scene.cells = std::move(cells);
    return;
  }
  scene.has_layout = false;
  scene.places = lay_out(graph);
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    for (const VertexId w : graph.neighbours(v))
      if (const bool is_one_way = !graph.adjacent(w, v); is_one_way || v < w)
        scene.links.push_back({v.index(), w.index(), is_one_way});
}

}  // namespace

Scene make_scene(const discrete::Instance& instance, const discrete::Plan& plan) {
  Scene scene;
  scene.now = instance.now();
  add_map(instance.graph(), scene);
  for (const AgentId i : instance.agent_ids()) {
    const discrete::Agent& task = instance.agents()[i];
    const bool has_path = i.index() < plan.paths.size() && !plan.paths[i].empty();
    const auto goal = goal_shown(task.goals, has_path ? plan.paths[i].back() : VertexId());
    SceneAgent agent{task.start.index(),
                     goal.index(),
                     0,
                     {},
                     {},
                     {},
                     task.leaves,
                     goals_not_shown(task.goals, goal)};
    const Timestep alone = distances_to_nearest(instance.graph(), task.goals)[task.start];
    if (alone != discrete::kUnreachable && instance.is_plain()) agent.free_cost = alone;
    if (i.index() < plan.paths.size())
      agent.stops = stops_of(instance.graph(), plan.paths[i], plan.now);
    if (!agent.stops.empty()) agent.cost = agent.stops.back().arrive - scene.now;
    scene.agents.push_back(std::move(agent));
  }
  const discrete::VerifyReport report = verify(instance, plan);
  scene.sum_of_costs = report.sum_of_costs;
  scene.makespan = report.makespan;
  for (const Violation& violation : report.violations)
    scene.violations.push_back(
        {name_of(violation.kind), violation.message, violation.agent.index(),
         violation.other ? std::optional(violation.other->index()) : std::nullopt,
         violation.timestep + (is_move(violation.kind) ? 0.5 : 0)});
  count_from_now(scene);
  return scene;
}

}  // namespace quadrille::view
