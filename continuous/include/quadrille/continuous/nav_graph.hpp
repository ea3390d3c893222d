// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// Reads a navigation graph as Open-RMF's building map tools write it (YAML, metres): `levels` with
/// `vertices` [x, y, {properties}] and `lanes` [from, to, {properties}], one way each unless they
/// are is_bidirectional. A `speed_limit` is that of the edge (Edge::speed_limit), unless it is 0,
/// and at an `is_passthrough_point` nobody may wait. Of the other properties names are kept and the
/// rest is not looked at, except mutex groups, which no plan of this library honours, and which are
/// refused. Errors, with file and line: io, syntax, invalid_instance (no level with vertices, or
/// several of which none is asked for, vertices that do not exist), out_of_range.
[[nodiscard]] Result<MapFile> read_nav_graph(std::istream& in, const std::string& file,
                                             const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_nav_graph(const std::filesystem::path& path,
                                             const MapFileOptions& options);

}  // namespace quadrille::continuous

QUADRILLE_API_END
