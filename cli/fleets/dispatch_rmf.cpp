// SPDX-License-Identifier: MIT
#include "fleets/dispatch_rmf.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "quadrille/exports/rmf.hpp"

namespace quadrille::cli {
namespace {

using dispatch::Course;
using dispatch::Ticks;
using Json = DispatchRmf::Json;

Error wrong(const std::string& message) { return {ErrorCode::syntax, message, {}}; }

Json no_session() { return {{"uuid", std::vector<int>(16, 0)}}; }

}  // namespace

DispatchRmf::DispatchRmf(const LiveFleet& fleet, const DispatchWords& words)
    : fleet_(fleet), words_(words) {
  for (std::size_t i = 0; i < fleet.num_robots(); ++i)
    known_.push_back({no_session(), 0, fleet.course(AgentId(i))});
}

Result<VertexId> DispatchRmf::vertex_of(const Json& constraints) const {
  if (!constraints.is_object() || !constraints.contains("nodes") ||
      !constraints["nodes"].is_array() || constraints["nodes"].empty())
    return wrong("\"one_of\": each needs \"nodes\"; regions alone are no vertices");
  const Json& node = constraints["nodes"].front();
  if (!node.is_object() || !node.contains("key") || !node["key"].is_object())
    return wrong("\"nodes\": each has a \"key\"");
  const Json& key = node["key"];
  for (const char* by : {"name", "key"})
    if (key.contains(by) && key[by].is_array() && !key[by].empty())
      return words_.vertex(key[by].front());
  return wrong("\"key\": it has a \"name\" or a \"key\"");
}

Result<Goals> DispatchRmf::goals(const Json& goal, AgentId robot) const {
  const Json& choices = goal["one_of"];
  if (!choices.is_array() || choices.empty()) return wrong("\"one_of\" is a list of at least one");
  std::vector<double> biases(choices.size(), 0);
  if (goal.contains("cost_bias") && !goal["cost_bias"].empty()) {
    const Json& given = goal["cost_bias"];
    if (!given.is_array() || given.size() != choices.size())
      return wrong("\"cost_bias\" is empty, or as long as \"one_of\"");
    for (std::size_t k = 0; k < given.size(); ++k) {
      if (!given[k].is_number()) return wrong("\"cost_bias\" has numbers");
      biases[k] = given[k].get<double>();
    }
  }
  const dispatch::Spot end = fleet_.course(robot).back().spot;
  const auto times = fleet_.times_from(robot, end.to);
  std::vector<VertexId> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const auto vertex = vertex_of(choices[k]);
    if (!vertex) return vertex.error();
    const double cost = words_.time(times[vertex->index()]) + biases[k];
    if (cost < least) best.clear();
    least = std::min(least, cost);
    if (cost == least) best.push_back(*vertex);
  }
  return Goals(std::move(best));
}

void DispatchRmf::set_session(AgentId robot, const Json& goal) {
  known_[robot.index()].session = goal.contains("session") ? goal["session"] : no_session();
  known_[robot.index()].version = 0;
}

void DispatchRmf::note_courses() {
  for (std::size_t i = 0; i < known_.size(); ++i) {
    Course course = fleet_.course(AgentId(i));
    if (course == known_[i].course) continue;
    known_[i].course = std::move(course);
    ++known_[i].version;
  }
}

Json DispatchRmf::plan_id(AgentId robot) const {
  const Known& known = known_[robot.index()];
  return {{"destination_session", known.session}, {"plan_version", known.version}};
}

Json DispatchRmf::waypoint(const Course& course, std::size_t k) const {
  Json nodes = Json::array();
  const dispatch::Spot& spot = course[k].spot;
  if (spot.is_vertex()) {
    const Json called = words_.vertex(spot.from);
    Json name = Json::array();
    if (called.is_string()) name.push_back(called);
    nodes.push_back({{"key",
                      {{"graph_name", "graph"},
                       {"key", {spot.from.value()}},
                       {"name", name},
                       {"map", {"map"}},
                       {"element_type", 1}}},
                     {"orientations", Json::array()}});
  }
  return {{"position", words_.position(spot)},
          {"arrival_constraints", {{"regions", Json::array()}, {"nodes", nodes}}},
          {"progress", static_cast<float>(words_.time(course[k].depart))},
          {"maps", {"map"}},
          {"departure_blockers", Json::array()},
          {"departure_trajectory",
           k + 1 < course.size() ? Json::array({trajectory(course, k)}) : Json::array()},
          {"departure_action", ""},
          {"arrival_action", ""}};
}

