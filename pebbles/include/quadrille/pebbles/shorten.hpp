// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/pebbles/board.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::pebbles {

/// Leaves out what an agent does between two visits of a vertex that nobody else visits meanwhile:
/// it stays there instead. Again and again, at most `rounds` times, until that changes nothing.
/// `starts`: by agent. O(shifts) a round.
[[nodiscard]] std::vector<Shift> without_loops(std::vector<Shift> shifts,
                                               std::span<const Local> starts,
                                               std::size_t num_vertices, int rounds);

/// When each shift ends if all are made as early as the order of visits at each vertex allows.
/// Agents follow each other, and the shifts of a rotation end together. O(shifts).
[[nodiscard]] std::vector<Timestep> earliest_times(std::span<const Shift> shifts,
                                                   std::size_t num_agents,
                                                   std::size_t num_vertices);

}  // namespace quadrille::pebbles

QUADRILLE_API_END
