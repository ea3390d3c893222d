// SPDX-License-Identifier: MIT
#include "quadrille/fleet/fleet.hpp"

#include <algorithm>
#include <set>

#include "conversions.hpp"
#include "place_rounding.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/quantise_polygon.hpp"
#include "quadrille/geometry/body_index.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::fleet {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

Result<continuous::Body> to_units(const Disc& disc, const continuous::Resolution& resolution) {
  const auto radius = continuous::quantise_radius_up(disc.radius.value(), resolution);
  if (!radius)
    return out_of_range("has a radius of " + to_string(disc.radius) +
                        ", which is not positive, or too large");
  return continuous::Body(continuous::Disc{*radius});
}

Result<continuous::Body> to_units(const Polygon& polygon,
                                  const continuous::Resolution& resolution) {
  std::vector<std::pair<double, double>> corners;
  for (const Point& corner : polygon.corners) {
    if (!to_units(corner, resolution))
      return out_of_range("has a polygon with a corner that is too far away");
    if (corner.z != Metres(0)) return invalid("has a polygon with a corner that has a height");
    corners.emplace_back(corner.x.value(), corner.y.value());
  }
  auto made = continuous::quantise_polygon_up(corners, resolution);
  if (!made)
    return Error{made.error().code,
                 "has a polygon that is not supported at a resolution of " +
                     to_string(Metres(resolution.length)) + ": " + made.error().message,
                 {}};
  return continuous::Body(std::move(made).value());
}

}  // namespace

Robot Robot::to(VertexId goal) const {
  QUADRILLE_REQUIRE(goal.index() < fleet_->roadmap_.num_vertices(), "a vertex of the roadmap");
  fleet_->robots_[id_].goal = goal;
  return *this;
}

Robot Robot::release(Seconds time) const {
  fleet_->robots_[id_].release = time;
  return *this;
}

Robot Robot::deadline(std::optional<Seconds> time) const {
  fleet_->robots_[id_].deadline = time;
  return *this;
}

Robot Robot::leaves(bool does) const {
  fleet_->robots_[id_].leaves = does;
  return *this;
}

Robot Fleet::robot(RobotSpec spec) {
  Entry entry;
  entry.spec = std::move(spec);
  robots_.push_back(std::move(entry));
  return {*this, AgentId(robots_.size() - 1)};
}

Robot Fleet::operator[](AgentId id) {
  QUADRILLE_REQUIRE(id.index() < robots_.size(), "a robot of this fleet");
  return {*this, id};
}

void Fleet::set_roadmap(Roadmap roadmap) {
  QUADRILLE_REQUIRE(roadmap.num_vertices() == roadmap_.num_vertices(), "the same vertices");
  roadmap_ = std::move(roadmap);
}

std::string Fleet::name(AgentId id) const {
  const std::string& name = robots_[id].spec.name;
  return name.empty() ? "robot " + std::to_string(id.index()) : name;
}

std::optional<AgentId> Fleet::find(std::string_view name) const {
  for (const AgentId id : robot_ids())
    if (this->name(id) == name) return id;
  return std::nullopt;
}

std::string Fleet::obstacle_name(std::size_t index) const {
  QUADRILLE_REQUIRE(index < obstacles_.size(), "an obstacle of this fleet");
  const std::string& name = obstacles_[index].name;
  return name.empty() ? "obstacle " + std::to_string(index) : name;
}

Result<continuous::Agent> Fleet::agent(AgentId id) const {
  const continuous::Resolution resolution = roadmap_.unit_sizes();
  const Entry& entry = robots_[id];
  const std::string name = "'" + this->name(id) + "' ";
  if (!entry.goal || (!entry.start && !entry.under_way))
    return invalid(name + "has no " + (entry.goal ? "start" : "goal"));
  const auto body =
      std::visit([&](const auto& shape) { return to_units(shape, resolution); }, entry.spec.body);
  if (!body) return Error{body.error().code, name + body.error().message, {}};
  const auto speed = continuous::quantise_speed(entry.spec.speed.value(), resolution);
  if (!speed)
    return out_of_range(name + "has a speed of " + to_string(entry.spec.speed) +
                        ", which is not supported");
  continuous::Agent agent{entry.start.value_or(VertexId(0)), *entry.goal, *body, *speed};
  agent.under_way = entry.under_way.has_value();  // and its start is to come
  if (entry.spec.group) {
    if (entry.spec.group->index() < 1 || entry.spec.group->index() > roadmap_.num_groups())
      return invalid(name + "is of a group that the roadmap does not have");
    agent.group = *entry.spec.group;
  }
  if (entry.under_way && entry.release > Seconds(0))
    return invalid(name + "is under way, and cannot be released later");
  const auto release = time_to_units(entry.release, true, resolution);
  if (!release)
    return out_of_range(name + "is released at " + to_string(entry.release) +
                        ", which is negative, or too late");
  agent.release = *release;
  if (entry.deadline) {
    agent.deadline = time_to_units(*entry.deadline, false, resolution);
    if (!agent.deadline)
      return out_of_range(name + "has its deadline at " + to_string(*entry.deadline) +
                          ", which is negative, or too late");
  }
  agent.leaves = entry.leaves;
  return agent;
}

