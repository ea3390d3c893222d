// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/resolution.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/heading.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

using quadrille::Heading;
using quadrille::kHeadings;
using quadrille::left_of;
using quadrille::right_of;
using quadrille::to_string;

/// Where a robot on a grid is, and where it faces.
struct Pose {
  Cell cell;
  Heading heading = Heading::east;
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// A grid for robots that turn, as the League of Robot Runners has them: a roadmap with one vertex
/// per cell and heading, all four in the same place. A tick is a timestep. In one tick a robot goes
/// to the cell ahead; turning to the left or right where it is takes some ticks; waiting any
/// number. With discs of radius kRadius, robots collide exactly if two are in one cell, or change
/// places: when one follows another, or several go round a square at once, they touch at most.
class PoseGrid {
 public:
  static constexpr Resolution kResolution{0.01, 1};  ///< A cell is 100 length units wide.
  static constexpr Length kRadius{35};               ///< At most sqrt(2)/4 cells.

  /// `turn`: how long a quarter turn takes. Errors: out_of_range for one that is not in
  /// [1, geometry::kMaxDuration], and for a grid that is too large. Linear in the cells.
  [[nodiscard]] static Result<PoseGrid> make(const OccupancyGrid& grid, Ticks turn);

  [[nodiscard]] std::shared_ptr<const Roadmap> roadmap() const noexcept { return roadmap_; }
  /// The cells, without headings. Its vertices are not those of `roadmap`.
  [[nodiscard]] const GridRoadmap& cells() const noexcept { return cells_; }
  [[nodiscard]] Ticks turn() const noexcept { return turn_; }

  /// nullopt if the cell is not passable, or there is none.
  [[nodiscard]] std::optional<VertexId> vertex(const Pose& pose) const;
  /// The cell with any heading. nullopt if it is not passable, or there is none.
  [[nodiscard]] std::optional<Goals> any_heading(Cell cell) const;
  /// Requires a vertex of `roadmap`.
  [[nodiscard]] Pose pose(VertexId v) const {
    return {cells_.cell(VertexId(v.index() / kHeadings.size())),
            kHeadings[v.index() % kHeadings.size()]};
  }

 private:
  PoseGrid(GridRoadmap cells, Ticks turn) : cells_(std::move(cells)), turn_(turn) {}
  /// The vertex of a pose in the cell of a vertex of `cells_`.
  [[nodiscard]] static VertexId facing(VertexId cell, Heading heading) {
    return VertexId(cell.index() * kHeadings.size() + static_cast<std::size_t>(heading));
  }

  GridRoadmap cells_;
  Ticks turn_;
  std::shared_ptr<const Roadmap> roadmap_;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
