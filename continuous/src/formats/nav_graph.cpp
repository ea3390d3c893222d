// SPDX-License-Identifier: MIT
#include "quadrille/continuous/nav_graph.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/roadmap_readers.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/names.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;

class NavGraphReader : DocumentRoadmapReader {
 public:
  NavGraphReader(const Document& document, const MapFileOptions& options)
      : DocumentRoadmapReader(document, options) {}

  Result<MapFile> run() {
    const auto level = find_level();
    if (!level || !read_level(*level)) return check_.error();
    auto map = std::move(builder_).finish(document_.file());
    if (!map) return document_.error(*level, map.error().code, map.error().message);
    return map;
  }

 private:
  struct Level {
    std::string name;
    Node node;
  };
  static std::string listed(const std::vector<Level>& levels) {
    std::string text;
    for (const Level& level : levels)
      text += (text.empty() ? "" : ", ") + text::in_quotes(level.name);
    return text;
  }

  /// The one with vertices, or the one that is asked for.
  std::optional<Node> find_level() {
    std::optional<Node> levels;
    std::vector<Level> with_vertices;
    if (!objects_.find_all(Document::kRoot, "a nav graph of Open-RMF", {{"levels", &levels}}))
      return std::nullopt;
    const bool is_good =
        objects_.each_member(*levels, "levels by their names", [&](Node key, Node value) {
          std::optional<Node> vertices;
          if (!objects_.find_all(value, "a level", {{"vertices", &vertices}}) ||
              !check_.array(*vertices, "vertices"))
            return false;
          if (document_.first(*vertices) != document_.next(*vertices))
            with_vertices.push_back({std::string(document_.text(key)), value});
          return true;
        });
    if (!is_good) return std::nullopt;
    if (options_.level.empty() && with_vertices.size() == 1) return with_vertices.front().node;
    for (const Level& level : with_vertices)
      if (level.name == options_.level) return level.node;
    const std::string names = listed(with_vertices);
    const std::string why =
        names.empty() ? "there are no vertices"
        : options_.level.empty()
            ? "there are several levels with vertices, --level says which is meant: " + names
            : "no level with vertices is called " + text::in_quotes(options_.level) + ", only " +
                  names;
    check_.fail(*levels, ErrorCode::invalid_instance, why);
    return std::nullopt;
  }

  bool read_level(Node level) {
    std::optional<Node> vertices, lanes;
    if (!objects_.find_all(level, "a level", {{"vertices", &vertices}, {"lanes", &lanes, false}}) ||
        !objects_.each_element(*vertices, "vertices", [&](Node v) { return read_vertex(v); }))
      return false;
    return !lanes ||
           objects_.each_element(*lanes, "lanes", [&](Node lane) { return read_lane(lane); });
  }

  /// The first two elements of a vertex or a lane, and its properties.
  struct Item {
    Node first = 0, second = 0;
    std::optional<Node> properties;
  };
  bool read_item(Node node, const std::string& form, Item& item) {
    const Node end = document_.next(node);
    std::size_t size = 0;
    if (document_.kind(node) == Document::Kind::array)
      for (Node n = document_.first(node); n < end; n = document_.next(n)) {
        if (size == 0) item.first = n;
        if (size == 1) item.second = n;
        if (size == 2) item.properties = n;
        ++size;
      }
    if (size < 2 || size > 3) return check_.fail(node, "expected " + form);
    if (!item.properties) return true;
    return objects_.each_member(*item.properties, form, [&](Node key, Node value) {
      const bool is_empty =
          document_.kind(value) == Document::Kind::null ||
          (document_.kind(value) == Document::Kind::string && document_.text(value).empty());
      if (is_empty || !document_.text(key).starts_with("mutex")) return true;
      return check_.fail(key, ErrorCode::invalid_instance, "mutex groups are not supported");
    });
  }

