// SPDX-License-Identifier: MIT
// Roadmaps: vertices in the plane or in space and directed edges.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

using continuous::Length;
using continuous::Point;
using continuous::Resolution;
using continuous::Roadmap;

/// For messages: "xy[3]".
std::string entry(const char* array, py::ssize_t row) {
  return std::string(array) + "[" + std::to_string(row) + "]";
}

std::string number(VertexId v) { return std::to_string(v.index()); }

std::uint64_t bits_of(const continuous::Groups& groups) {
  std::uint64_t bits = 0;
  for (std::size_t group = 0; group < continuous::kMaxGroups; ++group)
    if (groups.contains(continuous::GroupId(group))) bits |= std::uint64_t{1} << group;
  return bits;
}

/// `xy`: [n, 2], or [n, 3] with heights, `edges`: [m, 2], `durations` and `limits` (of speeds):
/// [m], NaN for none, `open_to`: [m], groups, `no_waiting`: vertices. `both_ways`: each edge is
/// followed by its reverse.
std::shared_ptr<Roadmap> roadmap_of(const Doubles& xy, const Ints& edges, const Doubles& durations,
                                    const Doubles& limits, const Bits& open_to,
                                    const Ints& no_waiting, const Sizes& sizes, bool both_ways) {
  const Resolution resolution = resolution_of(sizes);
  const auto coordinates = xy.unchecked<2>();
  std::vector<Point> points;
  for (py::ssize_t v = 0; v < coordinates.shape(0); ++v) {
    const auto x = continuous::quantise_coordinate(coordinates(v, 0), resolution);
    const auto y = continuous::quantise_coordinate(coordinates(v, 1), resolution);
    const bool is_flat = coordinates.shape(1) == 2;
    const auto z = continuous::quantise_coordinate(is_flat ? 0 : coordinates(v, 2), resolution);
    if (!x || !y || !z)
      refuse(entry("xy", v) + ": the coordinate is too large for the resolution, or not finite");
    points.push_back({*x, *y, *z});
  }
  const auto ends = edges.unchecked<2>();
  const auto times = durations.unchecked<1>();
  const auto speeds = limits.unchecked<1>();
  std::vector<continuous::Edge> list;
  for (py::ssize_t e = 0; e < ends.shape(0); ++e) {
    const std::string name = entry("edges", e);
    continuous::Edge edge{vertex_of(ends(e, 0), points.size(), name),
                          vertex_of(ends(e, 1), points.size(), name),
                          {},
                          groups_of(open_to.at(e))};
    if (!std::isnan(times(e))) {
      edge.duration = continuous::quantise_duration(times(e), resolution);
      if (!edge.duration)
        refuse(entry("durations", e) + ": the duration is less than one tick, or too long");
    }
    if (!std::isnan(speeds(e))) {
      if (edge.duration) refuse(name + " has a duration and a speed limit");
      edge.speed_limit = continuous::quantise_speed(speeds(e), resolution);
      if (!edge.speed_limit) refuse(entry("speed_limits", e) + ": the speed is not supported");
    }
    if (edge.from == edge.to)
      refuse(name + " leads from vertex " + number(edge.from) + " to itself");
    if (!edge.duration && points[edge.from.index()] == points[edge.to.index()])
      refuse(name + " leads from vertex " + number(edge.from) + " to vertex " + number(edge.to) +
             ", which is in the same place at this resolution");
    list.push_back(edge);
    if (!both_ways) continue;
    std::swap(edge.from, edge.to);
    list.push_back(edge);
  }
  std::vector<VertexId> passed;
  for (py::ssize_t k = 0; k < no_waiting.shape(0); ++k) {
    const VertexId v = vertex_of(no_waiting.at(k), points.size(), entry("no_waiting", k));
    if (std::find(passed.begin(), passed.end(), v) != passed.end())
      refuse(entry("no_waiting", k) + ": vertex " + number(v) + " is there twice");
    passed.push_back(v);
  }
  return std::make_shared<Roadmap>(
      take(Roadmap::make(std::move(points), std::move(list), {}, {}, std::move(passed))));
}

/// `free`: [h, w], the cells of a grid on which robots turn. The vertices are the poses, by cell,
/// row by row, and heading.
std::shared_ptr<Roadmap> poses_of(const Bools& free, std::int64_t turn) {
  const continuous::OccupancyGrid cells{static_cast<std::int32_t>(free.shape(0)),
                                        static_cast<std::int32_t>(free.shape(1)), flags_of(free)};
  const auto poses = take(continuous::PoseGrid::make(cells, continuous::Ticks(turn)));
  return std::const_pointer_cast<Roadmap>(poses.roadmap());
}

