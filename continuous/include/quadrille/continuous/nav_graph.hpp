// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// A nav graph of Open-RMF.
struct NavGraph {
  Roadmap roadmap;
  std::vector<std::string> names;  ///< By vertex; empty where there is none.
  /// Lanes between different vertices in the same place, which take one tick.
  std::size_t num_zero_length_edges = 0;
};

/// Reads a navigation graph as Open-RMF's building map tools write it (YAML, metres): `levels` with
/// `vertices` [x, y, {properties}] and `lanes` [from, to, {properties}], one way each. A lane with
/// a `speed_limit` below `speed` (that of the agents) takes as long as that makes it. Of the other
/// properties names are kept and the rest is not looked at, except mutex groups, which no plan of
/// this library honours, and which are refused. Errors, with file and line: io, syntax,
/// invalid_instance (no level or more than one with vertices, vertices that do not exist),
/// out_of_range.
[[nodiscard]] Result<NavGraph> read_nav_graph(std::istream& in, const std::string& file,
                                              const Resolution& resolution, Speed speed);
[[nodiscard]] Result<NavGraph> read_nav_graph(const std::filesystem::path& path,
                                              const Resolution& resolution, Speed speed);

}  // namespace quadrille::continuous

QUADRILLE_API_END
