// SPDX-License-Identifier: MIT
#include "quadrille/fleet/fleet.hpp"

#include <algorithm>
#include <set>

#include "conversions.hpp"
#include "quadrille/continuous/quantise_polygon.hpp"

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

Robot Robot::to_any(std::vector<VertexId> goals) const {
  QUADRILLE_REQUIRE(!goals.empty(), "a robot ends somewhere");
  for (const VertexId goal : goals)
    QUADRILLE_REQUIRE(goal.index() < fleet_->roadmap_.num_vertices(), "a vertex of the roadmap");
  fleet_->robots_[id_].goals = Goals(std::move(goals));
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

Robot Robot::becomes(RobotSpec spec) const {
  fleet_->robots_[id_].spec = std::move(spec);
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
  closed_.clear();
}

std::vector<continuous::EdgeId> Fleet::edges(VertexId from, VertexId to) const {
  std::vector<continuous::EdgeId> edges;
  if (from.index() >= roadmap_.num_vertices()) return edges;
  for (const continuous::EdgeId e : roadmap_.in_units()->out_edges(from))
    if (roadmap_.in_units()->edge(e).to == to) edges.push_back(e);
  return edges;
}

std::string Fleet::lane_name(VertexId from, VertexId to) const {
  const auto name = [&](VertexId v) {
    return v.index() < roadmap_.num_vertices() ? roadmap_.name(v)
                                               : "vertex " + std::to_string(v.index());
  };
  return "lane from " + name(from) + " to " + name(to);
}

std::optional<Error> Fleet::close(VertexId from, VertexId to) {
  if (edges(from, to).empty()) return invalid("there is no " + lane_name(from, to));
  if (!closed_.emplace(from, to).second)
    return invalid("the " + lane_name(from, to) + " is closed already");
  return std::nullopt;
}

std::optional<Error> Fleet::open(VertexId from, VertexId to) {
  if (edges(from, to).empty()) return invalid("there is no " + lane_name(from, to));
  if (closed_.erase({from, to}) == 0)
    return invalid("the " + lane_name(from, to) + " is not closed");
  return std::nullopt;
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
  if (!entry.goals || (!entry.start && !entry.under_way))
    return invalid(name + "has no " + (entry.goals ? "start" : "goal"));
  const auto body =
      std::visit([&](const auto& shape) { return to_units(shape, resolution); }, entry.spec.body);
  if (!body) return Error{body.error().code, name + body.error().message, {}};
  const auto speed = continuous::quantise_speed(entry.spec.speed.value(), resolution);
  if (!speed)
    return out_of_range(name + "has a speed of " + to_string(entry.spec.speed) +
                        ", which is not supported");
  continuous::Agent agent{entry.start.value_or(VertexId(0)), *entry.goals, *body, *speed};
  if (auto error = add_shapes(agent)) return Error{error->code, name + error->message, {}};
  // Its start is to come, if it is.
  agent.under_way = entry.under_way && !entry.under_way->may_wait;
  if (entry.spec.group) {
    if (entry.spec.group->index() < 1 || entry.spec.group->index() > roadmap_.num_groups())
      return invalid(name + "is of a group that the roadmap does not have");
    agent.group = *entry.spec.group;
  }
  if (agent.under_way && entry.release > begin_)
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

// Where vertices are poses, a polygon turns.
std::optional<Error> Fleet::add_shapes(continuous::Agent& agent) const {
  if (roadmap_.turns() == nullptr || std::holds_alternative<continuous::Disc>(agent.body))
    return std::nullopt;
  auto shapes = continuous::shapes_of(agent.body, *roadmap_.turns());
  if (!shapes) return shapes.error();
  agent.shapes = std::move(shapes).value();
  return std::nullopt;
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

Result<continuous::Ticks> Fleet::begin_in_units() const {
  const auto now = continuous::quantise_time(begin_.value(), roadmap_.unit_sizes());
  if (now) return *now;
  return out_of_range("the fleet begins at " + to_string(begin_) +
                      ", which is negative, or too late");
}

continuous::Words Fleet::words() const {
  return {[this](AgentId id) { return "'" + name(id) + "'"; },
          [this](std::size_t o) { return "'" + obstacle_name(o) + "'"; },
          [this](VertexId v) { return place_name(v); },
          [this](continuous::Ticks time) {
            return to_string(in_seconds(time, roadmap_.unit_sizes()));
          }};
}

Result<Fleet::Parts> Fleet::parts() const {
  Parts parts;
  const auto now = begin_in_units();
  if (!now) return now.error();
  parts.now = *now;
  auto agents = this->agents();
  if (!agents) return agents.error();
  auto roads = put_under_way(*agents, parts.now);
  if (!roads) return roads.error();
  if (!closed_.empty()) {
    std::vector<continuous::EdgeId> closed;
    for (const auto& [from, to] : closed_) {
      const auto between = edges(from, to);
      closed.insert(closed.end(), between.begin(), between.end());
    }
    roads = std::make_shared<const continuous::Roadmap>((*roads)->with_closed(closed));
  }
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
                                             parts->obstacles, parts->now);
  if (instance) return instance->with_whole_moves(whole_moves_);
  return continuous::in_words(instance.error(), parts->roads, parts->agents, roadmap_.unit_sizes(),
                              parts->obstacles, parts->now, words());
}

}  // namespace quadrille::fleet
