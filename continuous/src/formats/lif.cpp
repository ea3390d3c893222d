// SPDX-License-Identifier: MIT
//
// VDMA's Layout Interchange Format 1.0: JSON with layouts, of which one is read, with nodes, edges
// that lead one way, and stations. Lengths are metres.
#include "quadrille/continuous/lif.hpp"

#include <fstream>
#include <set>
#include <utility>

#include "formats/lif_headings.hpp"
#include "formats/roadmap_readers.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + text::in_quotes(name);
  return text;
}

class LifReader : DocumentRoadmapReader {
 public:
  LifReader(const Document& document, const MapFileOptions& options)
      : DocumentRoadmapReader(document, options) {}

  Result<MapFile> run() {
    std::optional<Node> meta, layouts;
    if (!objects_.find_all(Document::kRoot, "a LIF",
                           {{"metaInformation", &meta}, {"layouts", &layouts}},
                           [&](Node key) { unused(key, "a LIF"); }) ||
        !read_version(*meta) || !find_layout(*layouts) || !read_layout(*layout_))
      return check_.error();
    headings_.finish();
    return std::move(builder_).finish(document_.file());
  }

 private:
  void unused(Node key, std::string_view of) {
    const std::string name(document_.text(key));
    // Texts for people, and what says nothing about where robots go.
    for (const char* const known : {"Name", "Description", "Version", "mapId"})
      if (name.ends_with(known)) return;
    builder_.not_used("'" + text::printable(name, 40) + "' of " + std::string(of));
  }
  bool read_text(Node node, std::string& text) {
    std::string_view view;
    if (!check_.text(node, view)) return false;
    text = view;
    return true;
  }

  bool read_version(Node meta) {
    std::optional<Node> version;
    std::string text;
    if (!objects_.find_all(meta, "metaInformation", {{"lifVersion", &version}}) ||
        !read_text(*version, text))
      return false;
    return text.starts_with("1.") || text == "1" || text.starts_with("0.") ||
           check_.fail(*version, "version " + text::in_quotes(text) + " of LIF, not 1.0");
  }

  /// The only layout, or the one whose id or level is asked for.
  bool find_layout(Node layouts) {
    std::set<std::string> names;
    std::size_t found = 0;
    const bool is_fine = objects_.each_element(layouts, "layouts", [&](Node layout) {
      std::optional<Node> id, level;
      std::string name, level_name;
      if (!objects_.find_all(layout, "a layout",
                             {{"layoutId", &id}, {"layoutLevelId", &level, false}}) ||
          !read_text(*id, name) || (level && !read_text(*level, level_name)))
        return false;
      names.insert(name);
      if (!options_.level.empty() && options_.level != name && options_.level != level_name)
        return true;
      ++found;
      layout_ = layout;
      return true;
    });
    if (!is_fine || found == 1) return is_fine;
    const std::string all = names.empty() ? "" : ": " + listed(names);
    if (options_.level.empty())
      return check_.fail(layouts, ErrorCode::invalid_instance,
                         names.empty()
                             ? "there is no layout"
                             : "there are several layouts, --level says which is meant" + all);
    return check_.fail(layouts, ErrorCode::invalid_instance,
                       (found == 0 ? "no layout is called " : "several layouts are called ") +
                           text::in_quotes(options_.level) + all);
  }

  bool read_layout(Node layout) {
    std::optional<Node> id, level, nodes, edges, stations;
    if (!objects_.find_all(layout, "a layout",
                           {{"layoutId", &id},
                            {"layoutLevelId", &level, false},
                            {"nodes", &nodes},
                            {"edges", &edges},
                            {"stations", &stations, false}},
                           [&](Node key) { unused(key, "a layout"); }) ||
        !find_types(*nodes, "a node", "vehicleTypeNodeProperties") ||
        !find_types(*edges, "an edge", "vehicleTypeEdgeProperties") || !choose_type(layout))
      return false;
    return objects_.each_element(*nodes, "nodes", [&](Node n) { return read_node(n); }) &&
           objects_.each_element(*edges, "edges", [&](Node e) { return read_edge(e); }) &&
           (!stations ||
            objects_.each_element(*stations, "stations", [&](Node s) { return read_station(s); }));
  }

  /// Which types of vehicles there are.
  bool find_types(Node list, std::string_view what, std::string_view key) {
    return objects_.each_element(list, std::string(what) + "s", [&](Node item) {
      std::optional<Node> properties;
      return objects_.find_all(item, what, {{key, &properties}}) &&
             each_type(*properties, [&](const std::string& type, Node) {
               types_.insert(type);
               return true;
             });
    });
  }
  template <class Visit>
  bool each_type(Node properties, const Visit& visit) {
    std::size_t count = 0;
    const bool is_fine = objects_.each_element(properties, "vehicle types", [&](Node entry) {
      std::optional<Node> id;
      std::string type;
      ++count;
      return objects_.find_all(entry, "a vehicle type", {{"vehicleTypeId", &id}}) &&
             read_text(*id, type) && visit(type, entry);
    });
    return is_fine && (count > 0 || check_.fail(properties, "this must not be empty in a LIF"));
  }
  bool choose_type(Node layout) {
    if (options_.vehicle_type.empty()) {
      if (types_.size() > 1)
        return check_.fail(layout, ErrorCode::invalid_instance,
                           "there are several types of vehicles, --vehicle-type says which is "
                           "meant: " +
                               listed(types_));
      if (!types_.empty()) type_ = *types_.begin();
      return true;
    }
    type_ = options_.vehicle_type;
    return types_.contains(type_) ||
           check_.fail(layout, ErrorCode::invalid_instance,
                       "no type of vehicles is called " + text::in_quotes(type_) + ", only " +
                           listed(types_));
  }

