// SPDX-License-Identifier: MIT
#pragma once

#include "formats/xml_input.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::continuous {

/// Reads a roadmap of a file whose root element is <graphml>; see read_map_xml.
[[nodiscard]] Result<MapFile> read_graphml(const XmlFile& xml, const MapFileOptions& options);

}  // namespace quadrille::continuous
