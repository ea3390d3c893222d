// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "formats/roadmap_builder.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/open_objects.hpp"

namespace quadrille::continuous {

// One function per format; see read_map_file. The text has no NUL byte and no byte order mark.
[[nodiscard]] Result<MapFile> read_xml_map(const std::string& text, const std::string& file,
                                           const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_nav_graph_text(const std::string& text, const std::string& file,
                                                  const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_lif_text(const std::string& text, const std::string& file,
                                            const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_route_graph(const std::string& text, const std::string& file,
                                               const MapFileOptions& options);
[[nodiscard]] Result<MapFile> read_gml(const std::string& text, const std::string& file,
                                       const MapFileOptions& options);

/// What the readers of JSON, YAML and GML have in common. Functions say whether all is well.
class DocumentRoadmapReader {
 protected:
  using Node = text::Document::Node;

  /// Both outlive it.
  DocumentRoadmapReader(const text::Document& document, const MapFileOptions& options)
      : document_(document),
        check_(document),
        objects_(document, check_),
        options_(options),
        builder_(options) {}

  /// What the builder said of something that stands at `node`.
  bool accept(Node node, const std::optional<RoadmapBuilder::Fault>& fault) {
    return !fault || check_.fail(node, fault->code, fault->message);
  }

  const text::Document& document_;
  text::Checker check_;
  text::OpenObjects objects_;
  const MapFileOptions& options_;
  RoadmapBuilder builder_;
};

}  // namespace quadrille::continuous
