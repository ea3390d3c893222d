// SPDX-License-Identifier: MIT
#include "fleets/grid_fleet.hpp"

#include <limits>
#include <utility>

#include "fleets/dispatch_options.hpp"
#include "quadrille/dispatch/grid_simulation.hpp"

namespace quadrille::cli {
namespace {

using dispatch::GridDispatcher;

class GridFleet : public LiveFleet {
 public:
  GridFleet(const discrete::Graph& graph, GridDispatcher dispatcher)
      : graph_(graph), dispatcher_(std::move(dispatcher)) {}

  [[nodiscard]] std::size_t num_robots() const override { return dispatcher_.num_robots(); }
  [[nodiscard]] std::size_t num_vertices() const override { return graph_.num_vertices(); }
  [[nodiscard]] double tick_size() const override { return 1; }
  [[nodiscard]] double units(Ticks time) const override {
    return static_cast<double>(time.value());
  }
  [[nodiscard]] std::optional<std::array<double, 2>> position(
      const dispatch::Spot& spot) const override {
    if (!graph_.layout()) return std::nullopt;
    const discrete::Cell cell = graph_.layout()->cell_of(spot.from);
    return std::array{static_cast<double>(cell.x), static_cast<double>(cell.y)};
  }
  [[nodiscard]] std::vector<Ticks> times_from(AgentId, VertexId start) const override {
    std::vector<Ticks> times;
    for (const Timestep moves : discrete::distances_from(graph_, start))
      times.push_back(moves == discrete::kUnreachable
                          ? Ticks{std::numeric_limits<Ticks::Count>::max()}
                          : Ticks(std::int64_t{moves}));
    return times;
  }

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
  /// Where it is told to be, it is.
  [[nodiscard]] std::optional<Error> report(AgentId, Ticks) override { return std::nullopt; }
  [[nodiscard]] Result<dispatch::News> tick(Ticks duration, std::span<const AgentId> held,
                                            const Limits& limits) override {
    if (duration != 1) return refused("\"duration\": on a grid or graph a call is one timestep");
    return dispatcher_.tick(held, limits);
  }

  [[nodiscard]] dispatch::Course course(AgentId robot) const override {
    dispatch::Course course;
    Ticks time = now();
    for (const VertexId v : dispatcher_.path(robot)) {
      if (course.empty() || course.back().spot.from != v) course.push_back({v, time, time});
      course.back().depart = time;
      time += 1;
    }
    // It may stay there for ever, as far as one knows.
    course.back().depart = course.back().arrive;
    return course;
  }
  [[nodiscard]] Ticks clock(AgentId) const override { return now(); }
  [[nodiscard]] Ticks limit(AgentId) const override { return now(); }
  [[nodiscard]] Ticks now() const override { return Ticks(std::int64_t{dispatcher_.now()}); }
  [[nodiscard]] std::size_t num_tasks(AgentId robot) const override {
    return dispatcher_.num_tasks(robot);
  }
  [[nodiscard]] execution::Precedences order() const override { return dispatcher_.order(); }

 private:
  const discrete::Graph& graph_;
  GridDispatcher dispatcher_;
};

Result<GridDispatcher> dispatcher_for(const DispatchArguments& arguments,
                                      const input::GridInput& input) {
  if (auto error = input::refuse_rules(input)) return *error;
  dispatch::GridOptions options;
  options.effort = effort_of(arguments);
  options.window = static_cast<Timestep>(arguments.window.value_or(options.window));
  options.improves = !arguments.does_not_improve;
  std::vector<VertexId> places;
  for (const discrete::Agent& agent : input.instance.agents()) places.push_back(agent.start);
  return GridDispatcher::make(input.instance.shared_graph(), std::move(places), options);
}

}  // namespace

Result<std::unique_ptr<LiveFleet>> serve_on_grid(const DispatchArguments& arguments,
                                                 const input::GridInput& input) {
  auto made = dispatcher_for(arguments, input);
  if (!made) return made.error();
  return std::unique_ptr<LiveFleet>(
      std::make_unique<GridFleet>(input.instance.graph(), std::move(made).value()));
}

DispatchWork work_on_grid(const input::GridInput& input) {
  DispatchWork work;
  for (const discrete::Agent& agent : input.instance.agents()) work.own.push_back({agent.goals});
  work.tasks = input.tasks;
  work.num_revealed = input.num_revealed;
  work.is_on_grid = true;
  work.position = [&graph = input.instance.graph()](VertexId v) {
    const discrete::Cell cell = graph.layout()->cell_of(v);
    return std::array{static_cast<double>(cell.x), static_cast<double>(cell.y)};
  };
  return work;
}

std::optional<Error> run_on_grid(const DispatchArguments& arguments, const input::GridInput& input,
                                 DispatchRun& run) {
  auto dispatcher = dispatcher_for(arguments, input);
  if (!dispatcher) return dispatcher.error();
  std::optional<dispatch::GridSimulation> simulation;
  return run.run(
      {[&](AgentId robot, const dispatch::Task& task) { return dispatcher->assign(robot, task); },
       [&](AgentId robot) { return dispatcher->place(robot); },
       [&](const dispatch::SimulationOptions& options) {
         simulation.emplace(*dispatcher, input.instance.shared_graph(), options);
       },
       [&](const Limits& limits) { return simulation->step(limits); },
       [&] { return simulation->num_contacts(); }, [&] { return simulation->service_times(); }});
}

}  // namespace quadrille::cli
