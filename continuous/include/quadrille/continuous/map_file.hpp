// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/heading_rules.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// What a file calls the vertices of its roadmap, so that tasks can name them.
struct VertexNames {
  /// By vertex; empty, or as many as there are vertices. An empty text is no name.
  std::vector<std::string> of_vertices;
  /// Whether these are ids that differ and have nothing to do with the numbers of the vertices.
  bool are_ids = false;
  /// Further names, such as those of stations.
  std::vector<std::pair<std::string, VertexId>> places;

  /// The vertex that a task means by `text`: by its number below `num_vertices`, unless there are
  /// ids some of which are numbers; else by its id; else by any name. Errors (invalid_instance,
  /// without a place): there is none, or several. Linear in the number of names.
  [[nodiscard]] Result<VertexId> find(std::string_view text, std::size_t num_vertices) const;
};

/// What a map file contains.
struct MapFile {
  std::variant<Roadmap, OccupancyGrid> map;
  /// Edges between different vertices in the same place, which take one tick: worth a line to the
  /// user.
  std::size_t num_zero_length_edges = 0;
  VertexNames names = {};
  /// What the file says and plans do not honour, or what can be read in two ways; in words, for
  /// the user. Each once.
  std::vector<std::string> notes = {};
  /// What it says of headings, if these are asked for.
  HeadingRules headings = {};
};

struct MapFileOptions {
  Resolution resolution;
  /// Of the agents: to say at once that an edge takes too long at its limit.
  Speed speed;
  std::string level = {};         ///< Of a file with several; empty: there has to be one.
  std::string vehicle_type = {};  ///< Of a LIF with several; likewise.
  /// Robots turn: what a LIF says of orientations and rotations is read, and not a note.
  bool has_headings = false;
};

/// Reads a roadmap whose format the content tells: GraphML or a grid as XML (see read_map_xml), a
/// nav graph of Open-RMF (see read_nav_graph), a layout in VDMA's LIF 1.0, a graph of Nav2's route
/// server as GeoJSON, or GML. docs/formats-of-others.md has examples. Errors, with file and line:
/// io, syntax, out_of_range, invalid_instance. Nothing is repaired, nothing is printed.
[[nodiscard]] Result<MapFile> read_map_file(std::istream& in, const std::string& file,
                                            const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_map_file(const std::filesystem::path& path,
                                            const MapFileOptions& options);

}  // namespace quadrille::continuous

QUADRILLE_API_END
