// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// How a nav graph is read.
struct NavGraphOptions {
  std::string level = {};  ///< Of a building with several; empty: there has to be one.
  /// Of the robots: to say at once that a lane takes too long at its limit.
  MetresPerSecond speed = MetresPerSecond(1);
};

/// What a nav graph has added.
struct NavGraph {
  std::vector<VertexId> vertices;  ///< In the order of the file.
  /// What the file says and plans do not honour, in words for the user.
  std::vector<std::string> notes;
};

/// Adds the vertices, with their names, and the lanes, with their speed limits, of a nav graph of
/// Open-RMF, one level of a building (docs/formats-of-others.md); nobody waits at passthrough
/// points. Places are rounded to the builder's resolution. Errors,
/// with file and line: those of continuous::read_nav_graph; out_of_range for a speed that is not
/// supported. What is refused adds nothing.
[[nodiscard]] Result<NavGraph> add_nav_graph(RoadmapBuilder& roads,
                                             const std::filesystem::path& file,
                                             const NavGraphOptions& options = {});

}  // namespace quadrille::fleet

QUADRILLE_API_END
