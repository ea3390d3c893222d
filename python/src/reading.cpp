// SPDX-License-Identifier: MIT
// Instances from files, read just as the program reads them.
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "errors.hpp"
#include "grid/grid_input.hpp"
#include "roadmap/roadmap_input.hpp"
#include "saving.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

/// (a StepInstance or a TimedInstance, what the file calls its parts). The names are those of the
/// program's options.
py::object read(const py::dict& names) {
  cli::InputOptions input;
  cli::RoadmapOptions roadmap;
  const auto set = [&](const char* name, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if (names.contains(name)) value = py::object(names[name]).cast<Value>();
  };
  set("map", input.map);
  set("scen", input.scen);
  set("instance", input.instance);
  set("agents", input.agents);
  set("passable", input.letters.passable);
  set("blocked", input.letters.blocked);
  set("roadmap", roadmap.roadmap);
  set("task", roadmap.task);
  set("radius", roadmap.radius);
  set("speed", roadmap.speed);
  set("neighbourhood", roadmap.neighbourhood);
  set("resolution", roadmap.resolution);

  py::gil_scoped_release release;
  const bool timed = cli::is_roadmap(input, roadmap);
  std::string wrong;
  if (timed) {
    wrong = check_roadmap_options(roadmap, input, cli::Need::map);
  } else {
    wrong = why_no_roadmap(roadmap);
    if (wrong.empty()) wrong = check_grid_options(input, cli::Need::map);
  }
  if (timed && wrong.empty()) {
    auto loaded = load_roadmap_input(roadmap, input);
    const py::gil_scoped_acquire acquire;
    if (!loaded && loaded.error().code == ErrorCode::no_plan)
      return py::make_tuple(TimedInstance(loaded.error(), std::nullopt), lists_of({}));
    if (!loaded) raise(loaded.error());
    return py::make_tuple(TimedInstance(std::move(loaded->instance), std::move(loaded->grid)),
                          lists_of(loaded->names));
  }
  if (wrong.empty()) {
    auto loaded = load_grid_input(input);
    const py::gil_scoped_acquire acquire;
    if (!loaded) raise(loaded.error());
    return py::make_tuple(std::move(loaded->instance), lists_of(loaded->names));
  }
  const py::gil_scoped_acquire acquire;
  refuse(wrong);
}

}  // namespace

void bind_reading(py::module_& module) { module.def("read", &read); }

}  // namespace quadrille::python
