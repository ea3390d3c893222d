// SPDX-License-Identifier: MIT
// Live fleets.
#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "news.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/core/decimal.hpp"
#include "quadrille/dispatch/dispatcher.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

using continuous::Ticks;

/// In the units of the fleet.
class Dispatching {
 public:
  Dispatching(const TimedInstance& fleet, double effort, double reach, double patience,
              bool improves)
      : resolution_(fleet.resolution()) {
    dispatch::Options options;
    options.effort = Effort::nanoseconds(static_cast<std::int64_t>(1e9 * effort));
    options.reach = ticks(reach, "reach", true);
    options.patience = ticks(patience, "patience", true);
    options.improves = improves;
    dispatcher_ = std::make_unique<dispatch::Dispatcher>(
        take(dispatch::Dispatcher::make(fleet.instance(), options)));
    for (const AgentId i : fleet.instance().agent_ids()) {
      const continuous::Agent& agent = fleet.instance().agent(i);
      if (agent.goals == Goals(agent.start)) continue;
      check(dispatcher_->assign(i, {agent.goals, 0, agent.deadline}));
    }
  }

  [[nodiscard]] std::size_t size() const { return dispatcher_->num_robots(); }

  void assign(std::size_t robot, const std::vector<std::int64_t>& goals, double service,
              const std::optional<double>& deadline) {
    std::vector<VertexId> vertices;
    // The dispatcher says which of them there are not.
    for (const std::int64_t goal : goals)
      vertices.push_back(vertex_of(goal, std::size_t{1} << 31U, "goals"));
    if (vertices.empty()) refuse("goals: there is none");
    dispatch::Task task{Goals(std::move(vertices)), ticks(service, "service", true), {}};
    if (deadline) task.deadline = ticks(*deadline, "deadline", false);
    check(dispatcher_->assign(AgentId(robot), std::move(task)));
  }
  void cancel(std::size_t robot) { check(dispatcher_->cancel(AgentId(robot))); }
  /// Lanes from one vertex to another one.
  void close(std::int64_t from, std::int64_t to) {
    check(dispatcher_->close(vertex(from), vertex(to)));
  }
  void open(std::int64_t from, std::int64_t to) {
    check(dispatcher_->open(vertex(from), vertex(to)));
  }
  void report(std::size_t robot, double clock) {
    // What differs from a whole tick by a millionth of one is meant to be that.
    const double whole = std::floor(clock / resolution_.time + 1e-6);
    if (!(std::abs(whole) < 1e18)) refuse("clock: " + decimal(clock) + " is no time");
    const Ticks tick(static_cast<std::int64_t>(whole));
    check(dispatcher_->report(AgentId(robot), tick));
  }

  py::dict tick(double duration, const std::optional<double>& wall) {
    const Ticks time = ticks(duration, "tick", true);
    if (time < 1) refuse("tick: time has to go on");
    quadrille::Limits limits;
    limits.wall_s = wall;
    return told_of([&] { return dispatcher_->tick(time, limits); },
                   [this](Cost cost) { return continuous::in_input_units(cost, resolution_); });
  }

  [[nodiscard]] double now() const { return units(dispatcher_->now()); }
  [[nodiscard]] double clock(std::size_t robot) const {
    return units(dispatcher_->clock(AgentId(robot)));
  }
  [[nodiscard]] double limit(std::size_t robot) const {
    return units(dispatcher_->limit(AgentId(robot)));
  }
  [[nodiscard]] execution::Precedences order() const { return dispatcher_->order(); }
  [[nodiscard]] std::size_t num_tasks(std::size_t robot) const {
    return dispatcher_->num_tasks(AgentId(robot));
  }

  /// float64[k, 5]: from, to, fraction, arrive, depart.
  [[nodiscard]] py::array course(std::size_t robot) const {
    const dispatch::Course& course = dispatcher_->course(AgentId(robot));
    auto array = new_array<double>({course.size(), 5});
    double* to = array.mutable_data();
    for (const dispatch::Stop& stop : course) {
      *to++ = static_cast<double>(stop.spot.from.index());
      *to++ = static_cast<double>(stop.spot.to.index());
      *to++ = static_cast<double>(stop.spot.behind.value()) /
              static_cast<double>(stop.spot.whole.value());
      *to++ = units(stop.arrive);
      *to++ = units(stop.depart);
    }
    return frozen(array);
  }

 private:
  /// The dispatcher says which lanes there are not.
  static VertexId vertex(std::int64_t number) {
    return vertex_of(number, std::size_t{1} << 31U, "edge");
  }
  [[nodiscard]] Ticks ticks(double time, const std::string& what, bool is_up) const {
    const double exact = time / resolution_.time;
    const double whole = is_up ? std::ceil(exact - 1e-6) : std::floor(exact + 1e-6);
    if (!(whole >= 0 && whole < 1e12)) refuse(what + ": " + decimal(time) + " is out of range");
    return Ticks(static_cast<std::int64_t>(whole));
  }
  [[nodiscard]] double units(Ticks time) const {
    return continuous::in_input_units(time, resolution_);
  }

  continuous::Resolution resolution_;
  std::unique_ptr<dispatch::Dispatcher> dispatcher_;
};

}  // namespace

void bind_dispatching(py::module_& module) {
  py::class_<Dispatching>(module, "Dispatcher")
      .def(py::init<const TimedInstance&, double, double, double, bool>())
      .def("__len__", &Dispatching::size)
      .def("assign", &Dispatching::assign)
      .def("cancel", &Dispatching::cancel)
      .def("close", &Dispatching::close)
      .def("open", &Dispatching::open)
      .def("report", &Dispatching::report)
      .def("tick", &Dispatching::tick)
      .def("now", &Dispatching::now)
      .def("clock", &Dispatching::clock)
      .def("limit", &Dispatching::limit)
      .def("num_tasks", &Dispatching::num_tasks)
      .def("order", &Dispatching::order)
      .def("course", &Dispatching::course);
}

}  // namespace quadrille::python
