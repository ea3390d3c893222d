// SPDX-License-Identifier: MIT
#include "scene_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

namespace quadrille::view {
namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a point, which is shorter.
Json number(double value) {
  constexpr double kExact = 9e15;
  if (value == std::floor(value) && std::abs(value) < kExact)
    return static_cast<std::int64_t>(value);
  return value;
}

/// How often each cell or move repeats: "12R3.", a count of one is left out.
class RunLength {
 public:
  void add(char letter, std::int64_t times = 1) {
    if (letter != letter_) flush();
    letter_ = letter;
    count_ += times;
  }
  [[nodiscard]] std::string finish() {
    flush();
    return std::move(text_);
  }

 private:
  void flush() {
    if (count_ > 1) text_ += std::to_string(count_);
    if (count_ > 0) text_ += letter_;
    count_ = 0;
  }
  std::string text_;
  char letter_ = 0;
  std::int64_t count_ = 0;
};

/// 0 if that is no move to the next cell.
char letter_of(Position from, Position to) {
  const double x = to.x - from.x, y = to.y - from.y;
  if (std::abs(x) + std::abs(y) != 1) return 0;
  if (x != 0) return x > 0 ? 'R' : 'L';
  return y > 0 ? 'D' : 'U';
}

/// The path as letters, which takes few bytes; null if it needs more than moves between cells.
Json moves_of(const Scene& scene, const SceneAgent& agent) {
  if (scene.is_continuous || !scene.cells || agent.stops.front().arrive != 0) return nullptr;
  RunLength moves;
  for (std::size_t k = 0; k < agent.stops.size(); ++k) {
    const SceneStop& stop = agent.stops[k];
    if (k > 0) {
      const SceneStop& last = agent.stops[k - 1];
      const char letter = letter_of(scene.places[last.place], scene.places[stop.place]);
      if (letter == 0) return nullptr;
      moves.add(letter);
    }
    if (stop.depart > stop.arrive) moves.add('.', stop.depart - stop.arrive);
  }
  return moves.finish();
}

Json point(const Scene& scene, Position position) {
  Json json{number(position.x), number(position.y)};
  if (scene.has_heights) json.push_back(number(position.z));
  return json;
}

Json agent_json(const Scene& scene, const SceneAgent& agent) {
  Json json;
  json["start"] = point(scene, scene.places[agent.start]);
  json["goal"] = point(scene, scene.places[agent.goal]);
  if (!scene.bodies.empty()) json["body"] = agent.body;
  if (agent.free_cost) json["free"] = *agent.free_cost;
  if (agent.cost) json["cost"] = *agent.cost;
  if (agent.leaves) json["leaves"] = true;
  for (const std::size_t place : agent.other_goals)
    json["other_goals"].push_back(point(scene, scene.places[place]));
  if (agent.stops.empty()) return json;
  if (!agent.looks.empty()) json["looks"] = agent.looks;
  if (!scene.headings.empty())
    for (const SceneStop& stop : agent.stops)
      json["headings"].push_back(number(scene.headings[stop.place]));
  const Json moves = agent.looks.empty() ? moves_of(scene, agent) : Json();
  if (!moves.is_null()) {
    json["from"] = point(scene, scene.places[agent.stops.front().place]);
    json["moves"] = moves;
    return json;
  }
  Json stops = Json::array();
  for (const SceneStop& stop : agent.stops) {
    const Position at = scene.places[stop.place];
    for (const Json& value : {number(at.x), number(at.y), Json(stop.arrive), Json(stop.depart)})
      stops.push_back(value);
  }
  json["stops"] = std::move(stops);
  if (scene.has_heights)
    for (const SceneStop& stop : agent.stops)
      json["heights"].push_back(number(scene.places[stop.place].z));
  return json;
}

Json obstacle_json(const Scene& scene, const SceneObstacle& obstacle) {
  Json stops = Json::array();
  for (const auto& stop : obstacle.stops)
    for (const Json& value :
         {number(stop.at.x), number(stop.at.y), Json(stop.arrive), Json(stop.depart)})
      stops.push_back(value);
  Json json = {{"body", obstacle.body}, {"stops", std::move(stops)}, {"leaves", obstacle.leaves}};
  if (scene.has_heights)
    for (const auto& stop : obstacle.stops) json["heights"].push_back(number(stop.at.z));
  return json;
}

Json cells_json(const Cells& cells) {
  RunLength runs;
  for (const bool passable : cells.passable) runs.add(passable ? '.' : '@');
  return {{"width", cells.width},
          {"height", cells.height},
          {"pitch", number(cells.pitch)},
          {"runs", runs.finish()}};
}

Json body_json(const continuous::Body& body) {
  if (const auto* disc = std::get_if<continuous::Disc>(&body))
    return {{"radius", disc->radius.value()}};
  Json corners = Json::array();
  for (const continuous::Point& corner : std::get<continuous::ConvexPolygon>(body).vertices()) {
    corners.push_back(corner.x.value());
    corners.push_back(corner.y.value());
  }
  return {{"corners", std::move(corners)}};
}

void add_roadmap(const Scene& scene, Json& json) {
  Json places = Json::array(), links = Json::array(), one_way = Json::array();
  for (std::size_t v = 0; v < std::min(scene.places.size(), scene.num_vertices); ++v) {
    places.push_back(number(scene.places[v].x));
    places.push_back(number(scene.places[v].y));
  }
  for (const Link& link : scene.links) {
    Json& list = link.one_way ? one_way : links;
    list.push_back(link.from);
    list.push_back(link.to);
  }
  json["places"] = std::move(places);
  json["links"] = std::move(links);
  json["oneWay"] = std::move(one_way);
  json["hiddenLinks"] = scene.hidden_links;
}

Json violation_json(const SceneViolation& violation) {
  Json agents = {violation.agent};
  if (violation.other) agents.push_back(*violation.other);
  return {{"kind", violation.kind},
          {"agents", std::move(agents)},
          {"time", number(violation.time)},
          {"message", violation.message}};
}

Json site_json(const SceneSite& site) {
  Json json;
  json["agents"] = {site.agent, site.other};
  json["lines"] = Json::array();
  for (const auto& line : site.lines) {
    Json points = Json::array();
    for (const Position& position : line) {
      points.push_back(number(position.x));
      points.push_back(number(position.y));
    }
    json["lines"].push_back(std::move(points));
  }
  json["begin"] = site.begin;
  json["end"] = site.end ? Json(*site.end) : Json(nullptr);
  json["lemmas"] = site.lemmas;
  return json;
}

Json attribution_json(const Scene& scene) {
  Json json;
  json["freeBound"] = scene.free_bound;
  json["lowerBound"] = scene.lower_bound;
  json["raises"] = Json::array();
  for (const Raise& raise : scene.raises) {
    Json agents = Json::array();
    for (const AgentId i : raise.agents) agents.push_back(i.index());
    json["raises"].push_back({{"amount", raise.amount}, {"agents", std::move(agents)}});
  }
  json["sites"] = Json::array();
  for (const SceneSite& site : scene.sites) json["sites"].push_back(site_json(site));
  return json;
}

Json obstruction_json(const Scene& scene, const Obstruction& obstruction) {
  Json json;
  json["reason"] = obstruction.reason;
  json["agents"] = Json::array();
  for (const AgentId i : obstruction.agents) json["agents"].push_back(i.index());
  json["points"] = Json::array();
  for (const VertexId v : obstruction.vertices) {
    json["points"].push_back(number(scene.places[v.index()].x));
    json["points"].push_back(number(scene.places[v.index()].y));
  }
  return json;
}

/// Seven numbers each, one after the other.
Json precedences_json(const Scene& scene) {
  Json list = Json::array();
  for (const ScenePrecedence& p : scene.precedences) {
    list.push_back(p.leader);
    list.push_back(p.leader_begin);
    list.push_back(p.leader_end);
    list.push_back(p.follower);
    list.push_back(p.follower_begin);
    list.push_back(p.follower_end);
    list.push_back(p.slack);
  }
  return list;
}

}  // namespace