Result<std::vector<continuous::Agent>> Fleet::agents() const {
  std::vector<continuous::Agent> agents;
  std::set<std::string> names;
  for (const AgentId id : robot_ids()) {
    const std::string name = "'" + this->name(id) + "'";
    if (!names.insert(name).second) return invalid("two robots are called " + name);
    auto agent = this->agent(id);
    if (!agent) return agent.error();
    agents.push_back(std::move(agent).value());
  }
  return agents;
}

std::string Fleet::place_name(VertexId v) const {
  if (v.index() < roadmap_.num_vertices()) return roadmap_.name(v);
  std::size_t left = v.index() - roadmap_.num_vertices();
  for (const Entry& entry : robots_)
    if (entry.under_way && left-- == 0)
      return "the lane from " + roadmap_.name(entry.under_way->from) + " to " +
             roadmap_.name(entry.under_way->to);
  QUADRILLE_REQUIRE(false, "a vertex of the instance");
  return {};
}

Result<std::vector<continuous::MovingObstacle>> Fleet::obstacles_in_units() const {
  const continuous::Resolution resolution = roadmap_.unit_sizes();
  std::vector<continuous::MovingObstacle> obstacles;
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    const MovingObstacle& obstacle = obstacles_[o];
    const std::string name = "'" + obstacle_name(o) + "' ";
    const auto body =
        std::visit([&](const auto& shape) { return to_units(shape, resolution); }, obstacle.body);
    if (!body) return Error{body.error().code, name + body.error().message, {}};
    if (obstacle.path.empty()) return invalid(name + "has no stops");
    continuous::MovingObstacle made{*body, {}, obstacle.leaves};
    for (const MovingObstacle::Stop& stop : obstacle.path) {
      const auto place = to_units(stop.place, resolution);
      const auto arrive = continuous::quantise_time(stop.arrive.value(), resolution);
      const auto depart = continuous::quantise_time(stop.depart.value(), resolution);
      if (!place || !arrive || !depart)
        return out_of_range(name +
                            "has a stop that is too far away, negative in time, or too late");
      if (*depart < *arrive || (!made.path.empty() && *arrive <= made.path.back().depart))
        return invalid(name + "has times that do not increase at a resolution of " +
                       to_string(roadmap_.resolution().time));
      made.path.push_back({*place, *arrive, *depart});
    }
    if (made.leaves && made.path.front().arrive == made.path.back().depart)
      return invalid(name + "vanishes at the moment at which it appears");
    obstacles.push_back(std::move(made));
  }
  return obstacles;
}

// Agents and edges are numbers in the errors of the layer below. What can still be wrong there is
// found again here, in the words of the fleet.
Error Fleet::in_words(const Error& error, const Roads& roads,
                      const std::vector<continuous::Agent>& agents,
                      const std::vector<continuous::MovingObstacle>& obstacles) const {
  if (auto found = find_polygon_in_space(*roads, agents, obstacles)) return *found;
  if (auto found = find_unsupported(*roads, agents)) return *found;
  if (auto found = find_overlap(*roads, agents, &continuous::Agent::start, "starts")) return *found;
  if (auto found = find_overlap(*roads, agents, &continuous::Agent::goal, "goals")) return *found;
  if (auto found = find_blocked_start(*roads, agents, obstacles)) return *found;
  for (std::size_t i = 0; i < agents.size(); ++i)
    if (auto found = find_alone(roads, agents[i], AgentId(i))) return *found;
  return error;
}

std::optional<Error> Fleet::find_polygon_in_space(
    const continuous::Roadmap& roads, const std::vector<continuous::Agent>& agents,
    const std::vector<continuous::MovingObstacle>& obstacles) const {
  const auto is_high = [](const auto& stop) { return stop.at.z != 0; };
  const auto flies = [&](const continuous::MovingObstacle& obstacle) {
    return std::any_of(obstacle.path.begin(), obstacle.path.end(), is_high);
  };
  if (roads.is_flat() && std::none_of(obstacles.begin(), obstacles.end(), flies))
    return std::nullopt;
  const auto refusal = [](const std::string& name) {
    return invalid("'" + name + "' is a polygon, but there are places with a height: in space " +
                   "bodies are spheres");
  };
  for (std::size_t i = 0; i < agents.size(); ++i)
    if (!std::holds_alternative<continuous::Disc>(agents[i].body)) return refusal(name(AgentId(i)));
  for (std::size_t o = 0; o < obstacles.size(); ++o)
    if (!std::holds_alternative<continuous::Disc>(obstacles[o].body))
      return refusal(obstacle_name(o));
  return std::nullopt;
}

