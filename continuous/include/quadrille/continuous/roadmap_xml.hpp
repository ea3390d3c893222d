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
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/export.hpp"

// The XML files of continuous-time planners; docs/formats-of-others.md has examples. Errors of the
// readers carry file and, once the XML is well formed, line: io, syntax, out_of_range,
// invalid_instance. Nothing is repaired, nothing is printed.

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// Reads a roadmap as GraphML, or a grid.
///
/// GraphML: nodes with any ids, each given once, whose places stand under the node key `coords`, as
/// "x,y" or "x,y,z" (OMPL's PlannerData::printGraphML, CCBS), under keys `x`, `y` and perhaps `z`
/// (networkx), or in pictures of yEd; edges lead one way or both, as `edgedefault` and `directed`
/// say. Weights are not looked at. Ids that are 0, 1, ... or n0, n1, ... are the numbers of the
/// vertices, in whatever order they come.
///
/// A grid: <map> with <width>, <height> and a <grid> of <row>s of 0 (passable) and 1.
/// `resolution` is for coordinates.
[[nodiscard]] Result<MapFile> read_map_xml(std::istream& in, const std::string& file,
                                           double resolution);
[[nodiscard]] Result<MapFile> read_map_xml(const std::filesystem::path& path, double resolution);

/// One <agent> of a task file.
struct TaskRow {
  long line = 0;
  /// By vertex number (start_id, goal_id), by name if one of them is no number, or by cell
  /// (start_i = row, start_j = column, ...).
  std::variant<std::pair<std::int64_t, std::int64_t>, std::pair<Cell, Cell>,
               std::pair<std::string, std::string>>
      places;
};
struct TaskXml {
  std::string file;
  std::vector<TaskRow> rows;
};
[[nodiscard]] Result<TaskXml> read_task_xml(std::istream& in, const std::string& file);
[[nodiscard]] Result<TaskXml> read_task_xml(const std::filesystem::path& path);

/// The agents of the first `num_agents` rows, all alike but for their places; `names` is what the
/// file of the roadmap calls its vertices. Errors (invalid_instance), with file and line: fewer
/// rows, cells for a roadmap, vertices that do not exist; no_plan where a disc does not fit.
[[nodiscard]] Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                                   const Roadmap& roadmap, Length radius,
                                                   Speed speed, const VertexNames& names = {});
/// As above, on a grid; vertex numbers are row * width + column.
[[nodiscard]] Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                                   const GridRoadmap& grid, Length radius,
                                                   Speed speed);

}  // namespace quadrille::continuous

QUADRILLE_API_END
