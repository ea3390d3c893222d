// SPDX-License-Identifier: MIT
// Live fleets on grids and graphs.
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "news.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/dispatch/grid_dispatcher.hpp"
#include "steps.hpp"

namespace quadrille::python {
namespace {

using discrete::Graph;
using dispatch::Ticks;

/// Places are vertices, or cells (x, y), in arrays of whole numbers.
class GridDispatching {
 public:
  GridDispatching(const discrete::Instance& fleet, double effort, Timestep window,
                  std::uint64_t seed, bool improves)
      : graph_(fleet.shared_graph()) {
    if (!fleet.is_plain())
      refuse(
          "agents that are sent about know no rules: releases, deadlines, obstacles and the like");
    if (fleet.now() != 0) refuse("agents that are sent about on a grid begin at timestep 0");
    dispatch::GridOptions options;
    options.effort = Effort::nanoseconds(static_cast<std::int64_t>(1e9 * effort));
    options.window = window;
    options.seed = seed;
    options.improves = improves;
    std::vector<VertexId> places;
    for (const discrete::Agent& agent : fleet.agents()) places.push_back(agent.start);
    dispatcher_ = std::make_unique<dispatch::GridDispatcher>(
        take(dispatch::GridDispatcher::make(graph_, std::move(places), options)));
    for (const AgentId i : fleet.agent_ids()) {
      const discrete::Agent& agent = fleet.agents()[i];
      if (agent.goals.vertices().size() == 1 && agent.goals.contains(agent.start)) continue;
      check(dispatcher_->assign(i, {agent.goals}));
    }
  }

  [[nodiscard]] std::size_t size() const { return dispatcher_->num_robots(); }
  void assign(std::size_t robot, const Ints& goals, std::int64_t service,
              const std::optional<std::int64_t>& deadline) {
    const auto count = static_cast<std::size_t>(goals.shape(0));
    if (count == 0) refuse("goals: there is none");
    std::vector<VertexId> vertices;
    for (std::size_t k = 0; k < count; ++k)
      vertices.push_back(vertex_of(*graph_, goals.data() + k * place_size(*graph_), "goals"));
    dispatch::Task task{Goals(std::move(vertices)), Ticks(service), {}};
    if (deadline) task.deadline = Ticks(*deadline);
    check(dispatcher_->assign(AgentId(robot), task));
  }
  void cancel(std::size_t robot) { check(dispatcher_->cancel(AgentId(robot))); }
  void close(const Ints& ends) { check(dispatcher_->close(end(ends, 0), end(ends, 1))); }
  void open(const Ints& ends) { check(dispatcher_->open(end(ends, 0), end(ends, 1))); }

  py::dict tick(const std::vector<std::size_t>& held, const std::optional<double>& wall) {
    std::vector<AgentId> robots;
    for (const std::size_t robot : held) robots.emplace_back(robot);
    quadrille::Limits limits;
    limits.wall_s = wall;
    return told_of([&] { return dispatcher_->tick(robots, limits); },
                   [](Cost cost) { return static_cast<double>(cost); });
  }

  [[nodiscard]] Timestep now() const { return dispatcher_->now(); }
  [[nodiscard]] execution::Precedences order() const { return dispatcher_->order(); }
  [[nodiscard]] std::size_t num_tasks(std::size_t robot) const {
    return dispatcher_->num_tasks(AgentId(robot));
  }
  [[nodiscard]] py::array places() const {
    discrete::Path path;
    for (std::size_t i = 0; i < size(); ++i) path.push_back(dispatcher_->place(AgentId(i)));
    return array_of(path);
  }
  [[nodiscard]] py::array path(std::size_t robot) const {
    return array_of(dispatcher_->path(AgentId(robot)));
  }

 private:
  [[nodiscard]] VertexId end(const Ints& ends, std::size_t at) const {
    return vertex_of(*graph_, ends.data() + at * place_size(*graph_), "edge");
  }
  [[nodiscard]] py::array array_of(const discrete::Path& path) const {
    auto array = graph_->layout() ? new_array<std::int32_t>({path.size(), 2})
                                  : new_array<std::int32_t>({path.size()});
    std::int32_t* place = array.mutable_data();
    for (const VertexId v : path) {
      write_place(*graph_, v, place);
      place += place_size(*graph_);
    }
    return frozen(array);
  }

  std::shared_ptr<const Graph> graph_;
  std::unique_ptr<dispatch::GridDispatcher> dispatcher_;
};

}  // namespace

void bind_grid_dispatching(py::module_& module) {
  py::class_<GridDispatching>(module, "GridDispatcher")
      .def(py::init<const discrete::Instance&, double, Timestep, std::uint64_t, bool>())
      .def("__len__", &GridDispatching::size)
      .def("assign", &GridDispatching::assign)
      .def("cancel", &GridDispatching::cancel)
      .def("close", &GridDispatching::close)
      .def("open", &GridDispatching::open)
      .def("tick", &GridDispatching::tick)
      .def("now", &GridDispatching::now)
      .def("order", &GridDispatching::order)
      .def("num_tasks", &GridDispatching::num_tasks)
      .def("places", &GridDispatching::places)
      .def("path", &GridDispatching::path);
}

}  // namespace quadrille::python
