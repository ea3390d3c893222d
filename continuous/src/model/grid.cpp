// SPDX-License-Identifier: MIT
#include "quadrille/continuous/grid.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <string>
#include <utility>

#include "quadrille/continuous/quantise.hpp"

namespace quadrille::continuous {
namespace {

using Integer = boost::multiprecision::cpp_int;

/// Larger discs would look at too many cells around each.
constexpr std::int64_t kMaxCellsPerRadius = 16;

/// Whether a point comes nearer than `reach` to the segment from the origin to (x, y).
bool is_near_segment(const Integer& px, const Integer& py, const Integer& x, const Integer& y,
                     const Integer& reach) {
  const Integer along = px * x + py * y, length2 = x * x + y * y, reach2 = reach * reach;
  if (along <= 0) return px * px + py * py < reach2;
  if (along >= length2) {
    const Integer dx = px - x, dy = py - y;
    return dx * dx + dy * dy < reach2;
  }
  const Integer cross = px * y - py * x;
  return cross * cross < reach2 * length2;
}

/// Whether a disc that moves from the centre of cell (0, 0) to that of `to` meets the interior of
/// `obstacle`. Lengths are doubled: a cell is 2 * side wide.
class SweptDisc {
 public:
  SweptDisc(Length side, Length radius)
      : side_(side.value()), reach_(2 * Integer(radius.value())) {}

  [[nodiscard]] bool meets(Cell to, Cell obstacle) const {
    const Integer x = 2 * side_ * to.x, y = 2 * side_ * to.y;
    const Integer cx = 2 * side_ * obstacle.x, cy = 2 * side_ * obstacle.y;
    // The Minkowski sum of square and disc is the union of two widened squares and four discs
    // around the corners; the segment has to keep out of the interior of all.
    for (const int sx : {-1, 1})
      for (const int sy : {-1, 1})
        if (is_near_segment(cx + sx * side_, cy + sy * side_, x, y, reach_)) return true;
    return meets_box(x, y, cx, cy, side_ + reach_, side_) ||
           meets_box(x, y, cx, cy, side_, side_ + reach_);
  }

 private:
  /// Whether the segment from the origin to (x, y) meets the interior of a box: no line along one
  /// of its sides or along the segment separates them.
  static bool meets_box(const Integer& x, const Integer& y, const Integer& cx, const Integer& cy,
                        const Integer& half_width, const Integer& half_height) {
    const Integer zero = 0;
    if (std::max(zero, x) <= cx - half_width || std::min(zero, x) >= cx + half_width) return false;
    if (std::max(zero, y) <= cy - half_height || std::min(zero, y) >= cy + half_height)
      return false;
    const Integer distance = abs(cx * y - cy * x);
    const Integer extent = half_width * abs(y) + half_height * abs(x);
    return distance < extent || extent == 0;
  }

