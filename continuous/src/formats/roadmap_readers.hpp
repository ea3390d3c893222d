// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/text/open_objects.hpp"

namespace quadrille::continuous {

// One function per format; see read_map_file. The text has no NUL byte and no byte order mark.
[[nodiscard]] Result<MapFile> read_xml_map(const std::string& text, const std::string& file,
                                           const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_nav_graph_text(const std::string& text, const std::string& file,
                                                  const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_lif(const std::string& text, const std::string& file,
                                       const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_route_graph(const std::string& text, const std::string& file,
                                               const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_gml(const std::string& text, const std::string& file,
                                       const MapFileOptions& options);

}  // namespace quadrille::continuous