  /// Plain scalars of YAML that are no integers are texts.
  bool read_number(Node node, double& value) {
    if (document_.kind(node) != Document::Kind::string) return check_.number(node, value);
    const std::string_view text = document_.text(node);
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem == std::errc() && end == text.data() + text.size() && std::isfinite(value))
      return true;
    return check_.fail(node, "expected a number, found " + text::in_quotes(text));
  }

  bool read_flag(Node node, bool& value) {
    if (document_.kind(node) == Document::Kind::string)
      for (const auto& [word, meaning] : {std::pair<std::string_view, bool>{"true", true},
                                          {"True", true},
                                          {"false", false},
                                          {"False", false}})
        if (document_.text(node) == word) {
          value = meaning;
          return true;
        }
    return check_.fail(node, "expected true or false");
  }

  bool read_vertex(Node node) {
    Item item;
    double x = 0, y = 0;
    std::optional<Node> name, passes;
    bool is_passed = false;
    if (!read_item(node, "[x, y, {properties}]", item) || !read_number(item.first, x) ||
        !read_number(item.second, y) ||
        (item.properties &&
         !objects_.find_all(*item.properties, "properties",
                            {{"name", &name, false}, {"is_passthrough_point", &passes, false}})) ||
        (passes && !read_flag(*passes, is_passed)))
      return false;
    std::optional<std::string> text;
    if (name && document_.kind(*name) != Document::Kind::null &&
        !text::read_name(check_, document_, *name, text))
      return false;
    const VertexId vertex(builder_.num_vertices());
    if (text && !text->empty()) builder_.add_place(*text, vertex);
    if (is_passed) builder_.forbid_waiting(vertex);
    return accept(node, builder_.add_vertex(std::to_string(vertex.index()), {x, y, 0}));
  }

  bool read_end(Node node, VertexId& vertex) {
    std::int64_t number = 0;
    if (!check_.integer(node, 0, INT64_MAX, number)) return false;
    if (static_cast<std::size_t>(number) >= builder_.num_vertices())
      return check_.fail(node, ErrorCode::invalid_instance,
                         "there is no vertex " + std::to_string(number) + " among " +
                             std::to_string(builder_.num_vertices()));
    vertex = VertexId(static_cast<std::size_t>(number));
    return true;
  }

  bool read_lane(Node node) {
    Item item;
    VertexId from, to;
    std::optional<Node> limit, both_ways;
    double speed = 0;
    bool is_both = false;
    if (!read_item(node, "[from, to, {properties}]", item) || !read_end(item.first, from) ||
        !read_end(item.second, to) ||
        (item.properties && !objects_.find_all(*item.properties, "properties",
                                               {{"speed_limit", &limit, false},
                                                {"is_bidirectional", &both_ways, false}})) ||
        (limit && !read_number(*limit, speed)) || (both_ways && !read_flag(*both_ways, is_both)))
      return false;
    if (from == to) return check_.fail(node, ErrorCode::invalid_instance, "the lane is a loop");
    const auto most = limit ? std::optional(speed) : std::nullopt;
    auto fault = builder_.add_edge(from, to, most);
    if (!fault && is_both) fault = builder_.add_edge(to, from, most);
    return accept(limit.value_or(node), fault);
  }
};

}  // namespace

Result<MapFile> read_nav_graph_text(const std::string& text, const std::string& file,
                                    const MapFileOptions& options) {
  const auto document = text::parse_yaml(text, file);
  if (!document) return document.error();
  return NavGraphReader(*document, options).run();
}

Result<MapFile> read_nav_graph(std::istream& in, const std::string& file,
                               const MapFileOptions& options) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(*text, file, {text::FileKind::nav_graph})) return *error;
  return read_nav_graph_text(*text, file, options);
}

Result<MapFile> read_nav_graph(const std::filesystem::path& path, const MapFileOptions& options) {
  std::ifstream in;
  if (const auto error = text::open_input(path, in)) return *error;
  return read_nav_graph(in, path.string(), options);
}

}  // namespace quadrille::continuous