  /// The properties for our type; null if it may not go there.
  bool find_ours(Node properties, std::optional<Node>& ours) {
    return each_type(properties, [&](const std::string& type, Node entry) {
      if (type != type_) return true;
      if (ours) return check_.fail(entry, "this type of vehicles is there twice");
      ours = entry;
      return true;
    });
  }

  bool read_node(Node node) {
    std::optional<Node> id, position, properties, ours, theta, x, y;
    std::string name;
    double at_x = 0, at_y = 0;
    if (!objects_.find_all(node, "a node",
                           {{"nodeId", &id},
                            {"nodePosition", &position},
                            {"vehicleTypeNodeProperties", &properties}},
                           [&](Node key) { unused(key, "a node"); }) ||
        !read_text(*id, name) || !find_ours(*properties, ours) ||
        !objects_.find_all(*position, "a position", {{"x", &x}, {"y", &y}}) ||
        !check_.number(*x, at_x) || !check_.number(*y, at_y))
      return false;
    if (!ours) closed_.insert(VertexId(builder_.num_vertices()));
    if (ours && !objects_.find_all(*ours, "a vehicle type",
                                   {{"vehicleTypeId", &id_again_, false}, {"theta", &theta, false}},
                                   [&](Node key) { unused(key, "a node"); }))
      return false;
    id_again_.reset();
    if (theta && !read_theta(*theta)) return false;
    return accept(node, builder_.add_vertex(std::move(name), {at_x, at_y, 0}));
  }

  bool read_edge(Node edge) {
    std::optional<Node> id, from_node, to_node, properties, ours, type, limit;
    LifHeadings::Edge facing;
    std::string from, to;
    if (!objects_.find_all(edge, "an edge",
                           {{"edgeId", &id},
                            {"startNodeId", &from_node},
                            {"endNodeId", &to_node},
                            {"vehicleTypeEdgeProperties", &properties}},
                           [&](Node key) { unused(key, "an edge"); }) ||
        !read_text(*from_node, from) || !read_text(*to_node, to) || !find_ours(*properties, ours))
      return false;
    if (!ours) return true;
    if (!objects_.find_all(*ours, "a vehicle type",
                           {{"vehicleTypeId", &type},
                            {"maxSpeed", &limit, false},
                            {"vehicleOrientation", &facing.orientation, false},
                            {"orientationType", &facing.type, false},
                            {"rotationAllowed", &facing.on_edge, false},
                            {"rotationAtStartNodeAllowed", &facing.at_start, false},
                            {"rotationAtEndNodeAllowed", &facing.at_end, false},
                            {"maxRotationSpeed", &facing.most, false}},
                           [&](Node key) { unused(key, "an edge"); }))
      return false;
    double speed = 0;
    if (limit && !check_.number(*limit, speed)) return false;
    const auto source = builder_.find(from), target = builder_.find(to);
    if (source && !target && has_node(to)) {
      builder_.not_used("an edge to another layout");
      return true;
    }
    if ((source && closed_.contains(*source)) || (target && closed_.contains(*target))) return true;
    if (!accept(edge, builder_.add_edge(from, to, limit ? std::optional(speed) : std::nullopt)))
      return false;
    return headings_.add_edge(facing, *source, *target);
  }

  bool read_theta(Node theta) {
    return headings_.add_stand(theta, VertexId(builder_.num_vertices()));
  }

  [[nodiscard]] bool is_text(Node node) const {
    return document_.kind(node) == Document::Kind::string;
  }
  /// Whether some other layout has a node of this id.
  bool has_node(const std::string& name) {
    if (all_nodes_.empty()) {
      const Node end = document_.next(Document::kRoot);
      for (Node n = document_.first(Document::kRoot); n + 1 < end; ++n)
        if (is_text(n) && document_.text(n) == "nodeId" && is_text(n + 1))
          all_nodes_.emplace(document_.text(n + 1));
    }
    return all_nodes_.contains(name);
  }

  /// A station is a name of each of its interaction nodes; a task can use it if there is one.
  bool read_station(Node station) {
    std::optional<Node> id, nodes;
    std::string name;
    if (!objects_.find_all(station, "a station",
                           {{"stationId", &id}, {"interactionNodeIds", &nodes}}) ||
        !read_text(*id, name))
      return false;
    return objects_.each_element(*nodes, "ids of nodes", [&](Node n) {
      std::string node;
      if (!read_text(n, node)) return false;
      const auto vertex = builder_.find(node);
      if (!vertex)
        return check_.fail(n, ErrorCode::invalid_instance,
                           "there is no node " + text::in_quotes(node));
      builder_.add_place(name, *vertex);
      return true;
    });
  }

  LifHeadings headings_{check_, options_, builder_};
  std::optional<Node> layout_, id_again_;
  std::set<std::string> types_, all_nodes_;
  std::set<VertexId> closed_;  // To our type.
  std::string type_;
};

}  // namespace

Result<MapFile> read_lif_text(const std::string& text, const std::string& file,
                              const MapFileOptions& options) {
  const auto document = text::parse_json(text, file);
  if (!document) return document.error();
  return LifReader(*document, options).run();
}

Result<MapFile> read_lif(std::istream& in, const std::string& file, const MapFileOptions& options) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(*text, file, {text::FileKind::lif})) return *error;
  return read_lif_text(*text, file, options);
}

Result<MapFile> read_lif(const std::filesystem::path& path, const MapFileOptions& options) {
  std::ifstream in;
  if (const auto error = text::open_input(path, in)) return *error;
  return read_lif(in, path.string(), options);
}

}  // namespace quadrille::continuous
