// SPDX-License-Identifier: MIT
// Roadmaps with agents in JSON (docs/formats.md), and how their numbers become integers
// (docs/continuous.md).
#include "timed/road.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace quadrille_check {
namespace {

constexpr double kMost = 1099511627776.0;  // 2^40
constexpr Int kMaxVertices = Int{1} << 22;
__extension__ using Wide = __int128;

/// Of a resolution: how many units one is, if that is a whole number.
std::optional<double> units_per_one(double unit) {
  const double exact = 1 / unit, nearest = std::round(exact);
  if (nearest >= 1 && std::abs(exact - nearest) <= 1e-12 * nearest) return nearest;
  return std::nullopt;
}
double divided(double value, double unit) {
  const auto factor = units_per_one(unit);
  return factor ? value * *factor : value / unit;
}
double multiplied(double value, double unit) {
  const auto factor = units_per_one(unit);
  return factor ? value / *factor : value * unit;
}
Int whole(double units, double least, const char* what) {
  if (!(units >= least && units <= kMost)) throw BadInput(std::string("no possible ") + what);
  return static_cast<Int>(units);
}

class Reader {
 public:
  explicit Reader(const Json& root) : root_(root) {}

  Road read() {
    root_.only({"quadrille", "version", "resolution", "now", "roadmap", "agents", "obstacles",
                "group_names"});
    if (root_.at("quadrille").text() != "instance" || root_.at("version").number(1, 1) != 1)
      throw BadInput("no instance of version 1");
    read_resolution();
    if (const Json* now = root_.find("now")) now_ = time(*now);
    read_roadmap(root_.at("roadmap"));
    for (const Json* agent : root_.at("agents").list()) read_agent(*agent);
    if (const Json* obstacles = root_.find("obstacles"))
      for (const Json* obstacle : obstacles->list()) read_obstacle(*obstacle);
    return std::move(road_);
  }

 private:
  void read_resolution() {
    const Json* const given = root_.find("resolution");
    if (given == nullptr) return;
    if (given->kind == '{') {
      given->only({"length", "time"});
      length_ = given->at("length").any_number();
      time_ = given->at("time").any_number();
    } else {
      length_ = time_ = given->any_number();
    }
    if (!(length_ > 0 && time_ > 0)) throw BadInput("a resolution is more than 0");
  }

  [[nodiscard]] Int time(const Json& json) const {
    return whole(std::round(divided(json.any_number(), time_)), 0, "time");
  }

  void read_roadmap(const Json& roadmap) {
    roadmap.only({"vertices", "edges", "names"});
    for (const Json* vertex : roadmap.at("vertices").list()) road_.points.push_back(point(*vertex));
    road_.out.resize(road_.points.size());
    road_.in.resize(road_.points.size());
    for (const Json* edge : roadmap.at("edges").list()) read_edge(*edge);
  }

  [[nodiscard]] Point point(const Json& json) const {
    const auto coordinates = json.list();
    if (coordinates.size() != 2 && coordinates.size() != 3)
      throw BadInput("a point has two or three coordinates");
    Point point{};
    for (std::size_t k = 0; k < coordinates.size(); ++k)
      point[k] =
          whole(std::round(divided(coordinates[k]->any_number(), length_)), -kMost, "coordinate");
    return point;
  }

  [[nodiscard]] int vertex(const Json& json) const {
    return static_cast<int>(
        json.number(0, std::min(kMaxVertices, static_cast<Int>(road_.points.size()) - 1)));
  }

  void read_edge(const Json& json) {
    Road::Edge edge;
    const Json* duration = nullptr;
    if (json.kind == '{') {
      json.only({"from", "to", "duration", "groups", "speed_limit"});
      edge.from = vertex(json.at("from"));
      edge.to = vertex(json.at("to"));
      duration = json.find("duration");
      if (const Json* limit = json.find("speed_limit")) edge.most_speed = speed(*limit);
      if (duration != nullptr && edge.most_speed)
        throw BadInput("an edge has a duration and a speed limit");
      if (const Json* groups = json.find("groups")) {
        edge.groups = 0;
        for (const Json* group : groups->list())
          edge.groups |= std::uint64_t{1} << group->number(0, 63);
      }
    } else {
      const auto parts = json.list();
      if (parts.size() != 2 && parts.size() != 3)
        throw BadInput("an edge has two ends, and perhaps a duration");
      edge.from = vertex(*parts[0]);
      edge.to = vertex(*parts[1]);
      if (parts.size() == 3) duration = parts[2];
    }
    if (edge.from == edge.to) throw BadInput("an edge is a loop");
    if (duration != nullptr)
      edge.duration = whole(std::round(divided(duration->any_number(), time_)), 1, "duration");
    const int number = static_cast<int>(road_.edges.size());
    road_.out[static_cast<std::size_t>(edge.from)].push_back(number);
    road_.in[static_cast<std::size_t>(edge.to)].push_back(number);
    road_.edges.push_back(edge);
  }

  [[nodiscard]] static bool is_chosen(const Json* json, const char* no, const char* yes) {
    if (json == nullptr) return false;
    if (json->text() != no && json->text() != yes) throw BadInput("no such choice");
    return json->text() == yes;
  }

