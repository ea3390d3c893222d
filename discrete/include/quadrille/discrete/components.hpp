// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/export.hpp"
#include "quadrille/core/grouping.hpp"
#include "quadrille/discrete/graph.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// The components of the graph, vertices by their index; one-way edges join as others do. O(V + E).
[[nodiscard]] Grouping components_of(const Graph& graph);

}  // namespace quadrille::discrete

QUADRILLE_API_END
