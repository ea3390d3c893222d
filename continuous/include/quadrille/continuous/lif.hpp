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

/// Reads a layout in VDMA's Layout Interchange Format 1.0 (JSON, metres), for one type of vehicles:
/// nodes with their ids, edges, which lead one way, with their `maxSpeed`, and stations, which are
/// further names of their nodes. With MapFileOptions::has_headings also how robots face and turn:
/// `theta` of nodes, `vehicleOrientation` (degrees) with `orientationType`, and for turns at nodes
/// `rotationAtStartNodeAllowed`, `rotationAtEndNodeAllowed` and `maxRotationSpeed` (radians per
/// second) of all edges that begin or end there. What plans do not honour is in the notes. Errors,
/// with file and line: io, syntax, invalid_instance (ids that do not exist or are there twice,
/// several layouts or types of vehicles of which none is asked for), out_of_range.
[[nodiscard]] Result<MapFile> read_lif(std::istream& in, const std::string& file,
                                       const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_lif(const std::filesystem::path& path,
                                       const MapFileOptions& options);

}  // namespace quadrille::continuous

QUADRILLE_API_END
