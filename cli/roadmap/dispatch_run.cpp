// SPDX-License-Identifier: MIT
#include "roadmap/dispatch_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "answers/report.hpp"
#include "roadmap/dispatch_options.hpp"

namespace quadrille::cli {

using dispatch::Dispatcher;
using dispatch::Task;

DispatchRun::DispatchRun(const DispatchArguments& arguments, const input::RoadmapInput& input)
    : arguments_(arguments), input_(input), instance_(input.instance) {
  const continuous::Resolution& sizes = instance_.resolution();
  options_.step = whole_ticks(arguments.step.value_or(1), sizes);
  options_.pause_chance = arguments.pauses.value_or(0);
  options_.longest_pause = whole_ticks(arguments.longest.value_or(3), sizes);
  if (arguments.service.value_or(0) > 0) options_.service = whole_ticks(*arguments.service, sizes);
  options_.has_random_tasks = !arguments.has_own_tasks && input.tasks.empty();
  options_.seed = static_cast<std::uint64_t>(arguments.seed.value_or(0));
  report_.robots = instance_.num_agents();
  report_.seed = options_.seed;
  work_.resize(instance_.num_agents());
  if (!arguments.has_own_tasks)
    for (std::size_t k = 0; k < input.tasks.size(); ++k) open_.push_back(k);
}

double DispatchRun::units(Ticks ticks) const {
  return static_cast<double>(ticks.value()) * instance_.resolution().time;
}

std::optional<Error> DispatchRun::run() {
  const auto& given = instance_.agents();
  const std::vector<continuous::Agent> robots(given.begin(), given.end());
  auto dispatcher = Dispatcher::make(instance_.shared_roadmap(), robots, instance_.resolution(),
                                     dispatcher_options(arguments_, instance_.resolution()));
  if (!dispatcher) return dispatcher.error();
  if (arguments_.has_own_tasks)
    if (auto error = assign_own_tasks(*dispatcher)) return error;
  Ticks now = 0;
  if (!open_.empty())
    options_.next_tasks = [&](AgentId robot) { return next_task(*dispatcher, robot, now); };
  if (!arguments_.view.empty())
    options_.watch = [&](Ticks time, const std::vector<dispatch::Place>& seen) {
      for (std::size_t i = 0; i < seen.size(); ++i)
        recorder_.add(i, time.value(), {seen[i].x, seen[i].y, seen[i].z});
    };
  dispatch::Simulation simulation(*dispatcher, instance_.shared_roadmap(), robots, options_);
  Limits limits;
  limits.wall_s = arguments_.wall;
  const std::size_t all = arguments_.has_own_tasks ? robots.size() : input_.tasks.size();
  const std::int64_t steps = arguments_.steps.value_or(kDispatchSteps);
  for (std::int64_t step = 0; step < steps; ++step) {
    const double before = wall_seconds();
    const dispatch::News news = simulation.step(limits);
    add(news, wall_seconds() - before, now);
    now = simulation.time();
    if (!options_.has_random_tasks && report_.served == all) break;
  }
  report_.contacts = simulation.num_contacts();
  if (options_.has_random_tasks || arguments_.has_own_tasks)
    for (const Ticks time : simulation.service_times())
      report_.service_times.push_back(units(time));
  report_.time = units(simulation.time());
  return std::nullopt;
}

std::optional<Error> DispatchRun::assign_own_tasks(Dispatcher& dispatcher) const {
  for (const AgentId robot : instance_.agent_ids()) {
    const continuous::Agent& agent = instance_.agent(robot);
    if (auto error = dispatcher.assign(robot, {agent.goals, options_.service, agent.deadline}))
      return error;
  }
  return std::nullopt;
}

std::vector<Task> DispatchRun::next_task(const Dispatcher& dispatcher, AgentId robot, Ticks now) {
  const double revealed = input_.num_revealed * static_cast<double>(work_.size());
  const std::size_t known =
      std::min(open_.size(), static_cast<std::size_t>(std::max(1.0, std::ceil(revealed))));
  const auto& roadmap = instance_.roadmap();
  const auto& here = roadmap.position(dispatcher.course(robot).back().spot.to);
  std::size_t nearest = known;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < known; ++k) {
    const auto& there = roadmap.position(input_.tasks[open_[k]].front().vertices().front());
    const double way = std::abs(static_cast<double>((there.x - here.x).value())) +
                       std::abs(static_cast<double>((there.y - here.y).value()));
    if (way >= least) continue;
    least = way;
    nearest = k;
  }
  std::vector<Task> errands;
  if (nearest == known) return errands;
  for (const Goals& goals : input_.tasks[open_[nearest]])
    errands.push_back({goals, options_.service, {}});
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(nearest));
  work_[robot.index()] = {errands.size(), now};
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
  Work& work = work_[robot.index()];
  if (work.errands > 1) {
    --work.errands;
    return;
  }
  ++report_.served;
  if (work.errands == 0) return;  // Of tasks of one errand the simulation keeps the times.
  work.errands = 0;
  report_.service_times.push_back(units(now - work.since));
}

}  // namespace quadrille::cli
