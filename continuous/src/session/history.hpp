// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// Where an agent is at some time on its path, and what is left of the path from then on.
struct Later {
  bool moves = false;     ///< From `at` to `to`, or else it stands at `at`.
  bool is_first = false;  ///< In the first move of the path, or at its first stop.
  VertexId at, to;
  Ticks begun = 0;    ///< So long ago the move began. 0 for one that stands.
  bool ends = false;  ///< There it stays.
  /// Times count from then. Who moves begins at a place of its own: the first vertex is without
  /// meaning.
  Path rest;

  /// Whether the rest of one path is one of the other one, too.
  [[nodiscard]] bool is_where(const Later& other) const {
    return moves == other.moves && at == other.at && to == other.to && begun == other.begun;
  }
};

/// Requires a path that is not empty, and a time that is no earlier than its beginning. Who is at
/// a vertex at that moment stands there, if only to go on.
[[nodiscard]] Later later(const Path& path, Ticks time);

}  // namespace quadrille::continuous
