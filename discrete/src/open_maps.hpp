// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/discrete/graph.hpp"

namespace quadrille::discrete {

/// Whether the graph has few walls, such as empty maps and wide terrain: vertices have more
/// than 3.6 neighbours on average. Agents have very many cheapest paths there, so that some
/// settings of the search are better the other way round (measured, see docs/performance.md).
[[nodiscard]] inline bool is_open(const Graph& graph) noexcept {
  return 20 * graph.num_edges() > 36 * graph.num_vertices();
}

}  // namespace quadrille::discrete
