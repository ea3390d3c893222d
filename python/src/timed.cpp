// SPDX-License-Identifier: MIT
// The continuous domain: roadmaps, bodies and plans in ticks.
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
using continuous::Length;
using continuous::Plan;
using continuous::Point;
using continuous::Resolution;
using continuous::Roadmap;
using continuous::Stop;
using continuous::Ticks;

/// Sizes of a length unit and of a tick, as Python has them.
using Sizes = std::pair<double, double>;
Resolution resolution_of(const Sizes& sizes) { return {sizes.first, sizes.second}; }

/// For messages: "xy[3]".
std::string entry(const char* array, py::ssize_t row) {
  return std::string(array) + "[" + std::to_string(row) + "]";
}
/// For messages: what is wrong with an agent.
std::string agent(py::ssize_t i) { return "agent " + std::to_string(i) + ": "; }

VertexId vertex_of(std::int64_t vertex, std::size_t size, const std::string& name) {
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(size))
    refuse(name + ": there is no vertex " + std::to_string(vertex) + " among " +
           std::to_string(size));
  return VertexId(static_cast<std::size_t>(vertex));
}

/// `xy`: [n, 2], `edges`: [m, 2], `durations`: [m], NaN for none.
std::shared_ptr<Roadmap> roadmap_of(const Doubles& xy, const Ints& edges, const Doubles& durations,
                                    const Sizes& sizes) {
  const Resolution resolution = resolution_of(sizes);
  const auto coordinates = xy.unchecked<2>();
  std::vector<Point> points;
  for (py::ssize_t v = 0; v < coordinates.shape(0); ++v) {
    const auto x = continuous::quantise_coordinate(coordinates(v, 0), resolution);
    const auto y = continuous::quantise_coordinate(coordinates(v, 1), resolution);
    if (!x || !y)
      refuse(entry("xy", v) + ": the coordinate is too large for the resolution, or not finite");
    points.push_back({*x, *y});
  }
  const auto ends = edges.unchecked<2>();
  const auto times = durations.unchecked<1>();
  std::vector<continuous::Edge> list;
  for (py::ssize_t e = 0; e < ends.shape(0); ++e) {
    const std::string name = entry("edges", e);
    continuous::Edge edge{
        vertex_of(ends(e, 0), points.size(), name), vertex_of(ends(e, 1), points.size(), name), {}};
    if (!std::isnan(times(e))) {
      edge.duration = continuous::quantise_duration(times(e), resolution);
      if (!edge.duration)
        refuse(entry("durations", e) + ": the duration is less than one tick, or too long");
    }
    list.push_back(edge);
  }
  return std::make_shared<Roadmap>(take(Roadmap::make(std::move(points), std::move(list))));
}

/// int64[n, 2] in length units: the roadmap's own memory.
py::array units_of(const py::object& self) {
  static_assert(sizeof(Point) == 2 * sizeof(std::int64_t) &&
                sizeof(Length) == sizeof(std::int64_t));
  const auto& points = self.cast<const Roadmap&>().positions();
  return view_of(points.data(), py::dtype::of<std::int64_t>(),
                 {static_cast<py::ssize_t>(points.size()), 2},
                 {sizeof(Point), sizeof(std::int64_t)}, self);
}

py::array coordinates_of(const Roadmap& roadmap, const Sizes& sizes) {
  const Resolution resolution = resolution_of(sizes);
  auto array = new_array<double>({roadmap.num_vertices(), 2});
  double* to = array.mutable_data();
  for (const Point& point : roadmap.positions()) {
    *to++ = continuous::in_input_units(point.x, resolution);
    *to++ = continuous::in_input_units(point.y, resolution);
  }
  return frozen(array);
}

py::array edges_of(const Roadmap& roadmap) {
  auto array = new_array<std::int32_t>({roadmap.num_edges(), 2});
  std::int32_t* to = array.mutable_data();
  for (const continuous::Edge& edge : roadmap.edges()) {
    *to++ = static_cast<std::int32_t>(edge.from.index());
    *to++ = static_cast<std::int32_t>(edge.to.index());
  }
  return frozen(array);
}

