// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/continuous/heading_rules.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// How a layout is read.
struct LayoutOptions {
  std::string layout = {};        ///< Its id or level, of several; empty: there has to be one.
  std::string vehicle_type = {};  ///< Whose layout it is, of several types; likewise.
  /// Of the robots: to say at once that a lane takes too long at its limit.
  MetresPerSecond speed = MetresPerSecond(1);
};

/// What a layout has added.
struct Layout {
  std::vector<VertexId> vertices;  ///< In the order of the file, or as its ids number them.
  /// Stations, each with a vertex where robots are that interact with it; several times for
  /// several.
  std::vector<std::pair<std::string, VertexId>> stations;
  /// Orientations, rotations and their speeds, for PoseBuilder::rules.
  continuous::HeadingRules headings;
  /// What the file says and plans do not honour, in words for the user.
  std::vector<std::string> notes;
};

/// Adds the vertices, called as their nodes, and the lanes, with their speed limits, of a layout in
/// VDMA's LIF for one type of vehicles (docs/formats-of-others.md). What it says of how robots face
/// and turn holds where the headings are given to a PoseBuilder. Places are rounded to the
/// builder's resolution. Errors, with file and line: those of continuous::read_map_file;
/// out_of_range for a speed that is not supported. What is refused adds nothing.
[[nodiscard]] Result<Layout> add_layout(RoadmapBuilder& roads, const std::filesystem::path& file,
                                        const LayoutOptions& options = {});

}  // namespace quadrille::fleet

QUADRILLE_API_END
