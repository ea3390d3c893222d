// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "quadrille/continuous/resolution.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// A cell of a grid: x = column, y = row, (0, 0) upper left.
struct Cell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// A grid of square cells whose side is the input's unit of length.
struct OccupancyGrid {
  std::int32_t height = 0;
  std::int32_t width = 0;
  std::vector<bool> passable;  ///< height * width entries, row by row.

  [[nodiscard]] bool contains(Cell cell) const {
    return cell.x >= 0 && cell.x < width && cell.y >= 0 && cell.y < height;
  }
  /// Requires a cell of the grid.
  [[nodiscard]] bool is_passable(Cell cell) const { return passable[index(cell)]; }
  [[nodiscard]] std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x);
  }
};

/// The roadmap of a grid: one vertex in the centre of each cell on which a disc of the given radius
/// can stand, at (x, y) times the side.
class GridRoadmap {
 public:
  static constexpr int kMinNeighbourhood = 2, kMaxNeighbourhood = 5;

  /// Edges to the 2^k neighbours, k = `neighbourhood` in 2 .. 5: (1,0) for 2, (1,1) from 3 on,
  /// (1,2) from 4 on, (1,3) and (2,3) for 5, with all symmetries. A move is allowed when the swept
  /// disc meets the interior of no impassable cell; what is outside of the grid is free. Errors:
  /// out_of_range for a neighbourhood, a radius or a resolution that is not supported.
  [[nodiscard]] static Result<GridRoadmap> make(const OccupancyGrid& grid, int neighbourhood,
                                                Length radius, Resolution resolution);

  [[nodiscard]] std::shared_ptr<const Roadmap> roadmap() const noexcept { return roadmap_; }
  [[nodiscard]] std::int32_t height() const noexcept { return height_; }
  [[nodiscard]] std::int32_t width() const noexcept { return width_; }
  /// nullopt if there is no vertex, or no such cell.
  [[nodiscard]] std::optional<VertexId> vertex(Cell cell) const;
  [[nodiscard]] Cell cell(VertexId v) const { return cells_[v.index()]; }
  /// Whether the cell is one of the grid, and passable: without a vertex the disc does not fit.
  [[nodiscard]] bool is_passable(Cell cell) const { return slot(cell) != kBlocked; }
  [[nodiscard]] const Resolution& resolution() const noexcept { return resolution_; }

 private:
  static constexpr std::int64_t kBlocked = -1, kTooNarrow = -2;

  explicit GridRoadmap(Resolution resolution) : resolution_(resolution) {}
  /// The vertex of a cell, or why there is none.
  [[nodiscard]] std::int64_t slot(Cell cell) const;

  Resolution resolution_;
  std::int32_t height_ = 0, width_ = 0;
  std::vector<Cell> cells_;              // by vertex
  std::vector<std::int64_t> vertex_of_;  // by cell; kBlocked or kTooNarrow for none
  std::shared_ptr<const Roadmap> roadmap_;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
