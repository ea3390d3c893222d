// SPDX-License-Identifier: MIT
// The continuous domain: searches and plans, in ticks.
#include "timed.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "quadrille/continuous/duration_error.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "saving.hpp"
#include "solving.hpp"

namespace quadrille::python {
namespace {

using continuous::Instance;
using continuous::Plan;
using continuous::Resolution;
using continuous::Roadmap;
using continuous::Stop;
using continuous::Ticks;

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

/// An outcome without a search, once the arguments are those that a search takes.
py::dict solve_refused(const TimedInstance& self, const py::dict& given) {
  Arguments arguments(given);
  arguments.take<py::function>("progress");
  arguments.take<py::function>("on_plan");
  const std::atomic<bool> interrupt = false;
  // A bound is in ticks of any size here.
  options_of({}, arguments, interrupt);
  continuous::SolveOutcome outcome;
  outcome.status = Status::infeasible;
  outcome.explanation = self.no_plan()->to_string();
  return outcome_of(std::move(outcome));
}

py::dict solve_timed(const TimedInstance& self, const py::dict& arguments) {
  if (self.no_plan()) return solve_refused(self, arguments);
  const auto set_options = [&](Arguments& given, const std::atomic<bool>& interrupt) {
    return options_of(self.resolution(), given, interrupt);
  };
  return run_solve<Plan>(self.instance(), arguments, set_options);
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

}  // namespace

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
      .def("save", &save_plan);
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
      .def("solve", &solve_timed)
      .def("verify", &verify_timed)
      .def("read_plan", &read_plan)
      .def("save", &save_instance);
}

}  // namespace quadrille::python
