// SPDX-License-Identifier: MIT
// Agents on roadmaps, from arrays and back.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "poses.hpp"
#include "quadrille/continuous/duration_error.hpp"
#include "quadrille/continuous/in_words.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/quantise_polygon.hpp"
#include "quadrille/continuous/under_way.hpp"
#include "quadrille/core/decimal.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

using continuous::Instance;
using continuous::Point;
using continuous::Resolution;
using continuous::Roadmap;
using continuous::Ticks;
using continuous::Words;

/// `corners`: float64[k, 2]. `who`: for messages.
continuous::Body polygon_of(const Doubles& corners, const Resolution& resolution,
                            const std::string& who) {
  const auto xy = corners.unchecked<2>();
  std::vector<std::pair<double, double>> points;
  for (py::ssize_t k = 0; k < xy.shape(0); ++k) points.emplace_back(xy(k, 0), xy(k, 1));
  auto polygon = continuous::quantise_polygon_up(points, resolution);
  if (!polygon)
    raise({polygon.error().code,
           who + " has a polygon that is not supported at a resolution of " +
               decimal(resolution.length) + ": " + polygon.error().message,
           {}});
  return *std::move(polygon);
}

/// A radius, or the corners of a polygon.
continuous::Body body_of(const py::handle& body, const Resolution& resolution,
                         const std::string& who) {
  if (!py::isinstance<py::float_>(body)) return polygon_of(body.cast<Doubles>(), resolution, who);
  const auto radius = continuous::quantise_radius_up(body.cast<double>(), resolution);
  if (!radius)
    refuse(who + " has a radius of " + decimal(body.cast<double>()) +
           ", which is not positive, or too large");
  return continuous::Disc{*radius};
}

/// A moment, to the nearest tick; NaN is none.
std::optional<Ticks> moment_of(double value, const Resolution& resolution, const std::string& who) {
  if (std::isnan(value)) return std::nullopt;
  const auto ticks = continuous::quantise_time(value, resolution);
  if (!ticks) refuse(who + " at " + decimal(value) + ", which is negative, or too late");
  return ticks;
}

continuous::MovingObstacle obstacle_of(const py::tuple& given, const Resolution& resolution,
                                       std::size_t number) {
  const std::string who = "obstacle " + std::to_string(number);
  continuous::MovingObstacle obstacle{
      body_of(given[0], resolution, who), {}, given[2].cast<bool>()};
  const auto path = given[1].cast<Doubles>();
  const auto stops = path.unchecked<2>();
  const bool is_flat = stops.shape(1) == 4;
  const py::ssize_t times = is_flat ? 2 : 3;
  for (py::ssize_t k = 0; k < stops.shape(0); ++k) {
    const auto x = continuous::quantise_coordinate(stops(k, 0), resolution);
    const auto y = continuous::quantise_coordinate(stops(k, 1), resolution);
    const auto z = continuous::quantise_coordinate(is_flat ? 0 : stops(k, 2), resolution);
    const auto arrive = moment_of(stops(k, times), resolution, who + " arrives");
    const auto depart = moment_of(stops(k, times + 1), resolution, who + " departs");
    if (!x || !y || !z)
      refuse(who + " has a stop that is too far away for the resolution, or not finite");
    if (!arrive || !depart) refuse(who + " has a time that is not a number");
    obstacle.path.push_back({{*x, *y, *z}, *arrive, *depart});
  }
  return obstacle;
}

/// What the rules say of each agent.
void set_rules(const py::dict& rules, const Resolution& resolution, const Words& words,
               std::vector<continuous::Agent>& agents) {
  const auto groups = rules["groups"].cast<Ints>();
  const auto releases = rules["releases"].cast<Doubles>();
  const auto deadlines = rules["deadlines"].cast<Doubles>();
  const auto leaves = rules["leaves"].cast<Bools>();
  const auto overlaps = rules["overlaps"].cast<Bools>();
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    continuous::Agent& made = agents[i];
    made.group = continuous::GroupId(static_cast<std::size_t>(groups.at(row)));
    const std::string who = words.agent(AgentId(i));
    made.release = moment_of(releases.at(row), resolution, who + " is released").value_or(Ticks{0});
    made.deadline = moment_of(deadlines.at(row), resolution, who + " has its deadline");
    made.leaves = leaves.at(row);
    made.overlaps_at_start = overlaps.at(row);
    if (rules["poses"].is_none()) continue;
    const auto& poses = rules["poses"].cast<const PoseMap&>().poses;
    auto shapes = continuous::shapes_of(made.body, *poses.turns());
    if (!shapes) raise({shapes.error().code, who + " " + shapes.error().message, {}});
    made.shapes = std::move(shapes).value();
  }
}

