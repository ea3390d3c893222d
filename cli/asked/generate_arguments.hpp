// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace quadrille::cli {

/// What `generate` makes: all but roadmaps are maps.
enum class Kind { empty, random, maze, room, warehouse, roadmap };

/// What `generate --kind roadmap` is asked for, besides width, height, agents and seed.
struct GenerateRoadmapOptions {
  std::optional<std::int64_t> vertices;
  std::optional<double> altitude, radius, speed, reach, resolution;
  bool mixed = false;
  std::string output;
};

/// What `generate` was asked on the command line, for either domain.
struct GenerateArguments {
  std::optional<Kind> kind;
  std::string map;
  std::optional<std::int64_t> width, height, corridor_width, room_size;
  std::optional<double> obstacles, doors;
  std::optional<std::int64_t> shelf_columns, shelf_rows, shelf_length, shelf_width, aisle_width,
      side_width;
  std::optional<std::int64_t> agents, seed;
  bool any_goal = false;
  GenerateRoadmapOptions roadmap;
  std::string map_output, scen_output;

  [[nodiscard]] std::uint64_t random_seed() const {
    return static_cast<std::uint64_t>(seed.value_or(0));
  }
};

}  // namespace quadrille::cli
