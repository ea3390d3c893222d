// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/component.hpp"
#include "quadrille/pebbles/board.hpp"

namespace quadrille::discrete {

/// The component with its own numbers. O(V + E).
[[nodiscard]] inline pebbles::LocalGraph local_graph(const Component& component,
                                                     const ComponentNumbering& numbering) {
  std::vector<std::vector<Local>> neighbours(component.size());
  for (Local v = 0; v < component.size(); ++v)
    for (const VertexId w : component.graph->neighbours(component.vertices[v]))
      neighbours[v].push_back(numbering.number(w));
  return pebbles::LocalGraph(neighbours);
}

}  // namespace quadrille::discrete
