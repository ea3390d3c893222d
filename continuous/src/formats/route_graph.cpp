// SPDX-License-Identifier: MIT
//
// Graphs of Nav2's route server: GeoJSON in a frame of the robot's, in metres. Points are nodes,
// and lines are edges that lead one way.
#include <utility>

#include "formats/roadmap_readers.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;

class RouteGraphReader : DocumentRoadmapReader {
 public:
  RouteGraphReader(const Document& document, const MapFileOptions& options)
      : DocumentRoadmapReader(document, options) {}

  Result<MapFile> run() {
    std::optional<Node> type, features;
    std::string_view text;
    if (!objects_.find_all(Document::kRoot, "GeoJSON",
                           {{"type", &type}, {"features", &features}}) ||
        !check_.text(*type, text))
      return check_.error();
    if (text != "FeatureCollection") {
      check_.fail(*type, "expected 'FeatureCollection', found " + text::in_quotes(text));
      return check_.error();
    }
    // Edges may come before their nodes.
    for (const bool is_node : {true, false})
      if (!objects_.each_element(*features, "features",
                                 [&](Node feature) { return read_feature(feature, is_node); }))
        return check_.error();
    return std::move(builder_).finish(document_.file());
  }

 private:
  bool read_feature(Node feature, bool wants_node) {
    std::optional<Node> type, properties, geometry, shape, coordinates;
    std::string_view kind;
    if (!objects_.find_all(
            feature, "a feature",
            {{"type", &type, false}, {"properties", &properties}, {"geometry", &geometry}}) ||
        !objects_.find_all(*geometry, "a geometry",
                           {{"type", &shape}, {"coordinates", &coordinates}}) ||
        !check_.text(*shape, kind))
      return false;
    if (kind == "Point") return !wants_node || read_node(*properties, *coordinates);
    if (kind == "LineString" || kind == "MultiLineString")
      return wants_node || read_edge(feature, *properties);
    if (wants_node) builder_.not_used("a feature of the type " + text::in_quotes(kind));
    return true;
  }

  /// An id is a natural number; some tools write it as 7.0 or as a text.
  bool read_id(Node node, std::string& id) {
    std::int64_t number = 0;
    if (document_.kind(node) == Document::Kind::string) {
      id = document_.text(node);
      return !id.empty() || check_.fail(node, "the id is empty");
    }
    if (!check_.integer(node, 0, INT64_MAX, number)) return false;
    id = std::to_string(number);
    return true;
  }

  bool read_node(Node properties, Node coordinates) {
    std::optional<Node> id_node, frame;
    std::string id;
    std::array<double, 3> at{};
    std::size_t axis = 0;
    if (!objects_.find_all(properties, "a node", {{"id", &id_node}, {"frame", &frame, false}},
                           [&](Node key) { unused(key, "a node"); }) ||
        !read_id(*id_node, id) || !read_frame(frame) ||
        !objects_.each_element(coordinates, "numbers", [&](Node n) {
          return axis < at.size() ? check_.number(n, at[axis++])
                                  : check_.fail(n, "expected two coordinates");
        }))
      return false;
    if (axis < 2) return check_.fail(coordinates, "expected two coordinates");
    if (at[2] != 0) builder_.not_used("the height of a node");
    return accept(coordinates, builder_.add_vertex(std::move(id), {at[0], at[1], 0}));
  }

  /// Coordinates mean the same everywhere only in one frame.
  bool read_frame(std::optional<Node> frame) {
    if (!frame) return true;
    std::string_view name;
    if (!check_.text(*frame, name)) return false;
    if (frame_.empty()) frame_ = name;
    return name == frame_ || check_.fail(*frame, ErrorCode::invalid_instance,
                                         "the frame " + text::in_quotes(name) +
                                             ", and another node is in " + text::in_quotes(frame_));
  }

  bool read_edge(Node feature, Node properties) {
    std::optional<Node> id, from_node, to_node, metadata, limit;
    std::string from, to;
    double speed = 0;
    if (!objects_.find_all(properties, "an edge",
                           {{"id", &id, false},
                            {"startid", &from_node},
                            {"endid", &to_node},
                            {"metadata", &metadata, false}},
                           [&](Node key) { unused(key, "an edge"); }) ||
        !read_id(*from_node, from) || !read_id(*to_node, to) ||
        (metadata && !objects_.find_all(*metadata, "metadata", {{"speed_limit", &limit, false}})) ||
        (limit && !check_.number(*limit, speed)))
      return false;
    return accept(feature,
                  builder_.add_edge(from, to, limit ? std::optional(speed) : std::nullopt));
  }

  void unused(Node key, std::string_view of) {
    const std::string_view name = document_.text(key);
    if (name == "metadata" || name == "overridable") return;
    builder_.not_used("'" + text::printable(name, 40) + "' of " + std::string(of));
  }

  std::string frame_;
};

}  // namespace

Result<MapFile> read_route_graph(const std::string& text, const std::string& file,
                                 const MapFileOptions& options) {
  const auto document = text::parse_json(text, file);
  if (!document) return document.error();
  return RouteGraphReader(*document, options).run();
}

}  // namespace quadrille::continuous
