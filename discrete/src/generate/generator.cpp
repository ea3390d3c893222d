// SPDX-License-Identifier: MIT
#include "quadrille/discrete/generator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "quadrille/core/random.hpp"

namespace quadrille::discrete {
namespace {

Error refuse(std::string message) { return {ErrorCode::out_of_range, std::move(message), {}}; }

/// A map of blocked cells.
Result<GridMap> make_map(std::int64_t width, std::int64_t height) {
  if (width < 1 || height < 1) return refuse("a map has at least one cell");
  if (width > kMaxMapCells || height > kMaxMapCells || width * height > kMaxMapCells)
    return refuse("a map of " + std::to_string(width) + " x " + std::to_string(height) +
                  " cells is larger than " + std::to_string(kMaxMapCells) + " cells");
  GridMap map;
  map.width = static_cast<std::int32_t>(width);
  map.height = static_cast<std::int32_t>(height);
  map.passable.assign(static_cast<std::size_t>(width * height), false);
  return map;
}

void fill(GridMap& map, Cell corner, std::int32_t width, std::int32_t height, bool passable) {
  for (std::int32_t y = corner.y; y < corner.y + height; ++y)
    for (std::int32_t x = corner.x; x < corner.x + width; ++x)
      map.passable[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                   static_cast<std::size_t>(x)] = passable;
}

/// Squares of passable cells, `size` wide, with walls one cell wide between them.
struct Lattice {
  std::int32_t size, columns, rows;

