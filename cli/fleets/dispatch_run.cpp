// SPDX-License-Identifier: MIT
#include "fleets/dispatch_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "answers/report.hpp"
#include "fleets/dispatch_options.hpp"

namespace quadrille::cli {

using dispatch::Task;

DispatchRun::DispatchRun(const DispatchArguments& arguments, DispatchWork work)
    : arguments_(arguments), work_(std::move(work)), errands_(work_.own.size()) {
  const double tick = work_.tick_size;
  options_.step = whole_ticks(arguments.step.value_or(1), tick);
  options_.pause_chance = arguments.pauses.value_or(0);
  options_.longest_pause = whole_ticks(arguments.longest.value_or(3), tick);
  if (arguments.service) options_.service = whole_ticks(*arguments.service, tick);
  options_.has_random_tasks = !arguments.has_own_tasks && work_.tasks.empty();
  options_.seed = static_cast<std::uint64_t>(arguments.seed.value_or(0));
  report_.robots = work_.own.size();
  report_.seed = options_.seed;
  report_.is_on_grid = work_.is_on_grid;
  if (!arguments.has_own_tasks)
    for (std::size_t k = 0; k < work_.tasks.size(); ++k) open_.push_back(k);
}

std::optional<Error> DispatchRun::run(const Fleet& fleet) {
  if (arguments_.has_own_tasks)
    if (auto error = assign_own_tasks(fleet)) return error;
  Ticks now = 0;
  if (!open_.empty())
    options_.next_tasks = [&](AgentId robot) { return next_task(robot, fleet.end(robot), now); };
  if (!arguments_.view.empty())
    options_.watch = [&](Ticks time, const std::vector<dispatch::Place>& seen) {
      for (std::size_t i = 0; i < seen.size(); ++i)
        recorder_.add(i, time.value(), {seen[i].x, seen[i].y, seen[i].z});
    };
  fleet.begin(options_);
  Limits limits;
  limits.wall_s = arguments_.wall;
  const std::size_t all = arguments_.has_own_tasks ? work_.own.size() : work_.tasks.size();
  const std::int64_t steps = arguments_.steps.value_or(kDispatchSteps);
  for (std::int64_t step = 0; step < steps; ++step) {
    const double before = wall_seconds();
    const dispatch::News news = fleet.step(limits);
    add(news, wall_seconds() - before, now);
    now += options_.step;
    if (!options_.has_random_tasks && report_.served == all) break;
  }
  report_.contacts = fleet.num_contacts();
  if (options_.has_random_tasks || arguments_.has_own_tasks)
    for (const Ticks time : fleet.service_times()) report_.service_times.push_back(units(time));
  report_.time = units(now);
  return std::nullopt;
}

std::optional<Error> DispatchRun::assign_own_tasks(const Fleet& fleet) const {
  for (std::size_t i = 0; i < work_.own.size(); ++i) {
    Task task = work_.own[i];
    task.service = options_.service;
    if (auto error = fleet.assign(AgentId(i), task)) return error;
  }
  return std::nullopt;
}

std::vector<Task> DispatchRun::next_task(AgentId robot, VertexId here, Ticks now) {
  const double revealed = work_.num_revealed * static_cast<double>(errands_.size());
  const std::size_t known =
      std::min(open_.size(), static_cast<std::size_t>(std::max(1.0, std::ceil(revealed))));
  const auto from = work_.position(here);
  std::size_t nearest = known;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < known; ++k) {
    const auto to = work_.position(work_.tasks[open_[k]].front().vertices().front());
    const double way = std::abs(to[0] - from[0]) + std::abs(to[1] - from[1]);
    if (way >= least) continue;
    least = way;
    nearest = k;
  }
  std::vector<Task> errands;
  if (nearest == known) return errands;
  for (const Goals& goals : work_.tasks[open_[nearest]])
    errands.push_back({goals, options_.service, {}});
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(nearest));
  errands_[robot.index()] = {errands.size(), now};
  return errands;
}

void DispatchRun::add(const dispatch::News& news, double seconds, Ticks now) {
  for (const AgentId robot : news.served) serve(robot, now);
  report_.waiting += news.num_waiting;
  report_.origins += news.has_new_origin ? 1 : 0;
  report_.too_late += news.was_too_late ? 1 : 0;
  report_.call_seconds.push_back(seconds);
  report_.call_gaps.push_back(0);
  if (news.lower_bound == 0) return;
  report_.call_gaps.back() = 100 * static_cast<double>(news.cost - news.lower_bound) /
                             static_cast<double>(news.lower_bound);
  report_.gaps.push_back(report_.call_gaps.back());
}

/// An errand is done, and with the last one the task.
void DispatchRun::serve(AgentId robot, Ticks now) {
  Errands& errands = errands_[robot.index()];
  if (errands.left > 1) {
    --errands.left;
    return;
  }
  ++report_.served;
  if (errands.left == 0) return;  // Of tasks of one errand the simulation keeps the times.
  errands.left = 0;
  report_.service_times.push_back(units(now - errands.since));
}

}  // namespace quadrille::cli