py::array durations_of(const Roadmap& roadmap, const Sizes& sizes) {
  const Resolution resolution = resolution_of(sizes);
  auto array = new_array<double>({roadmap.num_edges()});
  double* to = array.mutable_data();
  for (const continuous::Edge& edge : roadmap.edges())
    *to++ = edge.duration ? continuous::in_input_units(*edge.duration, resolution) : std::nan("");
  return frozen(array);
}

/// `corners`: float64[k, 2].
continuous::Body polygon_of(const Doubles& corners, const Resolution& resolution, py::ssize_t i) {
  const auto xy = corners.unchecked<2>();
  std::vector<Point> points;
  for (py::ssize_t k = 0; k < xy.shape(0); ++k) {
    const auto x = continuous::quantise_corner(xy(k, 0), resolution);
    const auto y = continuous::quantise_corner(xy(k, 1), resolution);
    if (!x || !y) refuse(agent(i) + "a corner is too far away for the resolution, or not finite");
    points.push_back({*x, *y});
  }
  auto polygon = continuous::ConvexPolygon::make(std::move(points));
  if (!polygon) raise({polygon.error().code, agent(i) + polygon.error().message, {}});
  return *std::move(polygon);
}

/// A body is a radius or the corners of a polygon.
TimedInstance instance_of(const std::shared_ptr<Roadmap>& roadmap, const Sizes& sizes,
                          const Ints& starts, const Ints& goals, const py::list& bodies,
                          const Doubles& speeds) {
  const Resolution resolution = resolution_of(sizes);
  std::vector<continuous::Agent> agents;
  for (py::ssize_t i = 0; i < starts.shape(0); ++i) {
    continuous::Agent made;
    made.start = vertex_of(starts.at(i), roadmap->num_vertices(), agent(i) + "start");
    made.goal = vertex_of(goals.at(i), roadmap->num_vertices(), agent(i) + "goal");
    const py::object body = bodies[static_cast<std::size_t>(i)];
    if (py::isinstance<py::float_>(body)) {
      const auto radius = continuous::quantise_radius(body.cast<double>(), resolution);
      if (!radius) refuse(agent(i) + "the radius is less than one length unit, or too large");
      made.body = continuous::Disc{*radius};
    } else {
      made.body = polygon_of(body.cast<Doubles>(), resolution, i);
    }
    const auto speed = continuous::quantise_speed(speeds.at(i), resolution);
    if (!speed) refuse(agent(i) + "the speed is not between 0.000001 and 1000000");
    made.speed = *speed;
    agents.push_back(std::move(made));
  }
  return {take(Instance::make(roadmap, std::move(agents), resolution)), {}};
}

template <class VertexOf>
py::array vertices(const TimedInstance& self, const VertexOf& vertex) {
  auto array = new_array<std::int32_t>({self.instance.num_agents()});
  std::int32_t* to = array.mutable_data();
  for (const continuous::Agent& agent : self.instance.agents())
    *to++ = static_cast<std::int32_t>(vertex(agent).index());
  return frozen(array);
}

/// Per agent a radius, or float64[k, 2].
py::list bodies_of(const TimedInstance& self) {
  const Resolution& resolution = self.instance.resolution();
  py::list bodies;
  for (const continuous::Agent& agent : self.instance.agents()) {
    if (const auto* disc = std::get_if<continuous::Disc>(&agent.body)) {
      bodies.append(continuous::radius_in_input_units(disc->radius, resolution));
      continue;
    }
    const auto& corners = std::get<continuous::ConvexPolygon>(agent.body).vertices();
    auto array = new_array<double>({corners.size(), 2});
    double* to = array.mutable_data();
    for (const Point& corner : corners) {
      *to++ = continuous::corner_in_input_units(corner.x, resolution);
      *to++ = continuous::corner_in_input_units(corner.y, resolution);
    }
    bodies.append(frozen(array));
  }
  return bodies;
}

