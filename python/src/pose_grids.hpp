// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "arrays.hpp"
#include "errors.hpp"
#include "quadrille/continuous/pose_grid.hpp"

namespace quadrille::python {

/// What an instance is made of, if robots turn on a grid: its cells, and the time of a quarter
/// turn.
using Poses = std::optional<std::pair<Bools, std::int64_t>>;
inline std::optional<continuous::PoseGrid> made_of(const Poses& poses) {
  if (!poses) return std::nullopt;
  const Bools& free = poses->first;
  const continuous::OccupancyGrid cells{static_cast<std::int32_t>(free.shape(0)),
                                        static_cast<std::int32_t>(free.shape(1)), flags_of(free)};
  return take(continuous::PoseGrid::make(cells, continuous::Ticks(poses->second)));
}

}  // namespace quadrille::python