/// How long the move takes the agent: as the roadmap says of an edge for it, or of another one, or
/// by its speed, where there is none.
Ticks move_of(const Roadmap& roadmap, VertexId from, VertexId to, const continuous::Agent& made,
              const std::string& who) {
  const Point &begin = roadmap.position(from), &end = roadmap.position(to);
  continuous::Edge edge{from, to, {}, {}};
  for (const continuous::EdgeId e : roadmap.out_edges(from)) {
    const bool is_better = edge.open_to.is_empty() || roadmap.edge(e).open_to.contains(made.group);
    if (roadmap.edge(e).to == to && is_better && !edge.open_to.contains(made.group))
      edge = roadmap.edge(e);
  }
  if (edge.duration) return *edge.duration;
  const auto duration = continuous::travel_time(roadmap, edge, made.speed);
  if (begin == end || !duration)
    refuse(who + " is in the middle of a move that takes less than half a tick, or too long");
  return *duration;
}

/// How many whole ticks of its move lie behind an agent that began it at a time.
Ticks ticks_since(double begun, Ticks now, Ticks whole, const Resolution& resolution,
                  const std::string& who) {
  const double behind = static_cast<double>(now.value()) - begun / resolution.time;
  const double nearest = std::round(behind);
  const double ticks = std::abs(behind - nearest) < 1e-6 ? nearest : std::floor(behind);
  if (!(ticks >= 0 && ticks < static_cast<double>(whole.value())))
    refuse(who + " began its move at " + decimal(begun) + ", and is not within it at " +
           decimal(continuous::in_input_units(now, resolution)) + ": it takes " +
           decimal(continuous::in_input_units(whole, resolution)));
  return Ticks(static_cast<std::int64_t>(ticks));
}

Ticks behind_of(double fraction, const std::optional<double>& begun, Ticks now, Ticks whole,
                const Resolution& resolution, const std::string& who) {
  if (!(fraction >= 0 && fraction <= 1))
    refuse(who + " has a part of its move behind it of " + decimal(fraction) +
           ", which is not from 0 to 1");
  return begun ? ticks_since(*begun, now, whole, resolution, who)
               : continuous::ticks_behind(fraction, whole);
}

/// Agents in the middle of a move get a place of their own each, at the end of the vertices.
std::shared_ptr<const Roadmap> put_under_way(const py::list& under_way,
                                             const std::shared_ptr<Roadmap>& roadmap,
                                             const Resolution& resolution, Ticks now,
                                             const Words& words,
                                             std::vector<continuous::Agent>& agents) {
  if (under_way.empty()) return roadmap;
  continuous::RoadmapParts parts(*roadmap);
  for (const py::handle entry : under_way) {
    const auto [number, source, target, fraction, begun, may_wait] = entry.cast<
        std::tuple<std::size_t, std::int64_t, std::int64_t, double, std::optional<double>, bool>>();
    const std::string who = words.agent(AgentId(number));
    const VertexId from = vertex_of(source, roadmap->num_vertices(), who + ": start");
    const VertexId to = vertex_of(target, roadmap->num_vertices(), who + ": start");
    continuous::Agent& made = agents[number];
    made.under_way = !may_wait;
    const Ticks whole = move_of(*roadmap, from, to, made, who);
    const Ticks behind = behind_of(fraction, begun, now, whole, resolution, who);
    made.start = continuous::add_lane_place(parts, from, to, whole, behind);
  }
  return std::make_shared<Roadmap>(take(std::move(parts).make()));
}

/// A radius, or float64[k, 2].
py::object body_of(const continuous::Body& body, const Resolution& resolution) {
  if (const auto* disc = std::get_if<continuous::Disc>(&body))
    return py::float_(continuous::radius_in_input_units(disc->radius, resolution));
  const auto& corners = std::get<continuous::ConvexPolygon>(body).vertices();
  auto array = new_array<double>({corners.size(), 2});
  double* to = array.mutable_data();
  for (const Point& corner : corners) {
    *to++ = continuous::corner_in_input_units(corner.x, resolution);
    *to++ = continuous::corner_in_input_units(corner.y, resolution);
  }
  return frozen(array);
}

/// float64[k, 4], with heights [k, 5].
py::array stops_of(const continuous::MovingObstacle& obstacle, bool is_flat,
                   const Resolution& resolution) {
  auto array = new_array<double>({obstacle.path.size(), is_flat ? std::size_t{4} : 5});
  double* to = array.mutable_data();
  for (const continuous::MovingObstacle::Stop& stop : obstacle.path) {
    *to++ = continuous::in_input_units(stop.at.x, resolution);
    *to++ = continuous::in_input_units(stop.at.y, resolution);
    if (!is_flat) *to++ = continuous::in_input_units(stop.at.z, resolution);
    *to++ = continuous::in_input_units(stop.arrive, resolution);
    *to++ = continuous::in_input_units(stop.depart, resolution);
  }
  return frozen(array);
}