py::array speeds_of(const TimedInstance& self) {
  auto array = new_array<double>({self.instance.num_agents()});
  double* to = array.mutable_data();
  for (const continuous::Agent& agent : self.instance.agents())
    *to++ = continuous::speed_in_input_units(agent.speed, self.instance.resolution());
  return frozen(array);
}

continuous::SolveOptions options_of(Arguments& arguments, const std::atomic<bool>& interrupt) {
  continuous::SolveOptions options;
  set_common(arguments, options, interrupt);
  arguments.choose("system", continuous::parse_system, options.system, "dpll or smt-cbs");
  arguments.set("initial", options.initial_plan);
  arguments.finish("roadmaps");
  return options;
}

py::dict solve_timed(const TimedInstance& self, const py::dict& arguments) {
  return run_solve<continuous::Progress, Plan>(self.instance, arguments, options_of);
}

/// (violations, sum of costs, makespan, clearances); a violation is (kind, agent, other, tick,
/// message), clearances are (agents int32[k, 2], gap and tick float64[k, 2]).
py::tuple verify_timed(const TimedInstance& self, const Plan& plan) {
  continuous::VerifyReport report;
  {
    const py::gil_scoped_release release;
    report = verify(self.instance, plan);
  }
  py::list violations;
  for (const continuous::Violation& violation : report.violations)
    violations.append(py::make_tuple(
        to_string(violation.kind), violation.agent.index(),
        violation.other ? py::object(py::int_(violation.other->index())) : py::object(py::none()),
        violation.tick.count(), violation.message));
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
  const auto format = format_of(name).value_or(
      continuous::plan_format_of(path).value_or(continuous::PlanFormat::json));
  save(path, [&](std::ostream& out) {
    return write_plan(out, path.string(), self.instance, plan, format, self.grid_or_null());
  });
}

Plan read_plan(const TimedInstance& self, const std::filesystem::path& path,
               const std::optional<std::string>& name) {
  const auto format = format_of(name);
  return take([&] {
           const py::gil_scoped_release release;
           return continuous::read_plan(path, self.instance, self.grid_or_null(), format);
         }())
      .plan;
}

void bind_roadmap(py::module_& module) {
  py::class_<Roadmap, std::shared_ptr<Roadmap>>(module, "TimedGraph")
      .def(py::init(&roadmap_of))
      .def_property_readonly("num_vertices", &Roadmap::num_vertices)
      .def_property_readonly("num_edges", &Roadmap::num_edges)
      .def_property_readonly("units", &units_of)
      .def("xy", &coordinates_of)
      .def("edges", &edges_of)
      .def("durations", &durations_of);
}

}  // namespace

void bind_timed(py::module_& module) {
  bind_roadmap(module);
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
      .def_property_readonly("num_agents",
                             [](const TimedInstance& self) { return self.instance.num_agents(); })
      .def_property_readonly("resolution",
                             [](const TimedInstance& self) {
                               const Resolution& resolution = self.instance.resolution();
                               return Sizes(resolution.length, resolution.time);
                             })
      .def_property_readonly(
          "graph",
          [](const TimedInstance& self) {
            // Nobody on this side can change it.
            return std::const_pointer_cast<Roadmap>(self.instance.shared_roadmap());
          })
      .def("starts",
           [](const TimedInstance& self) {
             return vertices(self, [](const continuous::Agent& agent) { return agent.start; });
           })
      .def("goals",
           [](const TimedInstance& self) {
             return vertices(self, [](const continuous::Agent& agent) { return agent.goal; });
           })
      .def("bodies", &bodies_of)
      .def("speeds", &speeds_of)
      .def("in_input_units",
           [](const TimedInstance& self, Cost ticks) {
             return continuous::in_input_units(ticks, self.instance.resolution());
           })
      .def("solve", &solve_timed)
      .def("verify", &verify_timed)
      .def("read_plan", &read_plan)
      .def("save", [](const TimedInstance& self, const std::filesystem::path& path) {
        save(path, [&](std::ostream& out) {
          return write_instance_json(out, path.string(), self.instance);
        });
      });
}

}  // namespace quadrille::python
