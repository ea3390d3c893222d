// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/input/source.hpp"
#include "quadrille/text/names.hpp"

namespace quadrille::input {

/// sqrt(2) / 4: on a grid a diagonal move just touches a disc in the cell beside it.
inline constexpr double kDefaultRadius = 0.35355339059327379;

/// How many headings `--headings` can give robots.
inline constexpr std::int64_t kHeadings{continuous::kHeadings.size()};

/// Where an instance in continuous time comes from: `--roadmap`, `--task` and what goes with them,
/// or `--headings` with `--map` and `--scen`. `--map`, `--scen`, `--instance`, `--agents` and the
/// letters of a map are with the other InputOptions.
struct RoadmapOptions {
  std::string roadmap, task;
  std::optional<double> radius, speed, resolution;
  std::optional<std::int64_t> neighbourhood;
  std::string level, vehicle_type;  ///< Of a roadmap that has several.
  bool overlap_at_start = false;    ///< All agents may, see continuous::Agent::overlaps_at_start.
  std::optional<std::int64_t> headings, turn;  ///< Robots that turn, and in how many timesteps.

  /// By themselves, whatever `--instance` contains.
  [[nodiscard]] bool name_roadmap() const { return !roadmap.empty() || headings.has_value(); }
};

/// Whether the options name a roadmap: by `--roadmap` or `--headings`, or because `--instance`
/// contains one. Keeps the text of that file, which may be a pipe.
[[nodiscard]] bool is_roadmap(InputOptions& input, const RoadmapOptions& options);
/// What is wrong with the combination of options where they name a roadmap; empty if nothing is.
[[nodiscard]] std::string check_roadmap_options(const RoadmapOptions& options,
                                                const InputOptions& input, Need need);
/// What is wrong with the options where they do not; empty if nothing is.
[[nodiscard]] std::string why_no_roadmap(const RoadmapOptions& options);

struct RoadmapInput {
  continuous::Instance instance;
  std::optional<continuous::GridRoadmap> grid = {};
  std::optional<continuous::PoseGrid> poses = {};  ///< Instead, where robots turn.
  std::string source = {};                         ///< The file that holds the roadmap.
  std::string task_source = {};  ///< The file that holds the agents; empty if there are none.
  std::size_t rows = 0;          ///< Agents in that file.
  std::string kind = {};         ///< "32 x 32 grid, 2^3 neighbours, " or nothing.
  std::size_t num_zero_length_edges = 0;
  text::Names names = {};
  /// What is to be done besides, where the files say so: the places to go to, one after the other.
  std::vector<std::vector<Goals>> tasks = {};
  double num_revealed = 1;  ///< So many of them per agent are known at a time.
  std::vector<std::string> notes =
      {};  ///< What plans do not honour, and what may be meant otherwise.

  /// Whose cells plans may name.
  [[nodiscard]] const continuous::GridRoadmap* grid_or_null() const {
    return grid ? &*grid : nullptr;
  }
  /// The cells that pages show.
  [[nodiscard]] const continuous::GridRoadmap* cells_or_null() const {
    return poses ? &poses->cells() : grid_or_null();
  }
};
/// A grid in continuous time: agents are discs of radius 0.35 cells, which take one unit of time
/// for a move, and collide as on the grid when they move at the same time. Errors
/// (invalid_instance): what is no grid, and an instance with rules.
[[nodiscard]] Result<RoadmapInput> as_roadmap(const GridInput& grid);

/// Requires options that name a roadmap and pass check_roadmap_options. All rows of the task
/// without `--agents`.
[[nodiscard]] Result<RoadmapInput> load_roadmap_input(const RoadmapOptions& options,
                                                      const InputOptions& input);

}  // namespace quadrille::input
