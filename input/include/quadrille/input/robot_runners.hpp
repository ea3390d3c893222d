// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/roadmap_xml.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::input {

/// A problem of the League of Robot Runners, and as one for a single plan: robot k goes to the
/// first place of task k.
struct RobotRunnersProblem {
  continuous::OccupancyGrid cells;
  continuous::TaskXml task;  ///< Cells as row * width + column; lines are those of the robots.
  /// All tasks: the cells to go to, one after the other.
  std::vector<std::vector<std::int64_t>> all_tasks = {};
  /// So many tasks per robot are known at a time.
  double num_revealed = 1;
};

/// Whether this is the text of such a problem, see text::sniff.
[[nodiscard]] bool is_robot_runners(const std::string& text);
/// Reads the map, the robots and the tasks that the text names, relative to where `file` is. Errors
/// with file and line: syntax, io, invalid_instance (fewer tasks than robots, fewer robots than
/// `teamSize`, cells that are not passable or do not exist, `agentSize` and `agentCounter`, which
/// are of another model) and those of discrete::read_map.
[[nodiscard]] Result<RobotRunnersProblem> read_robot_runners(const std::string& text,
                                                             const std::string& file);

}  // namespace quadrille::input
