// SPDX-License-Identifier: MIT
#include "roadmap/dispatch_rmf.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>

namespace quadrille::cli {
namespace {

using continuous::Ticks;
using dispatch::Course;
using Json = DispatchRmf::Json;

Error wrong(const std::string& message) { return {ErrorCode::syntax, message, {}}; }

Json no_session() { return {{"uuid", std::vector<int>(16, 0)}}; }

/// How long the robot takes from the vertex to each vertex, alone; the largest number: no way.
std::vector<Ticks> times_from(const continuous::Instance& instance, AgentId robot, VertexId start) {
  constexpr Ticks kFar{std::numeric_limits<Ticks::Count>::max()};
  std::vector<Ticks> times(instance.roadmap().num_vertices(), kFar);
  using Entry = std::pair<Ticks, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  times[start.index()] = 0;
  open.emplace(Ticks{0}, start);
  const continuous::ClassId kind = instance.class_of(robot);
  while (!open.empty()) {
    const auto [time, v] = open.top();
    open.pop();
    if (time > times[v.index()]) continue;
    for (const continuous::EdgeId e : instance.out_edges(kind, v)) {
      const VertexId to = instance.roadmap().edge(e).to;
      const Ticks then = time + instance.duration(kind, e);
      if (then >= times[to.index()]) continue;
      times[to.index()] = then;
      open.emplace(then, to);
    }
  }
  return times;
}

}  // namespace

DispatchRmf::DispatchRmf(const continuous::Instance& instance, const DispatchWords& words,
                         const dispatch::Dispatcher& dispatcher)
    : instance_(instance), words_(words), dispatcher_(dispatcher) {
  known_.resize(instance.num_agents(), {no_session(), 0, {}});
  for (const AgentId robot : instance.agent_ids())
    known_[robot.index()].course = dispatcher.course(robot);
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
  const dispatch::Spot end = dispatcher_.course(robot).back().spot;
  const auto times = times_from(instance_, robot, end.to);
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
  for (const AgentId robot : instance_.agent_ids()) {
    Known& known = known_[robot.index()];
    const Course& course = dispatcher_.course(robot);
    if (course == known.course) continue;
    known.course = course;
    ++known.version;
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
          {"departure_trajectory", Json::array()},
          {"departure_action", ""},
          {"arrival_action", ""}};
}

Json DispatchRmf::plan(AgentId robot) const {
  Json waypoints = Json::array();
  const Course& course = dispatcher_.course(robot);
  for (std::size_t k = 0; k < course.size(); ++k) waypoints.push_back(waypoint(course, k));
  return {{"waypoints", waypoints},
          {"start_time", {{"sec", 0}, {"nanosec", 0}}},
          {"plan_id", plan_id(robot)},
          {"workflow", ""}};
}

Json DispatchRmf::messages() const {
  Json list = Json::array();
  for (const AgentId robot : instance_.agent_ids()) {
    const Course& course = dispatcher_.course(robot);
    const Ticks limit = dispatcher_.limit(robot), clock = dispatcher_.clock(robot);
    std::size_t released = 0, reached = 0;
    for (std::size_t k = 0; k < course.size(); ++k) {
      if (course[k].arrive <= limit) released = k;
      if (course[k].arrive <= clock) reached = k;
    }
    const bool is_under_way = course[reached].depart < clock && reached + 1 < course.size();
    list.push_back({{"name", words_.participant(robot)},
                    {"plan", plan(robot)},
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
