// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/movingai.hpp"

// Maps and scenarios for tests and trials. The same arguments and seed give the same result on
// every platform. All functions return out_of_range for arguments outside the stated ranges and for
// maps of more than kMaxMapCells cells.

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// All cells passable. Sizes >= 1.
[[nodiscard]] Result<GridMap> empty_map(std::int32_t width, std::int32_t height);

/// Blocks round(obstacle_share * cells) cells, each choice equally likely; the rest need not be
/// connected. Sizes >= 1, 0 <= obstacle_share <= 1.
[[nodiscard]] Result<GridMap> random_map(std::int32_t width, std::int32_t height,
                                         double obstacle_share, std::uint64_t seed);

/// A perfect maze: corridors `corridor_width` wide between walls one cell wide, with exactly one
/// way between any two corridor squares. Sizes >= corridor_width >= 1; what is left at the right
/// and at the bottom when a size is not k * (corridor_width + 1) - 1 is wall.
[[nodiscard]] Result<GridMap> maze_map(std::int32_t width, std::int32_t height,
                                       std::int32_t corridor_width, std::uint64_t seed);

/// Square rooms, `room_size` wide, between walls one cell wide with doors one cell wide. Doors on a
/// random spanning tree connect all rooms; each other wall between two rooms has one with
/// probability `door_share`. Sizes >= room_size >= 1, 0 <= door_share <= 1; left-over cells are
/// wall.
[[nodiscard]] Result<GridMap> room_map(std::int32_t width, std::int32_t height,
                                       std::int32_t room_size, double door_share,
                                       std::uint64_t seed);

/// Shelves in rows and columns, aisles between them and above and below each row, open space at the
/// left and the right, and a wall one cell wide around it all. The defaults are the layout of the
/// benchmark map warehouse-10-20-10-2-1.
struct WarehouseLayout {
  std::int32_t shelf_columns = 10;  ///< >= 1
  std::int32_t shelf_rows = 20;     ///< >= 1
  std::int32_t shelf_length = 10;   ///< Cells along x; >= 1.
  std::int32_t shelf_width = 2;     ///< Cells along y; >= 1.
  std::int32_t aisle_width = 1;     ///< >= 1
  std::int32_t side_width = 25;     ///< Open columns at the left and at the right; >= 0.
};
[[nodiscard]] Result<GridMap> warehouse_map(const WarehouseLayout& layout);

struct ScenarioOptions {
  /// Each goal can be reached from its start. Otherwise goals are drawn among all passable cells.
  bool reachable = true;
  std::string map_name = "map.map";  ///< Written into the rows; neither empty nor with white space.
};
/// Random tasks for `num_agents` agents: distinct starts, distinct goals; a start may be its own
/// goal or another agent's. `optimal` is computed (0 if there is no way), `bucket` is its fourth
/// part. Errors: invalid_instance if there are fewer passable cells than agents; out_of_range.
/// O(agents * cells * log(cells)).
[[nodiscard]] Result<Scenario> random_scenario(const GridMap& map, std::size_t num_agents,
                                               std::uint64_t seed,
                                               const ScenarioOptions& options = {});

}  // namespace quadrille::discrete

QUADRILLE_API_END