  const Integer side_;  // half of the doubled side
  const Integer reach_;
};

std::vector<Cell> with_symmetries(std::initializer_list<Cell> steps) {
  std::vector<Cell> all;
  for (const Cell s : steps)
    for (const auto& [a, b] : {std::pair{s.x, s.y}, std::pair{s.y, s.x}})
      for (const int sign_a : {1, -1})
        for (const int sign_b : {1, -1}) {
          const Cell step{sign_b * b, sign_a * a};
          if (std::find(all.begin(), all.end(), step) == all.end()) all.push_back(step);
        }
  return all;
}

std::vector<Cell> steps(int neighbourhood) {
  switch (neighbourhood) {
    case 2:
      return with_symmetries({{0, 1}});
    case 3:
      return with_symmetries({{0, 1}, {1, 1}});
    case 4:
      return with_symmetries({{0, 1}, {1, 1}, {1, 2}});
    default:
      return with_symmetries({{0, 1}, {1, 1}, {1, 2}, {1, 3}, {2, 3}});
  }
}

/// The cells that must be passable for a step, relative to where it begins.
std::vector<Cell> swept_cells(const SweptDisc& disc, Cell step, std::int32_t margin) {
  std::vector<Cell> cells;
  for (std::int32_t y = std::min(0, step.y) - margin; y <= std::max(0, step.y) + margin; ++y)
    for (std::int32_t x = std::min(0, step.x) - margin; x <= std::max(0, step.x) + margin; ++x)
      if (disc.meets(step, {x, y})) cells.push_back({x, y});
  return cells;
}

bool is_free(const OccupancyGrid& grid, Cell from, const std::vector<Cell>& cells) {
  return std::all_of(cells.begin(), cells.end(), [&](Cell offset) {
    const Cell cell{from.x + offset.x, from.y + offset.y};
    return !grid.contains(cell) || grid.is_passable(cell);
  });
}

}  // namespace

std::optional<VertexId> GridRoadmap::vertex(Cell cell) const {
  const std::int64_t v = slot(cell);
  if (v < 0) return std::nullopt;
  return VertexId(static_cast<std::size_t>(v));
}

std::int64_t GridRoadmap::slot(Cell cell) const {
  if (cell.x < 0 || cell.x >= width_ || cell.y < 0 || cell.y >= height_) return kBlocked;
  return vertex_of_[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(cell.x)];
}

Result<GridRoadmap> GridRoadmap::make(const OccupancyGrid& grid, int neighbourhood, Length radius,
                                      Resolution resolution) {
  const auto refuse = [](const std::string& message) {
    return Error{ErrorCode::out_of_range, message, {}};
  };
  if (neighbourhood < kMinNeighbourhood || neighbourhood > kMaxNeighbourhood)
    return refuse("a neighbourhood is 2, 3, 4 or 5");
  const auto side = quantise_coordinate(1, resolution);
  if (!side || *side < 1) return refuse("the resolution is not supported");
  if (radius < 1 || radius > kMaxCellsPerRadius * *side)
    return refuse("on a grid, a radius is positive and at most " +
                  std::to_string(kMaxCellsPerRadius) + " cells");
  const std::int64_t size = std::max(grid.width, grid.height);
  if (size > geometry::kMaxLength / *side) return refuse("the grid is too large");

  const SweptDisc disc(*side, radius);
  const auto margin = static_cast<std::int32_t>(radius / *side + 1);
  GridRoadmap result(resolution);
  result.height_ = grid.height;
  result.width_ = grid.width;
  result.vertex_of_.assign(grid.passable.size(), kBlocked);
  std::vector<Point> positions;
  const std::vector<Cell> standing = swept_cells(disc, {0, 0}, margin);
  for (std::int32_t y = 0; y < grid.height; ++y)
    for (std::int32_t x = 0; x < grid.width; ++x) {
      const Cell cell{x, y};
      if (!grid.is_passable(cell)) continue;
      if (!is_free(grid, cell, standing)) {
        result.vertex_of_[grid.index(cell)] = kTooNarrow;
        continue;
      }
      result.vertex_of_[grid.index(cell)] = static_cast<std::int64_t>(positions.size());
      positions.push_back({x * *side, y * *side});
      result.cells_.push_back(cell);
    }
  std::vector<Edge> edges;
  std::vector<std::pair<Cell, std::vector<Cell>>> moves;
  for (const Cell step : steps(neighbourhood))
    moves.emplace_back(step, swept_cells(disc, step, margin));
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (const auto& [step, swept] : moves) {
      const Cell from = result.cells_[v];
      const auto to = result.vertex({from.x + step.x, from.y + step.y});
      if (to && is_free(grid, from, swept)) edges.push_back({VertexId(v), *to, std::nullopt});
    }
  auto roadmap = Roadmap::make(std::move(positions), std::move(edges));
  if (!roadmap) return roadmap.error();
  result.roadmap_ = std::make_shared<const Roadmap>(std::move(roadmap).value());
  return result;
}

}  // namespace quadrille::continuous