Json DispatchRmf::trajectory(const Course& course, std::size_t k) const {
  const auto point = [&](const dispatch::Spot& spot) {
    return Json{{"position", words_.position(spot)}, {"weight", 1.0F}};
  };
  const auto level = [&](Ticks time) { return static_cast<float>(words_.time(time)); };
  const auto time = level(course[k + 1].arrive - course[k].depart);
  return {{"curve",
           {{"degree", 1},
            {"control_points", {point(course[k].spot), point(course[k + 1].spot)}},
            {"knots", {0.0F, 0.0F, time, time}}}},
          {"initial_progress_level", level(course[k].depart)},
          {"final_progress_level", level(course[k + 1].arrive)},
          {"maps", {"map"}},
          {"keys", Json::array()}};
}

// Moves of the order are found on courses by when they end: what has been passed is left out of
// either.
DispatchRmf::Blockers DispatchRmf::blockers() const {
  const execution::Precedences order = fleet_.order();
  std::vector<Course> courses;
  Blockers blockers;
  for (std::size_t i = 0; i < known_.size(); ++i) {
    courses.push_back(fleet_.course(AgentId(i)));
    blockers.emplace_back(courses.back().size(), Json::array());
  }
  const auto stop_at_end = [&](const execution::MoveId& id) -> std::optional<std::size_t> {
    const Course& course = courses[id.agent.index()];
    const auto at = std::find_if(course.begin() + 1, course.end(), [&](const dispatch::Stop& stop) {
      return stop.arrive == order.at(id).end;
    });
    if (at == course.end()) return std::nullopt;
    return static_cast<std::size_t>(at - course.begin());
  };
  for (const execution::Precedence& precedence : order.list) {
    const auto blocker = exports::blocker_of(order, precedence);
    if (!blocker) continue;
    const auto follower = stop_at_end(precedence.follower), leader = stop_at_end(blocker->leader);
    if (!follower || !leader) continue;
    const Course& ahead = courses[blocker->leader.agent.index()];
    const auto all = static_cast<float>(words_.time(ahead[*leader].depart));
    float required = all;
    // No progress before that time is as much.
    if (blocker->until)
      required = std::min(all, std::nextafter(static_cast<float>(words_.time(*blocker->until)),
                                              std::numeric_limits<float>::infinity()));
    blockers[precedence.follower.agent.index()][*follower - 1].push_back(
        {{"name", words_.participant(blocker->leader.agent)},
         {"plan_id", plan_id(blocker->leader.agent)},
         {"required_progress", required}});
  }
  return blockers;
}

Json DispatchRmf::plan(AgentId robot, const std::vector<Json>& blockers) const {
  Json waypoints = Json::array();
  const Course course = fleet_.course(robot);
  for (std::size_t k = 0; k < course.size(); ++k) {
    waypoints.push_back(waypoint(course, k));
    waypoints.back()["departure_blockers"] = blockers[k];
  }
  return {{"waypoints", waypoints},
          {"start_time", {{"sec", 0}, {"nanosec", 0}}},
          {"plan_id", plan_id(robot)},
          {"workflow", ""}};
}

Json DispatchRmf::messages() const {
  Json list = Json::array();
  const Blockers blockers = this->blockers();
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const AgentId robot(i);
    const Course course = fleet_.course(robot);
    const Ticks limit = fleet_.limit(robot), clock = fleet_.clock(robot);
    std::size_t released = 0, reached = 0;
    for (std::size_t k = 0; k < course.size(); ++k) {
      if (course[k].arrive <= limit) released = k;
      if (course[k].arrive <= clock) reached = k;
    }
    const bool is_under_way = course[reached].depart < clock && reached + 1 < course.size();
    list.push_back({{"name", words_.participant(robot)},
                    {"plan", plan(robot, blockers[i])},
                    {"release", {{"waypoint_id", released}, {"plan_id", plan_id(robot)}}},
                    {"progress",
                     {{"progress", static_cast<float>(words_.time(clock))},
                      {"reached_waypoint", reached},
                      {"target_waypoint", is_under_way ? reached + 1 : reached},
                      {"reached_keys", Json::array()},
                      {"plan_id", plan_id(robot)}}}});
  }
  return list;
}

}  // namespace quadrille::cli
