// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"

// The XML files of continuous-time planners; docs/formats-of-others.md has examples. Errors of the
// readers carry file and, once the XML is well formed, line: io, syntax, out_of_range,
// invalid_instance. Nothing is repaired, nothing is printed.

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// What a map file contains.
struct MapXml {
  std::variant<Roadmap, OccupancyGrid> map;
  /// Edges between different vertices in the same place, which take one tick: worth a line to the
  /// user.
  std::size_t num_zero_length_edges = 0;
};

/// Reads a roadmap as GraphML, as OMPL's PlannerData::printGraphML writes it: nodes n0, n1, ... in
/// this order with their coordinates "x,y" under the node key named `coords`; directed edges, whose
/// weights are not looked at. Or a grid: <map> with <width>, <height> and a <grid> of <row>s of 0
/// (passable) and 1. `resolution` is for coordinates.
[[nodiscard]] Result<MapXml> read_map_xml(std::istream& in, const std::string& file,
                                          double resolution);
[[nodiscard]] Result<MapXml> read_map_xml(const std::filesystem::path& path, double resolution);

/// One <agent> of a task file.
struct TaskRow {
  long line = 0;
  /// By vertex number (start_id, goal_id) or by cell (start_i = row, start_j = column, ...).
  std::variant<std::pair<std::int64_t, std::int64_t>, std::pair<Cell, Cell>> places;
};
struct TaskXml {
  std::string file;
  std::vector<TaskRow> rows;
};
[[nodiscard]] Result<TaskXml> read_task_xml(std::istream& in, const std::string& file);
[[nodiscard]] Result<TaskXml> read_task_xml(const std::filesystem::path& path);

/// The agents of the first `num_agents` rows, all alike but for their places. Errors
/// (invalid_instance), with file and line: fewer rows, cells for a roadmap or vertex numbers out of
/// range, cells without a vertex.
[[nodiscard]] Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                                   const Roadmap& roadmap, Length radius,
                                                   Speed speed);
/// As above, on a grid; vertex numbers are row * width + column.
[[nodiscard]] Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                                   const GridRoadmap& grid, Length radius,
                                                   Speed speed);

}  // namespace quadrille::continuous

QUADRILLE_API_END