std::string scene_json(const Scene& scene, const PageOptions& options) {
  Json json;
  json["quadrille"] = "scene";
  json["version"] = 1;
  json["title"] = options.title;
  json["continuous"] = scene.is_continuous;
  json["hasLayout"] = scene.has_layout;
  json["yUp"] = scene.y_up;
  json["heights"] = scene.has_heights;
  if (scene.now != 0) json["now"] = scene.now;
  json["unit"] = scene.time_unit;
  json["lengthUnit"] = scene.length_unit;
  json["objective"] = to_string(options.objective);
  if (options.status) json["status"] = to_string(*options.status);
  if (options.lower_bound) json["lowerBound"] = *options.lower_bound;
  json["sumOfCosts"] = scene.sum_of_costs;
  json["makespan"] = scene.makespan;
  if (scene.cells)
    json["cells"] = cells_json(*scene.cells);
  else
    add_roadmap(scene, json);
  json["bodies"] = Json::array();
  for (const continuous::Body& body : scene.bodies) json["bodies"].push_back(body_json(body));
  json["agents"] = Json::array();
  for (const SceneAgent& agent : scene.agents) json["agents"].push_back(agent_json(scene, agent));
  Json names = Json::array();
  for (const std::string& name : options.agent_names)
    names.push_back(name.empty() ? Json(nullptr) : Json(name));
  if (!names.empty()) json["names"] = std::move(names);
  json["obstacles"] = Json::array();
  for (const SceneObstacle& obstacle : scene.obstacles)
    json["obstacles"].push_back(obstacle_json(scene, obstacle));
  json["violations"] = Json::array();
  for (const SceneViolation& violation : scene.violations)
    json["violations"].push_back(violation_json(violation));
  json["nearest"] = Json::array();
  for (const Nearness& near : scene.nearest)
    json["nearest"].push_back({near.agent, near.other, near.gap, near.time});

  if (scene.has_attribution) json["attribution"] = attribution_json(scene);
  if (options.obstruction) json["obstruction"] = obstruction_json(scene, *options.obstruction);
  json["precedences"] = precedences_json(scene);

  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace quadrille::view
