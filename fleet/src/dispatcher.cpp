// SPDX-License-Identifier: MIT
#include "quadrille/fleet/dispatcher.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "conversions.hpp"

namespace quadrille::fleet {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

/// Nominal, in elementary steps.
Effort effort_of(Seconds effort) {
  const double nanoseconds = std::clamp(1e9 * effort.value(), 0.0, 1e18);
  return Effort::nanoseconds(static_cast<std::int64_t>(nanoseconds));
}

}  // namespace

Result<Dispatcher> Dispatcher::make(const Fleet& fleet, DispatchOptions options) {
  Fleet standing = fleet;
  for (const auto& [from, to] : fleet.closed_lanes())
    if (auto error = standing.open(from, to)) return *std::move(error);
  for (const AgentId robot : fleet.robot_ids()) {
    const std::string name = "'" + fleet.name(robot) + "' ";
    if (fleet.under_way(robot)) return invalid(name + "begins in the middle of a move");
    if (fleet.release(robot) > fleet.begin())
      return invalid(name + "is released later: assign its task then");
    if (fleet.leaves(robot)) return invalid(name + "leaves at its goal: robots stay in the fleet");
    if (const auto start = fleet.start(robot)) standing[robot].to(*start);
    standing[robot].deadline({});
  }
  const auto instance = standing.instance();
  if (!instance) return instance.error();
  const double tick = fleet.roadmap().resolution().time.value();
  const auto ticks = [&](Seconds time) {
    return continuous::Ticks(static_cast<std::int64_t>(std::ceil(time.value() / tick - 1e-9)));
  };
  dispatch::Options made;
  made.effort = effort_of(options.effort);
  made.reach = ticks(options.reach);
  made.patience = ticks(options.patience);
  made.improves = options.improves;
  auto dispatcher = dispatch::Dispatcher::make(*instance, made);
  if (!dispatcher) return dispatcher.error();
  std::vector<std::string> names;
  for (const AgentId robot : fleet.robot_ids()) names.push_back("'" + fleet.name(robot) + "'");
  Dispatcher live(fleet.roadmap(), std::move(names), std::move(dispatcher).value());
  for (const AgentId robot : fleet.robot_ids())
    if (const auto& goals = fleet.goals(robot))
      if (auto error = live.assign(robot, {goals->vertices().begin(), goals->vertices().end()},
                                   {.deadline = fleet.deadline(robot)}))
        return *std::move(error);
  for (const auto& [from, to] : fleet.closed_lanes())
    if (auto error = live.close(from, to)) return *std::move(error);
  return live;
}

Seconds Dispatcher::seconds(continuous::Ticks ticks) const {
  return in_seconds(ticks, roadmap_.unit_sizes());
}

std::optional<Error> Dispatcher::assign(AgentId robot, std::vector<VertexId> goals, TaskSpec spec) {
  const auto time = [&](Seconds given) {
    return continuous::quantise_time(given.value(), roadmap_.unit_sizes());
  };
  dispatch::Task task{Goals(std::move(goals)), {}, {}};
  const auto service = time(spec.service);
  if (service) task.service = *service;
  if (spec.deadline) task.deadline = time(*spec.deadline);
  if (robot.index() < names_.size() && (!service || (spec.deadline && !task.deadline)))
    return out_of_range("the task of " + names_[robot.index()] +
                        " has a time that is negative or too long");
  return dispatcher_.assign(robot, std::move(task));
}

std::optional<Error> Dispatcher::cancel(AgentId robot) { return dispatcher_.cancel(robot); }

std::optional<Error> Dispatcher::close(VertexId from, VertexId to) {
  return dispatcher_.close(from, to);
}
std::optional<Error> Dispatcher::open(VertexId from, VertexId to) {
  return dispatcher_.open(from, to);
}

std::optional<Error> Dispatcher::report(AgentId robot, Seconds clock) {
  // What differs from a whole step by a millionth of one is meant to be that.
  const double ticks = std::floor(clock.value() / roadmap_.resolution().time.value() + 1e-6);
  if (!(std::abs(ticks) < 1e18)) return out_of_range("a clock shows " + to_string(clock));
  auto error = dispatcher_.report(robot, continuous::Ticks(static_cast<std::int64_t>(ticks)));
  if (!error || robot.index() >= names_.size()) return error;
  const std::string& name = names_[robot.index()];
  if (clock < this->clock(robot))
    return out_of_range("the clock of " + name + " goes back from " +
                        to_string(this->clock(robot)) + " to " + to_string(clock));
  return out_of_range(name + " has gone on to " + to_string(clock) + ", and was allowed to go to " +
                      to_string(limit(robot)));
}

Orders Dispatcher::tick(Seconds duration, std::optional<Seconds> wall) {
  QUADRILLE_REQUIRE(duration > Seconds(0), "time goes on");
  const double steps = std::ceil(duration.value() / roadmap_.resolution().time.value() - 1e-6);
  quadrille::Limits limits;
  if (wall) limits.wall_s = wall->value();
  const dispatch::News news =
      dispatcher_.tick(continuous::Ticks(static_cast<std::int64_t>(std::max(steps, 1.0))), limits);
  Orders orders;
  orders.served = news.served;
  orders.num_waiting = news.num_waiting;
  orders.has_new_plan = news.has_new_plan;
  orders.cost = in_seconds(news.cost, roadmap_.unit_sizes());
  orders.lower_bound = in_seconds(news.lower_bound, roadmap_.unit_sizes());
  return orders;
}

Seconds Dispatcher::clock(AgentId robot) const { return seconds(dispatcher_.clock(robot)); }
Seconds Dispatcher::limit(AgentId robot) const { return seconds(dispatcher_.limit(robot)); }
Seconds Dispatcher::now() const { return seconds(dispatcher_.now()); }
std::size_t Dispatcher::num_tasks(AgentId robot) const { return dispatcher_.num_tasks(robot); }

std::vector<CourseStop> Dispatcher::course(AgentId robot) const {
  std::vector<CourseStop> stops;
  for (const dispatch::Stop& stop : dispatcher_.course(robot)) {
    CourseStop made{stop.spot.from, {}, 0, seconds(stop.arrive), seconds(stop.depart)};
    if (!stop.spot.is_vertex()) {
      made.to = stop.spot.to;
      made.fraction = static_cast<double>(stop.spot.behind.value()) /
                      static_cast<double>(stop.spot.whole.value());
    }
    stops.push_back(made);
  }
  return stops;
}

Point Dispatcher::at(AgentId robot, Seconds clock) const {
  const double ticks = clock.value() / roadmap_.resolution().time.value();
  const auto before = continuous::Ticks(static_cast<std::int64_t>(std::floor(ticks)));
  const auto place = [&](continuous::Ticks tick) {
    const dispatch::Spot spot = dispatch::spot_at(dispatcher_.course(robot), tick);
    const Point from = roadmap_.position(spot.from), to = roadmap_.position(spot.to);
    const double share =
        static_cast<double>(spot.behind.value()) / static_cast<double>(spot.whole.value());
    return Point{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                 from.z + share * (to.z - from.z)};
  };
  const Point here = place(before), next = place(before + 1);
  const double share = ticks - std::floor(ticks);
  return {here.x + share * (next.x - here.x), here.y + share * (next.y - here.y),
          here.z + share * (next.z - here.z)};
}

}  // namespace quadrille::fleet
