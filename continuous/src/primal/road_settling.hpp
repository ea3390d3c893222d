// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "primal/serial_moves.hpp"

namespace quadrille::continuous {

/// What gives way where an agent that stands at one vertex would be in the way on a lane.
enum class GivingWay {
  vertices,  ///< Nobody stands at the vertex, if it is no start or goal; lanes lead on through it.
  lanes,     ///< The lane is not used.
};

/// Settles the agents one after the other (pebbles::Settling, without rotations) on the graph of
/// those vertices and lanes that are open both ways to everybody, and that are in nobody's way who
/// stands at a vertex of the graph. A serial plan; nullopt if starts and goals are not all in one
/// graph of this kind, or no way is found. Polynomial: at worst as many looks at contacts as there
/// are edges, times classes squared, and vertices near an edge. Throws LimitReached. Adds to
/// `effort`, and ends after about `most` of it. Requires that all agents are apart.
[[nodiscard]] std::optional<std::vector<SerialMove>> settle_on_roads(StandingBodies& bodies,
                                                                     GivingWay giving_way,
                                                                     std::int64_t most,
                                                                     std::int64_t& effort);

}  // namespace quadrille::continuous
