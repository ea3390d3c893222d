// SPDX-License-Identifier: MIT
//
// Graphs in GML, as networkx, igraph, Gephi and yEd write them.
#include <utility>

#include "formats/roadmap_readers.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;

class GmlReader : DocumentRoadmapReader {
 public:
  GmlReader(const Document& document, const MapFileOptions& options)
      : DocumentRoadmapReader(document, options) {}

  Result<MapFile> run() {
    std::optional<Node> graph, directed;
    std::int64_t is_directed = 0;
    if (!objects_.find_all(Document::kRoot, "GML", {{"graph", &graph}}) ||
        document_.kind(*graph) != Document::Kind::object) {
      if (graph) check_.fail(*graph, "expected a graph in brackets");
      return check_.error();
    }
    const auto visit_all = [&](std::string_view what, auto visit) {
      return objects_.each_member(*graph, "a graph", [&](Node key, Node value) {
        return document_.text(key) != what || visit(value);
      });
    };
    const auto read_directed = [&](Node value) {
      return !directed.has_value() ? (directed = value, check_.integer(value, 0, 1, is_directed))
                                   : check_.fail(value, "the key is there twice");
    };
    if (!visit_all("directed", read_directed) ||
        !visit_all("node", [&](Node node) { return read_node(node); }) ||
        !visit_all("edge", [&](Node edge) { return read_edge(edge, is_directed != 0); }))
      return check_.error();
    return std::move(builder_).finish(document_.file());
  }

 private:
  /// Coordinates are x, y and perhaps z of a node, or of its graphics; or two or three times pos.
  bool read_node(Node node) {
    std::optional<Node> id_node, label, x, y, z, graphics;
    std::array<double, 3> at{};
    std::size_t num_pos = 0;
    std::int64_t id = 0;
    const bool is_fine = objects_.each_member(node, "a node", [&](Node key, Node value) {
      if (document_.text(key) != "pos") return true;
      if (num_pos == at.size()) return check_.fail(key, "a fourth coordinate");
      return check_.number(value, at[num_pos++]);
    });
    if (!is_fine || !find_node(node, id_node, label, x, y, z, graphics) ||
        !check_.integer(*id_node, INT64_MIN, INT64_MAX, id))
      return false;
    if (!x && !y && graphics && !find_coordinates(*graphics, x, y, z)) return false;
    if (x.has_value() != y.has_value() || (!x && num_pos < 2))
      return check_.fail(node, ErrorCode::invalid_instance,
                         "the node has no place: neither x and y, nor pos");
    if (x && (!check_.number(*x, at[0]) || !check_.number(*y, at[1]))) return false;
    if (x && z && !check_.number(*z, at[2])) return false;
    if (x && !z) at[2] = 0;
    if (at[2] != 0 && !has_heights_) {
      has_heights_ = true;
      builder_.note("z, and the third pos, are read as heights");
    }
    const VertexId vertex(builder_.num_vertices());
    if (label && document_.kind(*label) == Document::Kind::string)
      builder_.add_place(std::string(document_.text(*label)), vertex);
    return accept(node, builder_.add_vertex(std::to_string(id), at));
  }

  bool find_node(Node node, std::optional<Node>& id, std::optional<Node>& label,
                 std::optional<Node>& x, std::optional<Node>& y, std::optional<Node>& z,
                 std::optional<Node>& graphics) {
    return objects_.find_all(node, "a node",
                             {{"id", &id},
                              {"label", &label, false},
                              {"x", &x, false},
                              {"y", &y, false},
                              {"z", &z, false},
                              {"graphics", &graphics, false}});
  }
  bool find_coordinates(Node graphics, std::optional<Node>& x, std::optional<Node>& y,
                        std::optional<Node>& z) {
    return objects_.find_all(graphics, "graphics",
                             {{"x", &x, false}, {"y", &y, false}, {"z", &z, false}});
  }

  bool read_edge(Node edge, bool is_directed) {
    std::optional<Node> ends[2];
    if (!objects_.find_all(edge, "an edge", {{"source", &ends[0]}, {"target", &ends[1]}}))
      return false;
    std::int64_t ids[2] = {0, 0};
    for (const std::size_t end : {0U, 1U})
      if (!check_.integer(*ends[end], INT64_MIN, INT64_MAX, ids[end])) return false;
    auto fault = builder_.add_edge(std::to_string(ids[0]), std::to_string(ids[1]));
    if (!fault && !is_directed)
      fault = builder_.add_edge(std::to_string(ids[1]), std::to_string(ids[0]));
    return accept(edge, fault);
  }

  bool has_heights_ = false;
};

}  // namespace

Result<MapFile> read_gml(const std::string& text, const std::string& file,
                         const MapFileOptions& options) {
  const auto document = text::parse_gml(text, file);
  if (!document) return document.error();
  return GmlReader(*document, options).run();
}

}  // namespace quadrille::continuous
