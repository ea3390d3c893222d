// SPDX-License-Identifier: MIT
#include "quadrille/fleet/fleet.hpp"

#include <set>

#include "conversions.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::fleet {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

Result<continuous::Body> to_units(const Disc& disc, const continuous::Resolution& resolution) {
  const auto radius = radius_to_units(disc.radius, resolution);
  if (!radius)
    return out_of_range("has a radius of " + to_string(disc.radius) +
                        ", which is not positive, or too large");
  return continuous::Body(continuous::Disc{*radius});
}

Result<continuous::Body> to_units(const Polygon& polygon,
                                  const continuous::Resolution& resolution) {
  std::vector<continuous::Point> corners;
  for (const Point& corner : polygon.corners) {
    const auto point = to_units(corner, resolution);
    if (!point) return out_of_range("has a polygon with a corner that is too far away");
    corners.push_back(*point);
  }
  auto made = continuous::ConvexPolygon::make(std::move(corners));
  if (!made)
    return Error{made.error().code,
                 "has a polygon that is not supported at a resolution of " +
                     to_string(Metres(resolution.length)) + ": " + made.error().message,
                 {}};
  return continuous::Body(std::move(made).value());
}

}  // namespace

Robot Robot::from(VertexId start) const {
  QUADRILLE_REQUIRE(start.index() < fleet_->roadmap_.num_vertices(), "a vertex of the roadmap");
  fleet_->robots_[id_].start = start;
  return *this;
}

Robot Robot::to(VertexId goal) const {
  QUADRILLE_REQUIRE(goal.index() < fleet_->roadmap_.num_vertices(), "a vertex of the roadmap");
  fleet_->robots_[id_].goal = goal;
  return *this;
}

Robot Fleet::robot(RobotSpec spec) {
  robots_.push_back({std::move(spec), std::nullopt, std::nullopt});
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

Result<std::vector<continuous::Agent>> Fleet::agents() const {
  const continuous::Resolution resolution = roadmap_.unit_sizes();
  std::vector<continuous::Agent> agents;
  std::set<std::string> names;
  for (const AgentId id : robot_ids()) {
    const Entry& entry = robots_[id];
    const std::string quoted = "'" + this->name(id) + "'", name = quoted + " ";
    if (!names.insert(name).second) return invalid("two robots are called " + quoted);
    if (!entry.start || !entry.goal)
      return invalid(name + "has no " + (entry.start ? "goal" : "start"));
    const auto body =
        std::visit([&](const auto& shape) { return to_units(shape, resolution); }, entry.spec.body);
    if (!body) return Error{body.error().code, name + body.error().message, {}};
    const auto speed = continuous::quantise_speed(entry.spec.speed.value(), resolution);
    if (!speed)
      return out_of_range(name + "has a speed of " + to_string(entry.spec.speed) +
                          ", which is not supported");
    agents.push_back({*entry.start, *entry.goal, *body, *speed});
  }
  return agents;
}

// Agents and edges are numbers in the errors of the layer below. What can still be wrong there is
// found again here, in the words of the fleet.
Error Fleet::in_words(const Error& error, const std::vector<continuous::Agent>& agents) const {
  if (auto found = find_unsupported(agents)) return *found;
  if (auto found = find_overlap(agents, &continuous::Agent::start, "starts")) return *found;
  if (auto found = find_overlap(agents, &continuous::Agent::goal, "goals")) return *found;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const auto alone =
        continuous::Instance::make(roadmap_.in_units(), {agents[i]}, roadmap_.unit_sizes());
    if (alone) continue;
    return {alone.error().code,
            "'" + name(AgentId(i)) + "' cannot get from " + roadmap_.name(agents[i].start) +
                " to " + roadmap_.name(agents[i].goal),
            {}};
  }
  return error;
}

std::optional<Error> Fleet::find_unsupported(const std::vector<continuous::Agent>& agents) const {
  const continuous::Roadmap& roads = *roadmap_.in_units();
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::string name = "'" + this->name(AgentId(i)) + "'";
    if (geometry::enclosing_radius(agents[i].body) > geometry::kMaxLength)
      return out_of_range(name + " is too large");
    for (const continuous::Edge& lane : roads.edges())
      if (!continuous::travel_time(roads.position(lane.from), roads.position(lane.to),
                                   agents[i].speed))
        return out_of_range("the lane from " + roadmap_.name(lane.from) + " to " +
                            roadmap_.name(lane.to) + " takes " + name +
                            " less than half a step of " + to_string(roadmap_.resolution().time) +
                            ", or too long");
  }
  return std::nullopt;
}

std::optional<Error> Fleet::find_overlap(const std::vector<continuous::Agent>& agents,
                                         VertexId continuous::Agent::*end,
                                         const std::string& what) const {
  const continuous::Roadmap& roads = *roadmap_.in_units();
  for (std::size_t j = 0; j < agents.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const VertexId v = agents[i].*end, w = agents[j].*end;
      if (geometry::bodies_overlap(agents[i].body, roads.position(v), agents[j].body,
                                   roads.position(w)))
        return Error{ErrorCode::no_plan,
                     "the " + what + " of '" + name(AgentId(i)) + "' at " + roadmap_.name(v) +
                         " and '" + name(AgentId(j)) + "' at " + roadmap_.name(w) + " overlap",
                     {}};
    }
  return std::nullopt;
}

Result<continuous::Instance> Fleet::instance() const {
  auto agents = this->agents();
  if (!agents) return agents.error();
  auto instance = continuous::Instance::make(roadmap_.in_units(), *agents, roadmap_.unit_sizes());
  if (!instance) return in_words(instance.error(), *agents);
  return instance;
}

}  // namespace quadrille::fleet
