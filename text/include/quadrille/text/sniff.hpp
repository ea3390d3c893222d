// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

// What a file looks like, whatever option it was given to: readers ask before they complain about a
// syntax that the file does not mean to have.

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// What people bring. docs/formats.md has the table of who writes what, and what is read.
enum class FileKind : std::uint8_t {
  unknown,
  movingai_map,
  movingai_scenario,
  own_instance,     ///< Our JSON, on a grid or a graph.
  own_roadmap,      ///< Our JSON, in continuous time.
  own_plan,         ///< Our JSON: a plan, or the result of a solve.
  own_export,       ///< What `export --to csv` writes.
  lif,              ///< VDMA's Layout Interchange Format, JSON.
  geojson,          ///< As Nav2's route server has it.
  gml,              ///< Graph Modelling Language.
  graphml,          ///< Of OMPL, CCBS, networkx, yEd.
  node_link,        ///< networkx's JSON.
  ccbs_grid,        ///< <root> with a <map>.
  ccbs_task,        ///< <root> with <agent>s.
  ccbs_log,         ///< <root> with a <log>.
  ccbs_settings,    ///< <root> with an <algorithm>.
  nav_graph,        ///< Of Open-RMF.
  building,         ///< What Open-RMF's traffic editor edits.
  rmf_scenario,     ///< Of Open-RMF's mapf.
  libmrp_instance,  ///< libMultiRobotPlanning's YAML with a map.
  libmrp_roadmap,   ///< The same with a roadmap.
  libmrp_schedule,  ///< Its output, and that of atb033's planners.
  lacam_result,     ///< key=value lines, then `solution=`.
  visualizer_plan,  ///< `0:(x,y),`
  cbsh2_paths,      ///< `Agent 0: (row,column)->`
  tracker_csv,      ///< Of the MAPF tracker.
  planviz,          ///< Output of the League of Robot Runners.
  lorr_problem,     ///< Its inputs: names the files of map, robots and tasks.
  lorr_locations,   ///< Robots or tasks of such a problem.
  vda5050,          ///< An order or a state.
  occupancy_yaml,   ///< map.yaml beside a picture, of ROS.
  boox,             ///< Maps and instances of boOX.
  asprilo,          ///< Facts of asprilo.
};

/// Looks at the beginning of the lines, at the keys on top, or at the names of the first elements;
/// the file need not be well-formed. Linear in the length of the text, and no memory but for a few
/// names.
[[nodiscard]] FileKind sniff(std::string_view text);

/// In words, such as "a layout in VDMA's LIF". Empty for unknown.
[[nodiscard]] std::string_view in_words(FileKind kind) noexcept;

/// Which option or command takes it, such as "it belongs to --roadmap", or what to do about it.
/// Empty for unknown.
[[nodiscard]] std::string_view where_it_belongs(FileKind kind) noexcept;

/// "this is a layout in VDMA's LIF: it belongs to --roadmap"
[[nodiscard]] std::string describe(FileKind kind);

/// The error (syntax, line 1) of a reader whose file is clearly of a kind that it does not read;
/// nullopt if it is one of `read`, or of no known kind.
[[nodiscard]] std::optional<Error> refuse_other(FileKind kind, const std::string& file,
                                                std::initializer_list<FileKind> read);
[[nodiscard]] inline std::optional<Error> refuse_other(std::string_view text,
                                                       const std::string& file,
                                                       std::initializer_list<FileKind> read) {
  return refuse_other(sniff(text), file, read);
}

}  // namespace quadrille::text

QUADRILLE_API_END
