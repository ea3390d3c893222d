// SPDX-License-Identifier: MIT
// Robots that begin in the middle of a move.
#include "quadrille/continuous/under_way.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "conversions.hpp"
#include "lane_duration.hpp"
#include "numbers.hpp"
#include "quadrille/fleet/fleet.hpp"
#include "quadrille/fleet/timed_plan.hpp"

namespace quadrille::fleet {
namespace {

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

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
  entry.under_way->may_wait = false;
  QUADRILLE_REQUIRE(!entry.under_way->begun, "a move that was told by its fraction");
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
    return from_edge(begin.from, begin.to, begin.fraction).may_wait(begin.may_wait);
  }
  const Stop& last = *(next - 1);
  const double share = (time - last.depart) / (next->arrive - last.depart);
  if (next - 1 != stops.begin() || !path.under_way())
    return from_edge(last.vertex, next->vertex, share);
  const UnderWay& begin = *path.under_way();
  return from_edge(begin.from, begin.to, begin.fraction + (1 - begin.fraction) * share);
}

Robot Robot::begun(Seconds time) const {
  Fleet::Entry& entry = fleet_->robots_[id_];
  QUADRILLE_REQUIRE(entry.under_way.has_value(), "a robot in the middle of a move");
  QUADRILLE_REQUIRE(std::isfinite(time.value()), "a moment");
  entry.under_way->begun = time;
  return *this;
}

Robot Robot::may_wait(bool may) const {
  Fleet::Entry& entry = fleet_->robots_[id_];
  QUADRILLE_REQUIRE(entry.under_way.has_value(), "a robot in the middle of a move");
  entry.under_way->may_wait = may;
  return *this;
}

Result<continuous::LanePlace> Fleet::lane_place(AgentId id, const continuous::Agent& agent,
                                                continuous::Ticks now) const {
  const UnderWay& where = *robots_[id].under_way;
  const std::string name = "'" + this->name(id) + "' ";
  if (!(where.fraction >= 0 && where.fraction <= 1))
    return out_of_range(name + "is under way with " + shortest(where.fraction) +
                        " of its move behind it, which is not from 0 to 1");
  const auto whole = lane_duration(*roadmap_.in_units(), agent, where.from, where.to);
  const std::string lane = roadmap_.name(where.from) + " to " + roadmap_.name(where.to);
  if (!whole)
    return out_of_range(name + "is under way from " + lane +
                        ", which takes it less than half a step of " +
                        to_string(roadmap_.resolution().time) + ", or too long");
  continuous::LanePlace place{VertexId(), where.from, where.to, 0, *whole};
  if (!where.begun) {
    place.behind = continuous::ticks_behind(where.fraction, *whole);
    return place;
  }
  const double behind =
      static_cast<double>(now.value()) - where.begun->value() / roadmap_.unit_sizes().time;
  const double nearest = std::round(behind);
  const double whole_ticks = std::abs(behind - nearest) < 1e-6 ? nearest : std::floor(behind);
  if (!(whole_ticks >= 0 && whole_ticks < static_cast<double>(whole->value())))
    return out_of_range(name + "began its move from " + lane + " at " + to_string(*where.begun) +
                        ", and is not within it at " + to_string(begin_) + ": it takes " +
                        to_string(in_seconds(*whole, roadmap_.unit_sizes())));
  place.behind = continuous::Ticks(static_cast<std::int64_t>(whole_ticks));
  return place;
}

// A vertex for each place in the middle of a move, with what is left of the move. Nobody else can
// be there.
Result<Fleet::Roads> Fleet::put_under_way(std::vector<continuous::Agent>& agents,
                                          continuous::Ticks now) const {
  const auto is_under_way = [](const Entry& robot) { return robot.under_way.has_value(); };
  if (std::none_of(robots_.begin(), robots_.end(), is_under_way)) return roadmap_.in_units();
  continuous::RoadmapParts parts(*roadmap_.in_units());
  for (const AgentId id : robot_ids()) {
    if (!is_under_way(robots_[id])) continue;
    const auto place = lane_place(id, agents[id.index()], now);
    if (!place) return place.error();
    agents[id.index()].start =
        continuous::add_lane_place(parts, place->from, place->to, place->whole, place->behind);
  }
  auto roads = std::move(parts).make();
  if (!roads) return roads.error();
  return std::make_shared<const continuous::Roadmap>(std::move(roads).value());
}

}  // namespace quadrille::fleet