/// The names of the headings, in the order of the vertices of a cell.
std::vector<std::string> heading_names() {
  std::vector<std::string> names;
  for (const continuous::Heading heading : continuous::kHeadings)
    names.emplace_back(to_string(heading));
  return names;
}

/// How many coordinates a place has.
py::ssize_t dimensions(const Roadmap& roadmap) { return roadmap.is_flat() ? 2 : 3; }

/// int64[n, 2], or [n, 3], in length units: the roadmap's own memory.
py::array units_of(const py::object& self) {
  static_assert(sizeof(Point) == 3 * sizeof(std::int64_t) &&
                sizeof(Length) == sizeof(std::int64_t));
  const auto& roadmap = self.cast<const Roadmap&>();
  const auto& points = roadmap.positions();
  return view_of(points.data(), py::dtype::of<std::int64_t>(),
                 {static_cast<py::ssize_t>(points.size()), dimensions(roadmap)},
                 {sizeof(Point), sizeof(std::int64_t)}, self);
}

py::array coordinates_of(const Roadmap& roadmap, const Sizes& sizes) {
  const Resolution resolution = resolution_of(sizes);
  auto array =
      new_array<double>({roadmap.num_vertices(), static_cast<std::size_t>(dimensions(roadmap))});
  double* to = array.mutable_data();
  for (const Point& point : roadmap.positions()) {
    *to++ = continuous::in_input_units(point.x, resolution);
    *to++ = continuous::in_input_units(point.y, resolution);
    if (!roadmap.is_flat()) *to++ = continuous::in_input_units(point.z, resolution);
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

py::array limits_of(const Roadmap& roadmap, const Sizes& sizes) {
  const Resolution resolution = resolution_of(sizes);
  auto array = new_array<double>({roadmap.num_edges()});
  double* to = array.mutable_data();
  for (const continuous::Edge& edge : roadmap.edges())
    *to++ = edge.speed_limit ? continuous::speed_in_input_units(*edge.speed_limit, resolution)
                             : std::nan("");
  return frozen(array);
}

py::array no_waiting_of(const Roadmap& roadmap) {
  auto array = new_array<std::int64_t>({roadmap.no_waiting().size()});
  std::int64_t* to = array.mutable_data();
  for (const VertexId v : roadmap.no_waiting()) *to++ = static_cast<std::int64_t>(v.index());
  return frozen(array);
}

py::array open_to_of(const Roadmap& roadmap) {
  auto array = new_array<std::uint64_t>({roadmap.num_edges()});
  std::uint64_t* to = array.mutable_data();
  for (const continuous::Edge& edge : roadmap.edges()) *to++ = bits_of(edge.open_to);
  return frozen(array);
}

/// The text of an instance file without agents, in length units and ticks.
py::bytes state_of(const std::shared_ptr<Roadmap>& roadmap) {
  const auto instance = take(continuous::Instance::make(roadmap, {}, Resolution{1, 1}));
  std::ostringstream text;
  check(write_instance_json(text, "", instance));
  return text.str();
}
std::shared_ptr<Roadmap> roadmap_of_state(const py::bytes& state) {
  std::istringstream in{std::string(state)};
  const auto instance = take(continuous::read_instance_json(in, "a pickled roadmap"));
  return std::const_pointer_cast<Roadmap>(instance.shared_roadmap());
}

}  // namespace

continuous::Groups groups_of(std::uint64_t bits) {
  continuous::Groups groups;
  for (std::size_t group = 0; group < continuous::kMaxGroups; ++group)
    if ((bits >> group & 1) != 0) groups.insert(continuous::GroupId(group));
  return groups;
}

void bind_timed_graph(py::module_& module) {
  py::class_<Roadmap, std::shared_ptr<Roadmap>>(module, "TimedGraph")
      .def(py::init(&roadmap_of))
      .def_static("poses", &poses_of)
      .def_property_readonly("num_vertices", &Roadmap::num_vertices)
      .def_property_readonly("num_edges", &Roadmap::num_edges)
      .def_property_readonly("units", &units_of)
      .def("xy", &coordinates_of)
      .def("edges", &edges_of)
      .def("durations", &durations_of)
      .def("speed_limits", &limits_of)
      .def("no_waiting", &no_waiting_of)
      .def("open_to", &open_to_of)
      .def(py::pickle(&state_of, &roadmap_of_state));
  module.def("heading_names", &heading_names);
  module.attr("pose_resolution") =
      Sizes(continuous::PoseGrid::kResolution.length, continuous::PoseGrid::kResolution.time);
}

}  // namespace quadrille::python
