// SPDX-License-Identifier: MIT
// The continuous domain: searches and plans, in ticks.
#include "timed.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "pose_grids.hpp"
#include "quadrille/continuous/duration_error.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/poses/steps.hpp"
#include "saving.hpp"
#include "solving.hpp"
#include "timed_solving.hpp"

namespace quadrille::python {
namespace {

using continuous::Instance;
using continuous::Plan;
using continuous::Resolution;
using continuous::Roadmap;
using continuous::Stop;
using continuous::Ticks;

py::dict solve_timed(const TimedInstance& self, const py::dict& arguments) {
  if (self.no_plan()) return solve_refused(self, arguments);
  std::optional<continuous::PoseGrid> grid;
  const auto set_options = [&](Arguments& given, const std::atomic<bool>& interrupt) {
    grid = made_of(given.take<Poses::value_type>("poses"));
    return options_of(self.resolution(), given, interrupt);
  };
  const auto search = [&](const Instance& instance, const continuous::SolveOptions& options) {
    return grid ? poses::solve(*grid, instance, options) : solve(instance, options);
  };
  return run_solve<Plan>(self.instance(), arguments, set_options, search);
}

/// (violations, sum of costs, makespan, clearances); a violation is (kind, agent, other, tick,
/// message), clearances are (agents int32[k, 2], gap and tick float64[k, 2]).
py::tuple verify_timed(const TimedInstance& self, const Plan& plan,
                       std::optional<std::size_t> num_clearances) {
  const Instance& instance = self.instance();
  continuous::VerifyReport report;
  {
    const py::gil_scoped_release release;
    report = verify(instance, plan, num_clearances.value_or(continuous::kAllClearances));
  }
  py::list violations;
  for (const continuous::Violation& violation : report.violations)
    violations.append(py::make_tuple(
        to_string(violation.kind), violation.agent.index(),
        violation.other ? py::object(py::int_(violation.other->index())) : py::object(py::none()),
        violation.tick.value(), violation.message));
  auto pairs = new_array<std::int32_t>({report.clearances.size(), 2});
  auto gaps = new_array<double>({report.clearances.size(), 2});
  std::int32_t* pair = pairs.mutable_data();
  double* gap = gaps.mutable_data();
  for (const continuous::Clearance& clearance : report.clearances) {
    *pair++ = static_cast<std::int32_t>(clearance.agent.index());
    *pair++ = static_cast<std::int32_t>(clearance.other.index());
    *gap++ = clearance.gap;
    *gap++ = clearance.tick;
  }
  return py::make_tuple(violations, report.sum_of_costs, report.makespan,
                        py::make_tuple(frozen(pairs), frozen(gaps)));
}

/// The stops of one agent in ticks: the plan's own memory.
py::array ticks_of(const py::object& self, std::size_t i) {
  const auto& paths = self.cast<const Plan&>().paths;
  if (i >= paths.size()) throw py::index_error("there is no agent " + std::to_string(i));
  const continuous::Path& path = paths[AgentId(i)];
  py::list names, formats, offsets;
  const auto field = [&](const char* name, const char* format, std::size_t offset) {
    names.append(name);
    formats.append(format);
    offsets.append(offset);
  };
  static_assert(sizeof(VertexId) == 4 && sizeof(Ticks) == 8);
  field("vertex", "u4", offsetof(Stop, vertex));
  field("arrive", "i8", offsetof(Stop, arrive));
  field("depart", "i8", offsetof(Stop, depart));
  return view_of(path.data(), py::dtype(names, formats, offsets, sizeof(Stop)),
                 {static_cast<py::ssize_t>(path.size())}, {sizeof(Stop)}, self);
}

/// By agent the times of its stops: (arrivals float64[k], departures float64[k]).
py::tuple times_of(const Plan& plan, std::size_t i, const Sizes& sizes) {
  const Resolution resolution = resolution_of(sizes);
  if (i >= plan.paths.size()) throw py::index_error("there is no agent " + std::to_string(i));
  const continuous::Path& path = plan.paths[AgentId(i)];
  auto arrivals = new_array<double>({path.size()}), departures = new_array<double>({path.size()});
  double *arrive = arrivals.mutable_data(), *depart = departures.mutable_data();
  for (const Stop& stop : path) {
    *arrive++ = continuous::in_input_units(stop.arrive, resolution);
    *depart++ = continuous::in_input_units(stop.depart, resolution);
  }
  return py::make_tuple(arrivals, departures);
}

std::optional<continuous::PlanFormat> format_of(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  const auto format = continuous::parse_plan_format(*name);
  if (!format) refuse("format: '" + *name + "' is not json or ccbs");
  return format;
}

void save_plan(const Plan& plan, const TimedInstance& self, const std::filesystem::path& path,
               const std::optional<std::string>& name) {
  const auto format =
      format_for(path, format_of(name), continuous::plan_format_of(path), "json or ccbs");
  save(path, [&](std::ostream& out) {
    return write_plan(out, path.string(), self.instance(), plan, format, self.grid_or_null());
  });
}

void save_instance(const TimedInstance& self, const std::filesystem::path& path,
                   const std::optional<std::string>& name, const NameLists& lists) {
  using continuous::PlanFormat;
  if (name && *name != "json") refuse("format: '" + *name + "' is not json");
  const auto known = path.extension() == ".json" ? std::optional(PlanFormat::json) : std::nullopt;
  format_for(path, name ? std::optional(PlanFormat::json) : std::nullopt, known, "json");
  const Instance& instance = self.instance();
  save(path, [&](std::ostream& out) {
    return write_instance_json(out, path.string(), instance, names_of(lists));
  });
}

Plan read_plan(const TimedInstance& self, const std::filesystem::path& path,
               const std::optional<std::string>& name) {
  const auto format = format_of(name);
  const Instance& instance = self.instance();
  return take([&] {
           const py::gil_scoped_release release;
           return continuous::read_plan(path, instance, self.grid_or_null(), format);
         }())
      .plan;
}

/// How long the move takes the agent; nullopt if there is no such edge, or it is not for the agent.
std::optional<Ticks> travel_time(const Instance& instance, AgentId agent, VertexId from,
                                 VertexId to) {
  const continuous::ClassId kind = instance.class_of(agent);
  for (const continuous::EdgeId edge : instance.out_edges(kind, from))
    if (instance.roadmap().edge(edge).to == to) return instance.duration(kind, edge);
  return std::nullopt;
}

/// Of a stop the arrival may be NaN: as soon
/// as the agent gets there; so may be the departure: at once.
continuous::Path path_of(const Instance& instance, AgentId agent, const Ints& vertices,
                         const Doubles& arrivals, const Doubles& departures) {
  const Resolution& resolution = instance.resolution();
  const Roadmap& roadmap = instance.roadmap();
  continuous::Path path;
  for (py::ssize_t k = 0; k < vertices.size(); ++k) {
    const std::string who =
        "agent " + std::to_string(agent.index()) + ", stop " + std::to_string(k);
    Stop stop{vertex_of(vertices.at(k), roadmap.num_vertices(), who)};
    const Sizes sizes(resolution.length, resolution.time);
    if (!std::isnan(arrivals.at(k))) {
      stop.arrive = moment_of(arrivals.at(k), sizes, who + ": it arrives");
    } else if (path.empty()) {
      stop.arrive = instance.now();
    } else {
      const auto move = travel_time(instance, agent, path.back().vertex, stop.vertex);
      if (!move) refuse(who + ": no edge leads there from the stop before");
      stop.arrive = path.back().depart + *move;
    }
    stop.depart = std::isnan(departures.at(k))
                      ? stop.arrive
                      : moment_of(departures.at(k), sizes, who + ": it departs");
    path.push_back(stop);
  }
  return path;
}

/// [(vertices int64[k], arrivals float64[k], departures float64[k])], one per agent.
Plan plan_of(const TimedInstance& self, const py::list& given) {
  Plan plan;
  for (const AgentId agent : self.instance().agent_ids()) {
    const auto stops = given[agent.index()].cast<py::tuple>();
    plan.paths.push_back(path_of(self.instance(), agent, stops[0].cast<Ints>(),
                                 stops[1].cast<Doubles>(), stops[2].cast<Doubles>()));
  }
  return plan;
}

/// int64[n] in ticks, -1 where the goal is out of reach.
py::array free_costs_of(const TimedInstance& self) {
  const Instance& instance = self.instance();
  auto costs = new_array<std::int64_t>({instance.num_agents()});
  std::int64_t* to = costs.mutable_data();
  for (const AgentId agent : instance.agent_ids())
    *to++ = continuous::free_cost(instance, agent).value_or(Ticks(-1)).value();
  return frozen(costs);
}

/// The text of an instance file, in which everything is a whole number.
py::bytes text_of(const Instance& instance) {
  std::ostringstream text;
  check(write_instance_json(text, "", instance));
  return text.str();
}
Instance instance_of_text(const std::string& text) {
  std::istringstream in(text);
  return take(continuous::read_instance_json(in, "a pickled fleet"));
}

py::tuple state_of(const TimedInstance& self) {
  if (!self.no_plan()) return py::make_tuple(text_of(self.instance()));
  if (self.has_parts())
    refuse("a fleet of which it is seen that it has no plan cannot be pickled: " +
           self.no_plan()->message);
  const Error& error = *self.no_plan();
  return py::make_tuple(static_cast<int>(error.code), error.message, error.where.file,
                        error.where.line);
}
TimedInstance instance_of_state(const py::tuple& state) {
  if (state.size() == 1) return TimedInstance(instance_of_text(state[0].cast<std::string>()));
  return {Error{static_cast<ErrorCode>(state[0].cast<int>()),
                state[1].cast<std::string>(),
                {state[2].cast<std::string>(), state[3].cast<long>()}},
          std::nullopt};
}

/// int64[k, 3] per agent.
py::tuple state_of_plan(const Plan& plan) {
  py::list paths;
  for (const continuous::Path& path : plan.paths) {
    auto stops = new_array<std::int64_t>({path.size(), 3});
    std::int64_t* to = stops.mutable_data();
    for (const Stop& stop : path) {
      *to++ = static_cast<std::int64_t>(stop.vertex.index());
      *to++ = stop.arrive.value();
      *to++ = stop.depart.value();
    }
    paths.append(stops);
  }
  return py::make_tuple(paths);
}
Plan plan_of_state(const py::tuple& state) {
  Plan plan;
  for (const py::handle entry : state[0].cast<py::list>()) {
    const auto stops = entry.cast<Ints>();
    continuous::Path path;
    for (py::ssize_t k = 0; k < stops.shape(0); ++k)
      path.push_back({VertexId(static_cast<std::size_t>(stops.at(k, 0))), Ticks(stops.at(k, 1)),
                      Ticks(stops.at(k, 2))});
    plan.paths.push_back(std::move(path));
  }
  return plan;
}

}  // namespace

continuous::SolveOptions options_of(const continuous::Resolution& resolution, Arguments& arguments,
                                    const std::atomic<bool>& interrupt) {
  continuous::SolveOptions options;
  set_common(arguments, options, interrupt);
  arguments.choose("system", continuous::parse_system, options.system, "dpll or smt-cbs");
  arguments.set("initial", options.initial_plan);
  if (const auto bound = arguments.take<double>("known_bound"))
    options.known_lower_bound = continuous::quantise_bound(*bound, resolution).value_or(-1);
  arguments.finish("roadmaps");
  return options;
}

py::dict solve_refused(const TimedInstance& self, const py::dict& given) {
  Arguments arguments(given);
  arguments.take<py::function>("progress");
  arguments.take<py::function>("on_plan");
  arguments.take<Poses::value_type>("poses");
  const std::atomic<bool> interrupt = false;
  // A bound is in ticks of any size here.
  options_of({}, arguments, interrupt);
  continuous::SolveOutcome outcome;
  outcome.status = Status::infeasible;
  outcome.explanation = self.no_plan()->to_string();
  return outcome_of(std::move(outcome));
}

void bind_timed(py::module_& module) {
  module.attr("NOTABLE_DURATION_ERROR") = continuous::kNotableDurationError;
  bind_timed_graph(module);
  py::class_<Plan>(module, "TimedPlan")
      .def_property_readonly("num_agents", [](const Plan& plan) { return plan.paths.size(); })
      .def("costs",
           [](const Plan& plan) {
             auto costs = new_array<std::int64_t>({plan.paths.size()});
             std::int64_t* to = costs.mutable_data();
             for (const continuous::Path& path : plan.paths) *to++ = cost(path);
             return frozen(costs);
           })
      .def("ticks", &ticks_of)
      .def("times", &times_of)
      .def("save", &save_plan)
      .def(py::pickle(&state_of_plan, &plan_of_state));
  py::class_<TimedInstance>(module, "TimedInstance")
      .def(py::init(&instance_of))
      .def_property_readonly("no_plan",
                             [](const TimedInstance& self) {
                               return self.no_plan() ? std::optional(self.no_plan()->to_string())
                                                     : std::nullopt;
                             })
      .def_property_readonly("num_agents",
                             [](const TimedInstance& self) { return self.agents().size(); })
      .def_property_readonly("now",
                             [](const TimedInstance& self) {
                               return continuous::in_input_units(self.now(), self.resolution());
                             })
      .def_property_readonly("resolution",
                             [](const TimedInstance& self) {
                               const Resolution& resolution = self.resolution();
                               return Sizes(resolution.length, resolution.time);
                             })
      .def_property_readonly("graph",
                             [](const TimedInstance& self) {
                               // Nobody on this side can change it.
                               return std::const_pointer_cast<Roadmap>(self.roadmap());
                             })
      .def("starts", &starts_of)
      .def("goals", &goals_of)
      .def("goal_sets", &goal_sets_of)
      .def("has_goal_sets", &has_goal_sets)
      .def("bodies", &bodies_of)
      .def("speeds", &speeds_of)
      .def("rules", &rules_of)
      .def("duration_error", &duration_error_of)
      .def("in_input_units",
           [](const TimedInstance& self, Cost ticks) {
             return continuous::in_input_units(ticks, self.resolution());
           })
      .def("plan", &plan_of)
      .def("free_costs", &free_costs_of)
      .def("solve", &solve_timed)
      .def("verify", &verify_timed)
      .def("read_plan", &read_plan)
      .def("save", &save_instance)
      .def(py::pickle(&state_of, &instance_of_state));
}

}  // namespace quadrille::python
