// SPDX-License-Identifier: MIT
// Instances from files, read just as the program reads them.
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "errors.hpp"
#include "quadrille/core/in_names.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/input/roadmap.hpp"
#include "saving.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

/// (a StepInstance or a TimedInstance, what the file calls its parts). The names are those of the
/// program's options.
py::object read(const py::dict& names) {
  input::InputOptions source;
  input::RoadmapOptions roadmap;
  const auto set = [&](const char* name, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if (names.contains(name)) value = py::object(names[name]).cast<Value>();
  };
  set("map", source.map);
  set("scen", source.scen);
  set("instance", source.instance);
  set("agents", source.agents);
  set("passable", source.letters.passable);
  set("blocked", source.letters.blocked);
  set("roadmap", roadmap.roadmap);
  set("task", roadmap.task);
  set("radius", roadmap.radius);
  set("speed", roadmap.speed);
  set("neighbourhood", roadmap.neighbourhood);
  set("resolution", roadmap.resolution);

  py::gil_scoped_release release;
  const bool timed = is_roadmap(source, roadmap);
  std::string wrong;
  if (timed) {
    wrong = check_roadmap_options(roadmap, source, input::Need::map);
  } else {
    wrong = why_no_roadmap(roadmap);
    if (wrong.empty()) wrong = check_grid_options(source, input::Need::map);
  }
  if (timed && wrong.empty()) {
    auto loaded = load_roadmap_input(roadmap, source);
    const py::gil_scoped_acquire acquire;
    if (!loaded && loaded.error().code == ErrorCode::no_plan)
      return py::make_tuple(TimedInstance(loaded.error(), std::nullopt), lists_of({}));
    if (!loaded) raise(loaded.error());
    return py::make_tuple(TimedInstance(std::move(loaded->instance), std::move(loaded->grid)),
                          lists_of(loaded->names));
  }
  if (wrong.empty()) {
    auto loaded = load_grid_input(source);
    const py::gil_scoped_acquire acquire;
    if (!loaded) raise(loaded.error());
    return py::make_tuple(std::move(loaded->instance), lists_of(loaded->names));
  }
  const py::gil_scoped_acquire acquire;
  refuse(wrong);
}

}  // namespace

void bind_reading(py::module_& module) {
  module.def("read", &read);
  // Names by number, as messages have them; None: the number.
  module.def("in_names", [](const std::string& message,
                            const std::vector<std::optional<std::string>>& agents,
                            const std::vector<std::optional<std::string>>& vertices) {
    const auto of = [](const std::vector<std::optional<std::string>>& names) {
      return [&names](std::size_t i) { return i < names.size() ? names[i] : std::nullopt; };
    };
    return in_names(message, {of(agents), of(vertices)});
  });
}

}  // namespace quadrille::python
