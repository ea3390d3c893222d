// SPDX-License-Identifier: MIT
#include "fleets/roadmap_fleet.hpp"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "fleets/dispatch_options.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/dispatch/simulation.hpp"

namespace quadrille::cli {
namespace {

using continuous::Instance;
using dispatch::Dispatcher;

class RoadmapFleet : public LiveFleet {
 public:
  RoadmapFleet(const Instance& instance, Dispatcher dispatcher)
      : instance_(instance), dispatcher_(std::move(dispatcher)) {}

  [[nodiscard]] std::size_t num_robots() const override { return dispatcher_.num_robots(); }
  [[nodiscard]] std::size_t num_vertices() const override {
    return instance_.roadmap().num_vertices();
  }
  [[nodiscard]] double tick_size() const override { return instance_.resolution().time; }
  [[nodiscard]] double units(Ticks time) const override {
    return continuous::in_input_units(time, instance_.resolution());
  }
  [[nodiscard]] std::optional<std::array<double, 2>> position(
      const dispatch::Spot& spot) const override {
    const auto& from = instance_.roadmap().position(spot.from);
    const auto& to = instance_.roadmap().position(spot.to);
    const double share =
        static_cast<double>(spot.behind.value()) / static_cast<double>(spot.whole.value());
    const auto at = [&](continuous::Length a, continuous::Length b) {
      return (static_cast<double>(a.value()) + share * static_cast<double>((b - a).value())) *
             instance_.resolution().length;
    };
    return std::array{at(from.x, to.x), at(from.y, to.y)};
  }
  [[nodiscard]] std::vector<Ticks> times_from(AgentId robot, VertexId start) const override;

  [[nodiscard]] std::optional<Error> assign(AgentId robot, const dispatch::Task& task) override {
    return dispatcher_.assign(robot, task);
  }
  [[nodiscard]] std::optional<Error> cancel(AgentId robot) override {
    return dispatcher_.cancel(robot);
  }
  [[nodiscard]] std::optional<Error> close(VertexId from, VertexId to) override {
    return dispatcher_.close(from, to);
  }
  [[nodiscard]] std::optional<Error> open(VertexId from, VertexId to) override {
    return dispatcher_.open(from, to);
  }
  [[nodiscard]] std::optional<Error> report(AgentId robot, Ticks clock) override {
    return dispatcher_.report(robot, clock);
  }
  [[nodiscard]] Result<dispatch::News> tick(Ticks duration, std::span<const AgentId> held,
                                            const Limits& limits) override {
    if (!held.empty())
      return refused("\"held\" is for grids; on roadmaps a robot that stands reports its clock");
    return dispatcher_.tick(duration, limits);
  }

  [[nodiscard]] dispatch::Course course(AgentId robot) const override {
    return dispatcher_.course(robot);
  }
  [[nodiscard]] Ticks clock(AgentId robot) const override { return dispatcher_.clock(robot); }
  [[nodiscard]] Ticks limit(AgentId robot) const override { return dispatcher_.limit(robot); }
  [[nodiscard]] Ticks now() const override { return dispatcher_.now(); }
  [[nodiscard]] std::size_t num_tasks(AgentId robot) const override {
    return dispatcher_.num_tasks(robot);
  }
  [[nodiscard]] execution::Precedences order() const override { return dispatcher_.order(); }

 private:
  const Instance& instance_;
  Dispatcher dispatcher_;
};

std::vector<dispatch::Ticks> RoadmapFleet::times_from(AgentId robot, VertexId start) const {
  constexpr Ticks kFar{std::numeric_limits<Ticks::Count>::max()};
  std::vector<Ticks> times(num_vertices(), kFar);
  using Entry = std::pair<Ticks, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  times[start.index()] = 0;
  open.emplace(Ticks{0}, start);
  const continuous::ClassId kind = instance_.class_of(robot);
  while (!open.empty()) {
    const auto [time, v] = open.top();
    open.pop();
    if (time > times[v.index()]) continue;
    for (const continuous::EdgeId e : instance_.out_edges(kind, v)) {
      const VertexId to = instance_.roadmap().edge(e).to;
      const Ticks then = time + instance_.duration(kind, e);
      if (then >= times[to.index()]) continue;
      times[to.index()] = then;
      open.emplace(then, to);
    }
  }
  return times;
}

Result<Dispatcher> dispatcher_for(const DispatchArguments& arguments, const Instance& instance) {
  const double tick = instance.resolution().time;
  dispatch::Options options;
  options.effort = effort_of(arguments);
  if (arguments.reach) options.reach = whole_ticks(*arguments.reach, tick);
  if (arguments.patience) options.patience = whole_ticks(*arguments.patience, tick);
  options.improves = !arguments.does_not_improve;
  return Dispatcher::make(instance, options);
}

}  // namespace

Result<std::unique_ptr<LiveFleet>> serve_on_roadmap(const DispatchArguments& arguments,
                                                    const input::RoadmapInput& input) {
  auto made = dispatcher_for(arguments, input.instance);
  if (!made) return made.error();
  return std::unique_ptr<LiveFleet>(
      std::make_unique<RoadmapFleet>(input.instance, std::move(made).value()));
}

DispatchWork work_on_roadmap(const input::RoadmapInput& input) {
  DispatchWork work;
  for (const continuous::Agent& agent : input.instance.agents())
    work.own.push_back({agent.goals, 0, agent.deadline});
  work.tasks = input.tasks;
  work.num_revealed = input.num_revealed;
  work.tick_size = input.instance.resolution().time;
  work.position = [&roadmap = input.instance.roadmap()](VertexId v) {
    return std::array{static_cast<double>(roadmap.position(v).x.value()),
                      static_cast<double>(roadmap.position(v).y.value())};
  };
  return work;
}

std::optional<Error> run_on_roadmap(const DispatchArguments& arguments,
                                    const input::RoadmapInput& input, DispatchRun& run) {
  const Instance& instance = input.instance;
  auto dispatcher = dispatcher_for(arguments, instance);
  if (!dispatcher) return dispatcher.error();
  std::optional<dispatch::Simulation> simulation;
  return run.run(
      {[&](AgentId robot, const dispatch::Task& task) { return dispatcher->assign(robot, task); },
       [&](AgentId robot) { return dispatcher->course(robot).back().spot.to; },
       [&](const dispatch::SimulationOptions& options) {
         simulation.emplace(
             *dispatcher, instance.shared_roadmap(),
             std::vector<continuous::Agent>(instance.agents().begin(), instance.agents().end()),
             options);
       },
       [&](const Limits& limits) { return simulation->step(limits); },
       [&] { return simulation->num_contacts(); }, [&] { return simulation->service_times(); }});
}

}  // namespace quadrille::cli