  [[nodiscard]] Body body(const Json& json) const {
    const Json* const radius = json.find("radius");
    if (radius != nullptr)
      return {whole(std::floor(divided(radius->any_number(), length_)), 1, "radius"), nullptr};
    std::vector<Point> corners;
    for (const Json* corner : json.at("polygon").list()) {
      const auto both = corner->list();
      if (both.size() != 2) throw BadInput("a corner has two coordinates");
      const auto part = [&](const Json& number) {
        return whole(std::trunc(divided(number.any_number(), length_)), -kMost, "corner");
      };
      corners.push_back({part(*both[0]), part(*both[1]), 0});
    }
    if (corners.size() < 3 || std::any_of(road_.points.begin(), road_.points.end(),
                                          [](const Point& point) { return point[2] != 0; }))
      throw BadInput("a polygon has three corners, and no vertex a height");
    return {0, std::make_shared<const std::vector<Point>>(std::move(corners))};
  }

  void read_obstacle(const Json& json) {
    json.only({"radius", "polygon", "path", "at_end"});
    const Body own = body(json);
    std::vector<Motion>& motions = road_.obstacles.emplace_back();
    const bool leaves = is_chosen(json.find("at_end"), "stay", "leave");
    const auto stops = json.at("path").list();
    if (stops.empty()) throw BadInput("an obstacle has no stops");
    for (const Json* stop : stops) {
      stop->only({"vertex", "at", "arrive", "depart"});
      const Json* const place = stop->find("at");
      const Point there = place != nullptr
                              ? point(*place)
                              : road_.points[static_cast<std::size_t>(vertex(stop->at("vertex")))];
      const Int arrive = time(stop->at("arrive")) - now_;
      const Json* const until = stop->find("depart");
      const Int depart = until != nullptr ? time(*until) - now_ : arrive;
      if (depart < arrive || (!motions.empty() && arrive <= motions.back().end))
        throw BadInput("an obstacle goes back in time");
      if (!motions.empty())
        motions.push_back({motions.back().to, there, motions.back().end, arrive, own});
      motions.push_back({there, there, arrive, depart, own});
    }
    if (!leaves) motions.back().end = kNever;
  }

  [[nodiscard]] Int speed(const Json& json) const {
    const double value = json.any_number();
    const double units = length_ == time_ ? value : multiplied(divided(value, length_), time_);
    return whole(std::round(units * 1e6), 1, "speed");
  }

  void read_agent(const Json& json) {
    json.only({"start", "goal", "goals", "radius", "polygon", "speed", "group", "release",
               "deadline", "at_start", "at_goal", "name"});
    if (json.find("goal") == nullptr) throw BadInput("there is no rule yet for several goals");
    Road::Agent agent;
    agent.under_way = is_chosen(json.find("at_start"), "stay", "under_way");
    agent.leaves = is_chosen(json.find("at_goal"), "stay", "leave");
    agent.start = vertex(json.at("start"));
    agent.goal = vertex(json.at("goal"));
    agent.body = body(json);
    if (const Json* given = json.find("speed")) {
      agent.speed = speed(*given);
    } else if (length_ != time_) {
      agent.speed = whole(std::round(multiplied(divided(1, length_), time_) * 1e6), 1, "speed");
    }
    if (const Json* group = json.find("group"))
      agent.group = static_cast<int>(group->number(0, 63));
    if (const Json* release = json.find("release"))
      agent.release = std::max<Int>(0, time(*release) - now_);
    if (const Json* deadline = json.find("deadline")) agent.deadline = time(*deadline) - now_;
    const auto [known, is_new] = speeds_.try_emplace(agent.speed, road_.durations.size());
    if (is_new) road_.durations.push_back(durations_at(agent.speed));
    agent.durations = known->second;
    road_.agents.push_back(agent);
  }

  [[nodiscard]] std::vector<Int> durations_at(Int speed) const {
    std::vector<Int> durations;
    for (const Road::Edge& edge : road_.edges) {
      const Road::Point &a = road_.points[static_cast<std::size_t>(edge.from)],
                        &b = road_.points[static_cast<std::size_t>(edge.to)];
      Wide squared = 0;
      for (std::size_t k = 0; k < 3; ++k) squared += static_cast<Wide>(b[k] - a[k]) * (b[k] - a[k]);
      const long double ticks =
          std::round(std::sqrt(static_cast<long double>(squared)) * 1000000 /
                     static_cast<long double>(std::min(speed, edge.most_speed.value_or(speed))));
      const bool is_possible = ticks >= 1 && ticks <= static_cast<long double>(kMost);
      durations.push_back(edge.duration ? *edge.duration
                                        : (is_possible ? static_cast<Int>(ticks) : 0));
    }
    return durations;
  }

  const Json& root_;
  Road road_;
  double length_ = 1e-6, time_ = 1e-6;
  Int now_ = 0;
  std::map<Int, std::size_t> speeds_;
};

}  // namespace

Road read_road(const Json& root) { return Reader(root).read(); }

}  // namespace quadrille_check
