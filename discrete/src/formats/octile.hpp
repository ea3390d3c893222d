// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/discrete/movingai.hpp"

namespace quadrille::discrete {

/// Lengths of shortest octile paths, which scenario files state: straight steps cost 1, diagonal
/// ones sqrt(2) and only between four passable cells.
class OctileDistance {
 public:
  /// The map has to outlive this object.
  explicit OctileDistance(const GridMap& map);

  /// Infinity if there is no way. Requires passable cells. O(cells * log(cells)).
  [[nodiscard]] double between(Cell start, Cell goal);

 private:
  [[nodiscard]] bool is_open(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] std::size_t index(Cell cell) const;

  const GridMap& map_;
  std::vector<double> length_;          // Of the best way found to a cell in this query.
  std::vector<std::uint32_t> queried_;  // The last query that reached a cell.
  std::uint32_t query_ = 0;
};

}  // namespace quadrille::discrete
