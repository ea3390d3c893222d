// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/core/limits.hpp"
#include "quadrille/pebbles/board.hpp"

namespace quadrille::pebbles {

/// Rearranges the agents of a component without a free vertex by rotations: who is at v is to go
/// where `goal` has it. Adds to `effort`. False if a limit was met, or if no way was found: the
/// arrangement cannot be reached, or some block has many cycles of which no two share an edge
/// (docs/complete.md, section 4).
[[nodiscard]] bool rearrange_full_component(const LocalGraph& graph, const Board& goal,
                                            Board& board, LimitMonitor& limits,
                                            std::int64_t& effort);

}  // namespace quadrille::pebbles
