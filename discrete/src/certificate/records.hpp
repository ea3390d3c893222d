// SPDX-License-Identifier: MIT
// What the certificates of all systems have in common: docs/certificates.md.
#pragma once

#include <cstdint>

#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/graph.hpp"

namespace quadrille::discrete {

inline constexpr int kSamePlaceRule = 2, kSwapRule = 3, kRectangleRule = 4, kCorridorRule = 5;

/// How certificates call a vertex: on grids the number of its cell, row by row, blocked ones
/// counted; on other graphs the vertex's own number.
[[nodiscard]] inline std::int64_t place_number(const Graph& graph, VertexId v) {
  if (!graph.layout()) return static_cast<std::int64_t>(v.value());
  const Cell cell = graph.layout()->cell_of(v);
  return std::int64_t{cell.y} * graph.layout()->width() + cell.x;
}

}  // namespace quadrille::discrete
