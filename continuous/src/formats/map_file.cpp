// SPDX-License-Identifier: MIT
#include "quadrille/continuous/map_file.hpp"

#include <fstream>
#include <istream>

#include "formats/roadmap_readers.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {

Result<MapFile> read_map_file(std::istream& in, const std::string& file,
                              const MapFileOptions& options) {
  using text::FileKind;
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  switch (const FileKind kind = text::sniff(*text)) {
    case FileKind::lif:
      return read_lif_text(*text, file, options);
    case FileKind::geojson:
      return read_route_graph(*text, file, options);
    case FileKind::gml:
      return read_gml(*text, file, options);
    case FileKind::nav_graph:
      return read_nav_graph_text(*text, file, options);
    case FileKind::unknown:
    case FileKind::graphml:
    case FileKind::ccbs_grid:
    case FileKind::ccbs_log:  // CCBS repeats the map there.
      break;
    default:
      return Error{ErrorCode::syntax, text::describe(kind), {file, 1}};
  }
  // What is left is XML, or unknown.
  const std::string_view name(file);
  if (name.ends_with(".yaml") || name.ends_with(".yml"))
    return read_nav_graph_text(*text, file, options);
  return read_xml_map(*text, file, options);
}

Result<MapFile> read_map_file(const std::filesystem::path& path, const MapFileOptions& options) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  return read_map_file(in, path.string(), options);
}

}  // namespace quadrille::continuous
