// SPDX-License-Identifier: MIT
// Robots that begin in the middle of a move.
#include "quadrille/continuous/under_way.hpp"

#include <algorithm>
#include <cmath>

#include "lane_duration.hpp"
#include "numbers.hpp"
#include "quadrille/fleet/fleet.hpp"
#include "quadrille/fleet/timed_plan.hpp"

namespace quadrille::fleet {
namespace {

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

/// How far the place is from that fraction of the way; what double cannot tell is nothing.
double distance_off(const continuous::Point& place, const continuous::Point& from,
                    const continuous::Point& to, double fraction) {
  const auto off = [&](continuous::Length at, continuous::Length a, continuous::Length b) {
    return static_cast<double>((at - a).value()) - fraction * static_cast<double>((b - a).value());
  };
  const double distance = std::hypot(off(place.x, from.x, to.x), off(place.y, from.y, to.y),
                                     off(place.z, from.z, to.z));
  return distance < 1e-6 ? 0 : distance;
}

}  // namespace

Robot Robot::from(VertexId start) const {
  Fleet::Entry& entry = fleet_->robots_[id_];
  if (start.index() >= fleet_->roadmap_.num_vertices()) {
    QUADRILLE_REQUIRE(entry.under_way.has_value(), "a vertex of the roadmap, or its own place");
    return *this;
  }
  entry.start = start;
  entry.under_way.reset();
  return *this;
}

Robot Robot::from_edge(VertexId from, VertexId to, double fraction) const {
  Fleet::Entry& entry = fleet_->robots_[id_];
  QUADRILLE_REQUIRE(to.index() < fleet_->roadmap_.num_vertices(), "a vertex of the roadmap");
  if (from.index() < fleet_->roadmap_.num_vertices()) {
    entry.start.reset();
    entry.under_way = {from, to, fraction};
    return *this;
  }
  // What was rounded down before is in the new fraction again: it comes to as many whole steps as
  // lie behind the robot in both parts together.
  QUADRILLE_REQUIRE(entry.under_way && entry.under_way->to == to,
                    "a vertex of the roadmap, or its own place");
  double& behind = entry.under_way->fraction;
  const bool is_part = fraction >= 0 && fraction <= 1;  // else `instance` refuses it
  behind = is_part ? behind + (1 - behind) * fraction : fraction;
  return *this;
}

Robot Robot::from(const TimedPath& path, Seconds time) const {
  QUADRILLE_REQUIRE(std::isfinite(time.value()), "a moment");
  const auto& stops = path.stops();
  const auto next = std::find_if(stops.begin(), stops.end() - 1,
                                 [&](const Stop& stop) { return stop.depart >= time; });
  const bool is_there = next == stops.begin() || next->arrive <= time;
  if (is_there && (next != stops.begin() || !path.under_way())) return from(next->vertex);
  if (is_there) {
    const UnderWay& begin = *path.under_way();
    return from_edge(begin.from, begin.to, begin.fraction);
  }
  const Stop& last = *(next - 1);
  const double share = (time - last.depart) / (next->arrive - last.depart);
  if (next - 1 != stops.begin() || !path.under_way())
    return from_edge(last.vertex, next->vertex, share);
  const UnderWay& begin = *path.under_way();
  return from_edge(begin.from, begin.to, begin.fraction + (1 - begin.fraction) * share);
}

// A vertex for each place in the middle of a move, with what is left of the move. Nobody else can
// be there.
Result<Fleet::Roads> Fleet::put_under_way(std::vector<continuous::Agent>& agents,
                                          std::vector<double>& off) const {
  off.assign(agents.size(), 0);
  if (std::none_of(agents.begin(), agents.end(), [](const auto& a) { return a.under_way; }))
    return roadmap_.in_units();
  std::vector<continuous::Point> points = roadmap_.in_units()->positions();
  std::vector<continuous::Edge> edges = roadmap_.in_units()->edges();
  for (const AgentId id : robot_ids()) {
    continuous::Agent& agent = agents[id.index()];
    if (!agent.under_way) continue;
    const UnderWay& where = *robots_[id].under_way;
    const std::string name = "'" + this->name(id) + "' ";
    if (!(where.fraction >= 0 && where.fraction <= 1))
      return out_of_range(name + "is under way with " + shortest(where.fraction) +
                          " of its move behind it, which is not from 0 to 1");
    const continuous::Point from = points[where.from.index()], to = points[where.to.index()];
    const auto whole = lane_duration(*roadmap_.in_units(), agent, where.from, where.to);
    if (!whole)
      return out_of_range(name + "is under way from " + roadmap_.name(where.from) + " to " +
                          roadmap_.name(where.to) + ", which takes it less than half a step of " +
                          to_string(roadmap_.resolution().time) + ", or too long");
    agent.start = continuous::add_place_under_way(points, edges, where.from, where.to, *whole,
                                                  where.fraction);
    off[id.index()] = distance_off(points[agent.start.index()], from, to, where.fraction);
  }
  auto roads = continuous::Roadmap::make(std::move(points), std::move(edges));
  if (!roads) return roads.error();
  return std::make_shared<const continuous::Roadmap>(std::move(roads).value());
}

}  // namespace quadrille::fleet
