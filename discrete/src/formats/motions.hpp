// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "formats/instance_document.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// A move on a grid by its letter.
struct Motion {
  std::int32_t dx = 0, dy = 0;
};

/// u, d, l, r or w; y grows downwards.
inline std::optional<Motion> find_motion(char letter) {
  switch (letter) {
    case 'u':
      return Motion{0, -1};
    case 'd':
      return Motion{0, 1};
    case 'l':
      return Motion{-1, 0};
    case 'r':
      return Motion{1, 0};
    case 'w':
      return Motion{0, 0};
    default:
      return std::nullopt;
  }
}

/// A path that grows by moves.
class Walk {
 public:
  Walk(const GridLayout& grid, VertexId start) : grid_(grid), path_{start} {}

  /// Empty, or what stands in the way.
  std::string step(Motion motion, std::int64_t times) {
    for (std::int64_t i = 0; i < times; ++i) {
      const Cell at = grid_.cell_of(path_.back());
      const auto next = find_vertex(grid_, at.x + motion.dx, at.y + motion.dy);
      if (!next)
        return "timestep " + std::to_string(path_.size()) + ": " +
               not_passable(grid_, at.x + motion.dx, at.y + motion.dy);
      path_.push_back(*next);
    }
    return "";
  }
  [[nodiscard]] Path path() && { return std::move(path_); }

 private:
  const GridLayout& grid_;
  Path path_;
};

}  // namespace quadrille::discrete
