// SPDX-License-Identifier: MIT
// Roadmaps for robots that turn, and roadmaps of the files of others.
#include "poses.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::python {
namespace {

using continuous::HeadingRules;
using continuous::Roadmap;

std::vector<continuous::Turning> kinds_of(const py::list& given) {
  std::vector<continuous::Turning> kinds;
  for (const py::handle entry : given) {
    const auto [bits, rate, steer] =
        entry.cast<std::tuple<std::uint64_t, std::optional<double>, std::optional<double>>>();
    continuous::Turning kind;
    kind.groups = groups_of(bits);
    kind.rate = rate;
    if (steer) kind.steer = *steer;
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

/// `size`: number of vertices.
HeadingRules headings_of(const py::dict& given, std::size_t size) {
  const auto vertex = [&](std::int64_t v, const char* name) { return vertex_of(v, size, name); };
  const auto list = [&](const char* name) { return given[name].cast<py::list>(); };
  HeadingRules rules;
  for (const auto& [name, to] :
       {std::pair("further", &rules.further), std::pair("stands", &rules.stands)})
    for (const py::handle entry : list(name)) {
      const auto [place, heading] = entry.cast<std::pair<std::int64_t, double>>();
      to->push_back({vertex(place, name), heading});
    }
  for (const py::handle entry : list("lanes")) {
    const auto [from, to, heading] = entry.cast<std::tuple<std::int64_t, std::int64_t, double>>();
    rules.lanes.push_back({vertex(from, "lanes"), vertex(to, "lanes"), heading});
  }
  for (const py::handle entry : list("turns")) {
    const auto [place, left, right, most] =
        entry.cast<std::tuple<std::int64_t, bool, bool, double>>();
    rules.turns.push_back({vertex(place, "turns"), left, right, most});
  }
  return rules;
}

PoseMap poses_of(const std::shared_ptr<Roadmap>& places, const py::list& kinds,
                 const py::dict& rules) {
  auto poses = take(continuous::PoseRoadmap::make(*places, kinds_of(kinds),
                                                  headings_of(rules, places->num_vertices())));
  return {places, kinds, rules, std::move(poses)};
}

/// Per pose, what `of` says.
template <class T, class Of>
py::array per_pose(const PoseMap& self, const Of& of) {
  const std::size_t n = self.poses.roadmap()->num_vertices();
  auto array = new_array<T>({n});
  for (std::size_t v = 0; v < n; ++v) array.mutable_data()[v] = of(VertexId(v));
  return frozen(array);
}

std::vector<std::size_t> stays_of(const PoseMap& self, std::size_t place) {
  std::vector<std::size_t> poses;
  for (const VertexId pose : self.poses.any_heading(VertexId(place))) poses.push_back(pose.index());
  return poses;
}

/// (TimedGraph, ids, whether these are names and no numbers, further names [(name, vertex)],
/// notes, what it says of headings).
py::tuple read_map(const std::filesystem::path& file, const Sizes& sizes, double speed,
                   const std::string& level, const std::string& vehicle_type) {
  continuous::MapFileOptions options{resolution_of(sizes), {}, level, vehicle_type, true};
  const auto most = continuous::quantise_speed(speed, options.resolution);
  if (!most) refuse("speed: it is not supported");
  options.speed = *most;
  auto read = take([&] {
    const py::gil_scoped_release release;
    return continuous::read_map_file(file, options);
  }());
  if (!std::holds_alternative<Roadmap>(read.map))
    raise({ErrorCode::invalid_instance, "a grid, and no roadmap", {file.string(), 0}});
  std::vector<std::pair<std::string, std::size_t>> places;
  for (const auto& [name, vertex] : read.names.places) places.emplace_back(name, vertex.index());
  if (read.num_zero_length_edges > 0)
    read.notes.push_back("edges between vertices in one place take one tick (" +
                         std::to_string(read.num_zero_length_edges) + ")");
  return py::make_tuple(std::make_shared<Roadmap>(std::get<Roadmap>(std::move(read.map))),
                        read.names.of_vertices, read.names.are_ids, places, read.notes,
                        rules_of_headings(read.headings));
}

}  // namespace

py::dict rules_of_headings(const HeadingRules& rules) {
  const auto headings = [](const std::vector<HeadingRules::Heading>& told) {
    py::list list;
    for (const auto& [place, heading] : told) list.append(py::make_tuple(place.index(), heading));
    return list;
  };
  py::list lanes, turns;
  for (const auto& [from, to, heading] : rules.lanes)
    lanes.append(py::make_tuple(from.index(), to.index(), heading));
  for (const HeadingRules::Turns& told : rules.turns)
    turns.append(
        py::make_tuple(told.place.index(), told.counter_clockwise, told.clockwise, told.most));
  py::dict given;
  given["further"] = headings(rules.further);
  given["stands"] = headings(rules.stands);
  given["lanes"] = lanes;
  given["turns"] = turns;
  return given;
}

void bind_poses(py::module_& module) {
  py::class_<PoseMap>(module, "PoseMap")
      .def(py::init(&poses_of))
      .def_property_readonly("graph",
                             [](const PoseMap& self) {
                               // Nobody on this side can change it.
                               return std::const_pointer_cast<Roadmap>(self.poses.roadmap());
                             })
      .def("places",
           [](const PoseMap& self) {
             return per_pose<std::int64_t>(self, [&](VertexId v) {
               return static_cast<std::int64_t>(self.poses.place(v).index());
             });
           })
      .def("headings",
           [](const PoseMap& self) {
             return per_pose<double>(self, [&](VertexId v) { return self.poses.heading(v); });
           })
      .def("leaving",
           [](const PoseMap& self) {
             return per_pose<bool>(self, [&](VertexId v) { return self.poses.is_leaving(v); });
           })
      .def("stays", &stays_of)
      .def("facing",
           [](const PoseMap& self, std::size_t place, double heading) {
             return self.poses.facing(VertexId(place), heading).index();
           })
      .def(py::pickle(
          [](const PoseMap& self) { return py::make_tuple(self.places, self.kinds, self.rules); },
          [](const py::tuple& state) {
            return poses_of(state[0].cast<std::shared_ptr<Roadmap>>(), state[1].cast<py::list>(),
                            state[2].cast<py::dict>());
          }));
  module.def("read_map", &read_map);
}

}  // namespace quadrille::python
