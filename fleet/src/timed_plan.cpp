// SPDX-License-Identifier: MIT
#include "quadrille/fleet/timed_plan.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "conversions.hpp"
#include "lane_duration.hpp"
#include "quadrille/continuous/free_cost.hpp"

namespace quadrille::fleet {

/// The last stop that has begun; the first one before the plan begins.
std::size_t TimedPath::stop_at(Seconds time) const {
  const auto later = std::upper_bound(stops_.begin() + 1, stops_.end(), time,
                                      [](Seconds t, const Stop& stop) { return t < stop.arrive; });
  return static_cast<std::size_t>(std::distance(stops_.begin(), later)) - 1;
}

/// `stop` is stop_at(time).
Sample TimedPath::sample(std::size_t stop, Seconds time) const {
  const Stop& from = stops_[stop];
  if (stop + 1 == stops_.size() || time < from.depart) return {time, from.place, {}};
  const Stop& to = stops_[stop + 1];
  const Seconds duration = to.arrive - from.depart;
  const double share = (time - from.depart) / duration;
  const Metres dx = to.place.x - from.place.x, dy = to.place.y - from.place.y,
               dz = to.place.z - from.place.z;
  return {time,
          {from.place.x + share * dx, from.place.y + share * dy, from.place.z + share * dz},
          {dx / duration, dy / duration, dz / duration}};
}

Point TimedPath::at(Seconds time) const { return sample(stop_at(time), time).position; }

Velocity TimedPath::velocity(Seconds time) const { return sample(stop_at(time), time).velocity; }

std::vector<Sample> TimedPath::samples(Hertz rate) const {
  return samples(rate, stops_.back().arrive);
}

std::vector<Sample> TimedPath::samples(Hertz rate, Seconds until) const {
  QUADRILLE_REQUIRE(rate.value() > 0 && std::isfinite(rate.value()), "a positive rate");
  QUADRILLE_REQUIRE(std::isfinite(until.value()), "an end");
  std::vector<Sample> samples;
  std::size_t stop = 0;
  for (std::size_t k = 0;; ++k) {
    // A quotient, not a sum of many: 0.3 s at 10 Hz is the same number as the 0.3 s of a stop.
    const Seconds time = stops_.front().arrive + Seconds(static_cast<double>(k) / rate.value());
    while (stop + 1 < stops_.size() && stops_[stop + 1].arrive <= time) ++stop;
    samples.push_back(sample(stop, time));
    if (time >= until) return samples;
  }
}

std::vector<Wait> TimedPath::waits() const {
  std::vector<Wait> waits;
  for (const Stop& stop : stops_)
    if (stop.depart > stop.arrive) waits.push_back({stop.vertex, stop.arrive, stop.depart});
  return waits;
}

Result<TimedPlan> TimedPlan::make(const Fleet& fleet, const continuous::Plan& plan) {
  const auto report = verify(fleet, plan);
  if (!report) return report.error();
  if (!report->valid())
    return Error{ErrorCode::invalid_plan, report->violations.front().message, {}};
  auto instance = fleet.instance();
  if (!instance) return instance.error();
  const continuous::Resolution resolution = instance->resolution();
  const auto seconds = [&](auto time) { return in_seconds(time, resolution); };

  State state{std::move(instance).value(), plan, {}, {}, {}, {}, std::nullopt};
  Cost all_delays = 0;
  for (const AgentId i : fleet.robot_ids()) {
    TimedPath path;
    path.name_ = fleet.name(i);
    for (const continuous::Stop& stop : plan.paths[i])
      path.stops_.push_back({stop.vertex,
                             in_metres(state.instance.roadmap().position(stop.vertex), resolution),
                             seconds(stop.arrive), seconds(stop.depart)});
    const Cost cost = continuous::cost(plan.paths[i]);
    if (const auto* place = state.instance.roadmap().lane_place(plan.paths[i].front().vertex))
      path.under_way_ = UnderWay{
          place->from,
          place->to,
          static_cast<double>(place->behind.value()) / static_cast<double>(place->whole.value()),
          {},
          fleet.under_way(i)->may_wait};
    // There is a way to the goal: the plan takes one.
    const Cost free = continuous::as_cost(continuous::free_cost(state.instance, i).value());
    path.cost_ = seconds(cost);
    path.free_cost_ = seconds(free);
    path.delay_ = seconds(cost - free);
    all_delays += cost - free;
    state.paths.push_back(std::move(path));
  }
  state.sum_of_costs = seconds(continuous::cost(plan, Objective::sum_of_costs));
  state.makespan = seconds(continuous::cost(plan, Objective::makespan));
  state.delay = seconds(all_delays);
  if (!report->clearances.empty()) state.least_clearance = report->clearances.front();
  return TimedPlan(std::make_shared<const State>(std::move(state)));
}

namespace {

/// A body that turns with its robot, as one that does not: the disc around all its headings.
Body without_heading(const Polygon& polygon) {
  Metres reach{};
  for (const Point& corner : polygon.corners) reach = std::max(reach, distance({}, corner));
  return Disc(reach);
}

}  // namespace

std::optional<MovingObstacle> as_obstacle(const Fleet& fleet, const TimedPlan& plan,
                                          AgentId robot) {
  MovingObstacle obstacle{plan[robot].name(), fleet.spec(robot).body, {}, fleet.leaves(robot)};
  const auto* polygon = std::get_if<Polygon>(&obstacle.body);
  if (polygon != nullptr && fleet.roadmap().turns() != nullptr)
    obstacle.body = without_heading(*polygon);
  for (const Stop& stop : plan[robot].stops())
    obstacle.path.push_back({stop.place, stop.arrive, stop.depart});
  if (obstacle.leaves && plan[robot].cost() == Seconds(0)) return std::nullopt;
  return obstacle;
}

std::string TimedPlan::summary() const {
  std::string text;
  for (const TimedPath& path : state_->paths) {
    text += path.name() + ": " + to_string(path.cost());
    if (path.delay() > Seconds(0)) text += ", " + to_string(path.delay()) + " more than alone";
    const std::size_t num_waits = path.waits().size();
    if (num_waits > 0)
      text += ", " + std::to_string(num_waits) + (num_waits == 1 ? " wait" : " waits");
    text += "\n";
  }
  return text + "sum of costs " + to_string(sum_of_costs()) + ", makespan " +
         to_string(makespan()) + ", delay " + to_string(delay()) + "\n";
}

}  // namespace quadrille::fleet