  [[nodiscard]] std::size_t num_squares() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  [[nodiscard]] std::size_t index(Cell square) const {
    return static_cast<std::size_t>(square.y) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(square.x);
  }
  [[nodiscard]] bool contains(Cell square) const {
    return square.x >= 0 && square.x < columns && square.y >= 0 && square.y < rows;
  }
  /// The upper left cell of a square.
  [[nodiscard]] Cell corner(Cell square) const {
    return {square.x * (size + 1), square.y * (size + 1)};
  }
};

Result<Lattice> make_lattice(std::int32_t width, std::int32_t height, std::int32_t size,
                             const char* what) {
  if (size < 1 || size > width || size > height)
    return refuse(std::string(what) + " " + std::to_string(size) +
                  " is not between 1 and the size of the map");
  // In 64 bits: INT32_MAX + 1 has to be counted as well.
  const std::int64_t pitch = std::int64_t{size} + 1;
  return Lattice{size, static_cast<std::int32_t>((std::int64_t{width} + 1) / pitch),
                 static_cast<std::int32_t>((std::int64_t{height} + 1) / pitch)};
}

/// Which walls are open: that to the right of each square, and that below it.
struct Openings {
  std::vector<bool> right, below;
};

/// A random spanning tree of the lattice, drawn by a depth-first walk: long winding corridors.
Openings spanning_tree(const Lattice& lattice, Random& random) {
  Openings open{std::vector<bool>(lattice.num_squares()), std::vector<bool>(lattice.num_squares())};
  std::vector<bool> seen(lattice.num_squares());
  std::vector<Cell> trail{{0, 0}};
  seen[0] = true;
  while (!trail.empty()) {
    const Cell at = trail.back();
    std::array<Cell, 4> fresh;
    std::size_t count = 0;
    for (const Cell next :
         {Cell{at.x, at.y - 1}, Cell{at.x - 1, at.y}, Cell{at.x + 1, at.y}, Cell{at.x, at.y + 1}})
      if (lattice.contains(next) && !seen[lattice.index(next)]) fresh[count++] = next;
    if (count == 0) {
      trail.pop_back();
      continue;
    }
    const Cell next = fresh[random.below(count)];
    const Cell first = std::min(at, next);  // Left of or above the other one.
    (at.y == next.y ? open.right : open.below)[lattice.index(first)] = true;
    seen[lattice.index(next)] = true;
    trail.push_back(next);
  }
  return open;
}

template <class Carve>
void carve_squares(GridMap& map, const Lattice& lattice, const Openings& open, Carve carve) {
  for (std::int32_t row = 0; row < lattice.rows; ++row)
    for (std::int32_t column = 0; column < lattice.columns; ++column) {
      const Cell square{column, row};
      const Cell corner = lattice.corner(square);
      fill(map, corner, lattice.size, lattice.size, true);
      carve(Cell{corner.x + lattice.size, corner.y}, true, column + 1 < lattice.columns,
            open.right[lattice.index(square)]);
      carve(Cell{corner.x, corner.y + lattice.size}, false, row + 1 < lattice.rows,
            open.below[lattice.index(square)]);
    }
}

}  // namespace

Result<GridMap> empty_map(std::int32_t width, std::int32_t height) {
  auto map = make_map(width, height);
  if (map) fill(map.value(), {0, 0}, width, height, true);
  return map;
}

Result<GridMap> random_map(std::int32_t width, std::int32_t height, double obstacle_share,
                           std::uint64_t seed) {
  if (!(obstacle_share >= 0 && obstacle_share <= 1))
    return refuse("the share of obstacles is not between 0 and 1");
  auto map = empty_map(width, height);
  if (!map) return map;
  Random random(seed);
  std::vector<bool>& passable = map.value().passable;
  const auto cells = static_cast<double>(passable.size());
  auto wanted = static_cast<std::uint64_t>(std::floor(obstacle_share * cells + 0.5));
  // Selection sampling: each cell is blocked with the probability that makes all choices alike.
  for (std::size_t i = 0; i < passable.size(); ++i)
    if (random.below(passable.size() - i) < wanted) {
      passable[i] = false;
      --wanted;
    }
  return map;
}

Result<GridMap> maze_map(std::int32_t width, std::int32_t height, std::int32_t corridor_width,
                         std::uint64_t seed) {
  auto map = make_map(width, height);
  if (!map) return map;
  const auto lattice = make_lattice(width, height, corridor_width, "the corridor width");
  if (!lattice) return lattice.error();
  Random random(seed);
  carve_squares(map.value(), *lattice, spanning_tree(*lattice, random),
                [&](Cell wall, bool upright, bool, bool open) {
                  if (open)
                    fill(map.value(), wall, upright ? 1 : corridor_width,
                         upright ? corridor_width : 1, true);
                });
  return map;
}

Result<GridMap> room_map(std::int32_t width, std::int32_t height, std::int32_t room_size,
                         double door_share, std::uint64_t seed) {
  if (!(door_share >= 0 && door_share <= 1))
    return refuse("the share of doors is not between 0 and 1");
  auto map = make_map(width, height);
  if (!map) return map;
  const auto lattice = make_lattice(width, height, room_size, "the room size");
  if (!lattice) return lattice.error();
  Random random(seed);
  carve_squares(map.value(), *lattice, spanning_tree(*lattice, random),
                [&](Cell wall, bool upright, bool inside, bool open) {
                  if (!inside || !(open || random.chance(door_share))) return;
                  const auto offset = static_cast<std::int32_t>(
                      random.below(static_cast<std::uint64_t>(room_size)));
                  (upright ? wall.y : wall.x) += offset;
                  fill(map.value(), wall, 1, 1, true);
                });
  return map;
}

Result<GridMap> warehouse_map(const WarehouseLayout& layout) {
  for (const std::int32_t size : {layout.shelf_columns, layout.shelf_rows, layout.shelf_length,
                                  layout.shelf_width, layout.aisle_width})
    if (size < 1 || size > kMaxMapCells) return refuse("a size of the warehouse is out of range");
  if (layout.side_width < 0 || layout.side_width > kMaxMapCells)
    return refuse("the side width of the warehouse is out of range");
  const std::int64_t length = layout.shelf_length, shelf_width = layout.shelf_width;
  const std::int64_t aisle = layout.aisle_width;
  const std::int64_t width = 2 + 2 * std::int64_t{layout.side_width} +
                             layout.shelf_columns * length + (layout.shelf_columns - 1) * aisle;
  const std::int64_t height =
      2 + layout.shelf_rows * shelf_width + (std::int64_t{layout.shelf_rows} + 1) * aisle;
  auto map = make_map(width, height);
  if (!map) return map;
  GridMap& grid = map.value();
  fill(grid, {1, 1}, grid.width - 2, grid.height - 2, true);
  for (std::int32_t row = 0; row < layout.shelf_rows; ++row)
    for (std::int32_t column = 0; column < layout.shelf_columns; ++column)
      fill(grid,
           {1 + layout.side_width + column * (layout.shelf_length + layout.aisle_width),
            1 + layout.aisle_width + row * (layout.shelf_width + layout.aisle_width)},
           layout.shelf_length, layout.shelf_width, false);
  return map;
}

}  // namespace quadrille::discrete