// What stands in the way of a robot that is alone.
std::optional<Error> Fleet::find_alone(const Roads& roads, const continuous::Agent& agent,
                                       AgentId id) const {
  const auto make = [&](const continuous::Agent& one) {
    return continuous::Instance::make(roads, {one}, roadmap_.unit_sizes());
  };
  const auto alone = make(agent);
  if (alone) return std::nullopt;
  continuous::Agent patient = agent;
  patient.deadline.reset();
  const auto late = make(patient);
  const std::string name = "'" + this->name(id) + "' cannot ";
  if (!late)
    return Error{late.error().code,
                 name + "get from " + place_name(agent.start) + " to " + roadmap_.name(agent.goal),
                 {}};
  const continuous::Ticks arrival = continuous::free_cost(*late, AgentId(0)).value();
  return Error{alone.error().code,
               name + "arrive before " + to_string(in_seconds(arrival, roadmap_.unit_sizes())) +
                   ", and its deadline is " +
                   to_string(in_seconds(*agent.deadline, roadmap_.unit_sizes())),
               {}};
}

std::optional<Error> Fleet::find_blocked_start(
    const continuous::Roadmap& roads, const std::vector<continuous::Agent>& agents,
    const std::vector<continuous::MovingObstacle>& obstacles) const {
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const continuous::MovingObstacle& obstacle = obstacles[o];
    const std::string name = "'" + obstacle_name(o) + "'";
    if (geometry::enclosing_radius(obstacle.body) > geometry::kMaxLength)
      return out_of_range(name + " is too large");
    if (obstacle.path.front().arrive > 0) continue;
    for (std::size_t i = 0; i < agents.size(); ++i)
      if (geometry::bodies_overlap(agents[i].body, roads.position(agents[i].start), obstacle.body,
                                   obstacle.path.front().at))
        return Error{ErrorCode::no_plan,
                     name + " is at the start of '" + this->name(AgentId(i)) + "' at " +
                         place_name(agents[i].start),
                     {}};
  }
  return std::nullopt;
}

std::optional<Error> Fleet::find_unsupported(const continuous::Roadmap& roads,
                                             const std::vector<continuous::Agent>& agents) const {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::string name = "'" + this->name(AgentId(i)) + "'";
    if (geometry::enclosing_radius(agents[i].body) > geometry::kMaxLength)
      return out_of_range(name + " is too large");
    for (const continuous::Edge& lane : roads.edges())
      if (!lane.duration && !continuous::travel_time(roads.position(lane.from),
                                                     roads.position(lane.to), agents[i].speed))
        return out_of_range("the lane from " + roadmap_.name(lane.from) + " to " +
                            roadmap_.name(lane.to) + " takes " + name +
                            " less than half a step of " + to_string(roadmap_.resolution().time) +
                            ", or too long");
  }
  return std::nullopt;
}

std::optional<Error> Fleet::find_overlap(const continuous::Roadmap& roads,
                                         const std::vector<continuous::Agent>& agents,
                                         VertexId continuous::Agent::*end,
                                         const std::string& what) const {
  geometry::BodyIndex placed;
  for (std::size_t j = 0; j < agents.size(); ++j) {
    if (end == &continuous::Agent::goal && agents[j].leaves) continue;
    const VertexId w = agents[j].*end;
    if (const auto i = placed.first_overlap(agents[j].body, roads.position(w)))
      return Error{ErrorCode::no_plan,
                   "the " + what + " of '" + name(AgentId(*i)) + "' at " +
                       place_name(agents[*i].*end) + " and '" + name(AgentId(j)) + "' at " +
                       place_name(w) + " overlap",
                   {}};
    placed.add(j, agents[j].body, roads.position(w));
  }
  return std::nullopt;
}

Result<Fleet::Parts> Fleet::parts() const {
  Parts parts;
  auto agents = this->agents();
  if (!agents) return agents.error();
  auto roads = put_under_way(*agents, parts.off);
  if (!roads) return roads.error();
  auto obstacles = obstacles_in_units();
  if (!obstacles) return obstacles.error();
  parts.agents = std::move(agents).value();
  parts.roads = std::move(roads).value();
  parts.obstacles = std::move(obstacles).value();
  return parts;
}

Result<continuous::Instance> Fleet::instance() const {
  const auto parts = this->parts();
  if (!parts) return parts.error();
  auto instance = continuous::Instance::make(parts->roads, parts->agents, roadmap_.unit_sizes(), {},
                                             parts->obstacles);
  if (instance) return instance;
  Error error = in_words(instance.error(), parts->roads, parts->agents, parts->obstacles);
  if (error.code == ErrorCode::no_plan) error.message += PlaceRounding(*this).doubt_about_refusal();
  return error;
}

}  // namespace quadrille::fleet
