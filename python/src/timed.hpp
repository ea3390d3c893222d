// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"

namespace quadrille::python {

/// An instance in continuous time, and the grid that its roadmap comes from, if any: logs name its
/// cells.
struct TimedInstance {
  continuous::Instance instance;
  std::optional<continuous::GridRoadmap> grid;

  [[nodiscard]] const continuous::GridRoadmap* grid_or_null() const {
    return grid ? &*grid : nullptr;
  }
};

}  // namespace quadrille::python
