// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "errors.hpp"
#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"

namespace quadrille::python {

/// Sizes of a length unit and of a tick, as Python has them.
using Sizes = std::pair<double, double>;
inline continuous::Resolution resolution_of(const Sizes& sizes) {
  return {sizes.first, sizes.second};
}

/// `name`: for messages.
inline VertexId vertex_of(std::int64_t vertex, std::size_t size, const std::string& name) {
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(size))
    refuse(name + ": there is no vertex " + std::to_string(vertex) + " among " +
           std::to_string(size));
  return VertexId(static_cast<std::size_t>(vertex));
}

/// An instance in continuous time, and the grid that its roadmap comes from, if any: logs name its
/// cells.
struct TimedInstance {
  continuous::Instance instance;
  std::optional<continuous::GridRoadmap> grid;

  [[nodiscard]] const continuous::GridRoadmap* grid_or_null() const {
    return grid ? &*grid : nullptr;
  }
};

/// Starts and goals are vertices; a body is a radius, or float64[k, 2], the corners of a polygon.
/// `rules`: what rules_of gives, and `under_way`: [(agent, from, to, fraction)], instead of starts.
TimedInstance instance_of(const std::shared_ptr<continuous::Roadmap>& roadmap, const Sizes& sizes,
                          const Ints& starts, const Ints& goals, const py::list& bodies,
                          const Doubles& speeds, const py::dict& rules);
// And back: int32[n], a list as above, float64[n].
py::array starts_of(const TimedInstance& self);
py::array goals_of(const TimedInstance& self);
py::list bodies_of(const TimedInstance& self);
py::array speeds_of(const TimedInstance& self);
/// (relative error, agent, from, to, planned and exact duration) of the largest error; or None.
py::object duration_error_of(const TimedInstance& self);
/// `groups`: int64[n]; `releases`, `deadlines`: float64[n], NaN for none; `leaves`, `under_way`:
/// bool[n]; `obstacles`: [(body, float64[k, 4], leaves)], x, y, arrival and departure of each stop.
py::dict rules_of(const TimedInstance& self);

}  // namespace quadrille::python