template <class VertexOf>
py::array vertices(const TimedInstance& self, const VertexOf& vertex) {
  auto array = new_array<std::int32_t>({self.agents().size()});
  std::int32_t* to = array.mutable_data();
  for (const continuous::Agent& agent : self.agents())
    *to++ = static_cast<std::int32_t>(vertex(agent).index());
  return frozen(array);
}

}  // namespace

Words words_of(const py::dict& called, const Resolution& resolution) {
  const auto name = [&called](const char* of) {
    return [call = called[of].cast<py::function>()](std::size_t number) {
      return call(number).cast<std::string>();
    };
  };
  return {
      [agent = name("agent")](AgentId i) { return agent(i.index()); },
      [](std::size_t o) { return "obstacle " + std::to_string(o); },
      [vertex = name("vertex")](VertexId v) { return vertex(v.index()); },
      [resolution](Ticks time) { return decimal(continuous::in_input_units(time, resolution)); }};
}

std::vector<continuous::Agent> agents_of(const Roadmap& roadmap, const Sizes& sizes,
                                         const Ints& starts, const Ints& goals,
                                         const std::vector<std::size_t>& num_goals,
                                         const py::list& bodies, const Doubles& speeds,
                                         const py::dict& rules, const py::dict& called) {
  const Resolution resolution = resolution_of(sizes);
  const Words words = words_of(called, resolution);
  std::vector<continuous::Agent> agents;
  const std::int64_t* goal = goals.data();
  for (py::ssize_t i = 0; i < starts.shape(0); ++i) {
    const std::string who = words.agent(AgentId(static_cast<std::size_t>(i)));
    continuous::Agent made;
    made.start = vertex_of(starts.at(i), roadmap.num_vertices(), who + ": start");
    std::vector<VertexId> set;
    for (std::size_t k = 0; k < num_goals[static_cast<std::size_t>(i)]; ++k)
      set.push_back(vertex_of(*goal++, roadmap.num_vertices(), who + ": goal"));
    if (set.empty()) refuse(who + " has no goal");
    made.goals = Goals(std::move(set));
    made.body = body_of(bodies[static_cast<std::size_t>(i)], resolution, who);
    const auto speed = continuous::quantise_speed(speeds.at(i), resolution);
    if (!speed)
      refuse(who + " has a speed of " + decimal(speeds.at(i)) + ", which is not supported");
    made.speed = *speed;
    agents.push_back(std::move(made));
  }
  set_rules(rules, resolution, words, agents);
  return agents;
}

std::vector<continuous::MovingObstacle> obstacles_of(const py::list& given, const Sizes& sizes) {
  std::vector<continuous::MovingObstacle> obstacles;
  for (const py::handle obstacle : given)
    obstacles.push_back(
        obstacle_of(obstacle.cast<py::tuple>(), resolution_of(sizes), obstacles.size()));
  return obstacles;
}

Ticks moment_of(double value, const Sizes& sizes, const std::string& who) {
  const auto ticks = moment_of(value, resolution_of(sizes), who);
  if (!ticks) refuse(who + " at a time that is not a number");
  return *ticks;
}

Ticks ticks_behind(double fraction, const std::optional<double>& begun, Ticks now, Ticks whole,
                   const Sizes& sizes, const std::string& who) {
  return behind_of(fraction, begun, now, whole, resolution_of(sizes), who);
}

TimedInstance instance_of(const std::shared_ptr<Roadmap>& roadmap, const Sizes& sizes,
                          const Ints& starts, const Ints& goals,
                          const std::vector<std::size_t>& num_goals, const py::list& bodies,
                          const Doubles& speeds, const py::dict& rules, const py::dict& called) {
  const Resolution resolution = resolution_of(sizes);
  const Words words = words_of(called, resolution);
  auto agents = agents_of(*roadmap, sizes, starts, goals, num_goals, bodies, speeds, rules, called);
  auto obstacles = obstacles_of(rules["obstacles"].cast<py::list>(), sizes);
  const auto now = moment_of(rules["now"].cast<double>(), resolution, "now: the fleet begins");
  if (!now) refuse("now: the time at which the fleet begins is not a number");
  const auto roads =
      put_under_way(rules["under_way"].cast<py::list>(), roadmap, resolution, *now, words, agents);
  auto instance = Instance::make(roads, agents, resolution, {}, obstacles, *now);
  if (instance) return TimedInstance(instance->with_whole_moves(rules["whole_moves"].cast<bool>()));
  Error error =
      continuous::in_words(instance.error(), roads, agents, resolution, obstacles, *now, words);
  if (error.code != ErrorCode::no_plan) raise(error);
  return {std::move(error),
          TimedParts{roads, std::move(agents), resolution, std::move(obstacles), *now}};
}

