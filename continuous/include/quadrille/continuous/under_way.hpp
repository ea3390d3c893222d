// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// Appends to what a roadmap will be made of the place of an agent in the middle of a move, as
/// Agent::under_way needs it: a vertex to which no edge leads, and an edge for the rest of the
/// move. Returns the vertex.
///
/// `fraction` of the move between the two vertices, which takes `whole` ticks, lies behind the
/// agent. That is rounded down to whole ticks, where a number that differs from one by a billionth
/// is meant to be that, and at least one tick is left: the agent is never taken to be further than
/// it is, but for that last tick. The place is rounded to the nearest length unit. Requires two of
/// the vertices, a fraction in [0, 1] and at least one tick.
VertexId add_place_under_way(std::vector<Point>& vertices, std::vector<Edge>& edges, VertexId from,
                             VertexId to, Ticks whole, double fraction);

}  // namespace quadrille::continuous

QUADRILLE_API_END