py::array starts_of(const TimedInstance& self) {
  return vertices(self, [](const continuous::Agent& agent) { return agent.start; });
}

py::array goals_of(const TimedInstance& self) {
  return vertices(self, [](const continuous::Agent& agent) { return agent.goal(); });
}

py::list goal_sets_of(const TimedInstance& self) {
  py::list sets;
  for (const continuous::Agent& agent : self.agents()) {
    auto array = new_array<std::int32_t>({agent.goals.size()});
    std::int32_t* to = array.mutable_data();
    for (const VertexId goal : agent.goals.vertices())
      *to++ = static_cast<std::int32_t>(goal.index());
    sets.append(frozen(array));
  }
  return sets;
}

bool has_goal_sets(const TimedInstance& self) {
  const auto& agents = self.agents();
  return std::any_of(agents.begin(), agents.end(),
                     [](const continuous::Agent& agent) { return !agent.goals.is_single(); });
}

py::list bodies_of(const TimedInstance& self) {
  py::list bodies;
  for (const continuous::Agent& agent : self.agents())
    bodies.append(body_of(agent.body, self.resolution()));
  return bodies;
}

py::array speeds_of(const TimedInstance& self) {
  auto array = new_array<double>({self.agents().size()});
  double* to = array.mutable_data();
  for (const continuous::Agent& agent : self.agents())
    *to++ = continuous::speed_in_input_units(agent.speed, self.resolution());
  return frozen(array);
}

py::object duration_error_of(const TimedInstance& self) {
  const auto worst = continuous::largest_duration_error(self.instance());
  if (!worst) return py::none();
  const continuous::Edge& edge = self.roadmap()->edge(worst->edge);
  const Resolution& resolution = self.resolution();
  return py::make_tuple(worst->relative, worst->agent.index(), edge.from.index(), edge.to.index(),
                        continuous::in_input_units(worst->planned, resolution),
                        worst->exact * resolution.time);
}

py::dict rules_of(const TimedInstance& self) {
  const Resolution& resolution = self.resolution();
  const std::size_t n = self.agents().size();
  auto groups = new_array<std::int64_t>({n});
  auto releases = new_array<double>({n}), deadlines = new_array<double>({n});
  auto leaves = new_array<bool>({n}), under_way = new_array<bool>({n}),
       overlaps = new_array<bool>({n});
  for (std::size_t at = 0; at < n; ++at) {
    const continuous::Agent& agent = self.agents()[at];
    groups.mutable_data()[at] = static_cast<std::int64_t>(agent.group.index());
    releases.mutable_data()[at] = continuous::in_input_units(agent.release, resolution);
    deadlines.mutable_data()[at] =
        agent.deadline ? continuous::in_input_units(*agent.deadline, resolution) : std::nan("");
    leaves.mutable_data()[at] = agent.leaves;
    under_way.mutable_data()[at] = agent.under_way;
    overlaps.mutable_data()[at] = agent.overlaps_at_start;
  }
  const auto is_level = [](const continuous::MovingObstacle& obstacle) {
    return std::all_of(obstacle.path.begin(), obstacle.path.end(),
                       [](const auto& stop) { return stop.at.z == 0; });
  };
  const bool is_flat = self.roadmap()->is_flat() &&
                       std::all_of(self.obstacles().begin(), self.obstacles().end(), is_level);
  py::list obstacles;
  for (const continuous::MovingObstacle& obstacle : self.obstacles())
    obstacles.append(py::make_tuple(body_of(obstacle.body, resolution),
                                    stops_of(obstacle, is_flat, resolution), obstacle.leaves));
  py::dict rules;
  rules["groups"] = frozen(groups);
  rules["releases"] = frozen(releases);
  rules["deadlines"] = frozen(deadlines);
  rules["leaves"] = frozen(leaves);
  rules["under_way"] = frozen(under_way);
  rules["overlaps"] = frozen(overlaps);
  py::list moves;
  for (std::size_t at = 0; at < n; ++at)
    if (const auto* on = self.roadmap()->lane_place(self.agents()[at].start))
      moves.append(py::make_tuple(
          at, on->from.index(), on->to.index(),
          static_cast<double>(on->behind.value()) / static_cast<double>(on->whole.value()),
          !self.agents()[at].under_way));
  rules["moves"] = moves;
  rules["obstacles"] = obstacles;
  rules["whole_moves"] = !self.no_plan() && self.instance().has_whole_moves();
  return rules;
}

}  // namespace quadrille::python
