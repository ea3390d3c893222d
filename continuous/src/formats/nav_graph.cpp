// SPDX-License-Identifier: MIT
#include "quadrille/continuous/nav_graph.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

using text::Document;
using Node = Document::Node;

class NavGraphReader {
 public:
  NavGraphReader(const Document& document, const Resolution& resolution, Speed speed)
      : document_(document), check_(document), resolution_(resolution), speed_(speed) {}

  Result<NavGraph> run() {
    const auto level = find_level();
    if (!level || !read_level(*level)) return check_.error();
    auto roadmap = Roadmap::make(std::move(positions_), std::move(edges_));
    if (!roadmap) return document_.error(*level, roadmap.error().code, roadmap.error().message);
    return NavGraph{std::move(roadmap).value(), std::move(names_), num_zero_length_edges_};
  }

 private:
  /// Goes through the keys and values of an object until `visit` says that something is wrong.
  template <class Visit>
  bool each_member(Node object, std::string_view what, const Visit& visit) {
    if (document_.kind(object) != Document::Kind::object)
      return check_.fail(object, "expected " + std::string(what));
    for (Node key = document_.first(object); key < document_.next(object);) {
      const Node value = document_.next(key);
      if (!visit(key, value)) return false;
      key = document_.next(value);
    }
    return true;
  }

  /// Of an object with more keys than those that are looked at, the value of one, which may be
  /// missing, but not be there twice.
  bool find(Node object, std::string_view what, std::string_view name, std::optional<Node>& found) {
    return each_member(object, what, [&](Node key, Node value) {
      if (document_.text(key) != name) return true;
      if (found) return check_.fail(key, "the key is there twice");
      found = value;
      return true;
    });
  }

  /// The one with vertices.
  std::optional<Node> find_level() {
    std::optional<Node> levels, level;
    if (!find(Document::kRoot, "a nav graph of Open-RMF", "levels", levels)) return std::nullopt;
    if (!levels) {
      check_.fail(Document::kRoot, "a nav graph of Open-RMF has the key 'levels'");
      return std::nullopt;
    }
    const bool is_good = each_member(*levels, "levels by their names", [&](Node, Node value) {
      std::optional<Node> vertices;
      if (!find(value, "a level", "vertices", vertices)) return false;
      if (!vertices) return check_.fail(value, "a level has the key 'vertices'");
      if (!check_.array(*vertices, "vertices")) return false;
      if (document_.first(*vertices) == document_.next(*vertices)) return true;
      if (level)
        return check_.fail(value, ErrorCode::invalid_instance,
                           "a roadmap is of one level, and this is another");
      level = value;
      return true;
    });
    if (!is_good) return std::nullopt;
    if (!level) check_.fail(*levels, ErrorCode::invalid_instance, "there are no vertices");
    return level;
  }

  bool read_level(Node level) {
    std::optional<Node> vertices, lanes;
    if (!find(level, "a level", "vertices", vertices) || !find(level, "a level", "lanes", lanes))
      return false;
    for (Node v = document_.first(*vertices); v < document_.next(*vertices); v = document_.next(v))
      if (!read_vertex(v)) return false;
    if (!lanes) return true;
    if (!check_.array(*lanes, "lanes")) return false;
    for (Node l = document_.first(*lanes); l < document_.next(*lanes); l = document_.next(l))
      if (!read_lane(l)) return false;
    return true;
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
    return each_member(*item.properties, form, [&](Node key, Node value) {
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

  bool read_coordinate(Node node, Length& length) {
    double value = 0;
    if (!read_number(node, value)) return false;
    const auto units = quantise_coordinate(value, resolution_);
    if (!units) return check_.fail(node, ErrorCode::out_of_range, "the coordinate is too large");
    length = *units;
    return true;
  }

  bool read_vertex(Node node) {
    Item item;
    Point point;
    std::optional<Node> name;
    if (!read_item(node, "[x, y, {properties}]", item) || !read_coordinate(item.first, point.x) ||
        !read_coordinate(item.second, point.y) ||
        (item.properties && !find(*item.properties, "properties", "name", name)))
      return false;
    std::string_view text;
    if (name && !check_.text(*name, text)) return false;
    positions_.push_back(point);
    names_.emplace_back(text);
    return true;
  }

  bool read_end(Node node, VertexId& vertex) {
    std::int64_t number = 0;
    if (!check_.integer(node, 0, INT64_MAX, number)) return false;
    if (static_cast<std::size_t>(number) >= positions_.size())
      return check_.fail(node, ErrorCode::invalid_instance,
                         "there is no vertex " + std::to_string(number) + " among " +
                             std::to_string(positions_.size()));
    vertex = VertexId(static_cast<std::size_t>(number));
    return true;
  }

  bool read_lane(Node node) {
    Item item;
    Edge edge;
    std::optional<Node> limit;
    if (!read_item(node, "[from, to, {properties}]", item) || !read_end(item.first, edge.from) ||
        !read_end(item.second, edge.to) ||
        (item.properties && !find(*item.properties, "properties", "speed_limit", limit)))
      return false;
    if (edge.from == edge.to)
      return check_.fail(node, ErrorCode::invalid_instance, "the lane is a loop");
    if (positions_[edge.from.index()] == positions_[edge.to.index()]) {
      edge.duration = Ticks(1);
      ++num_zero_length_edges_;
    } else if (limit && !read_speed_limit(*limit, edge)) {
      return false;
    }
    edges_.push_back(edge);
    return true;
  }

  bool read_speed_limit(Node node, Edge& edge) {
    double value = 0;
    if (!read_number(node, value)) return false;
    if (value == 0) return true;  // Open-RMF writes 0 for none.
    const auto most = quantise_speed(value, resolution_);
    if (!most) return check_.fail(node, ErrorCode::out_of_range, "the speed is not supported");
    if (*most >= speed_) return true;
    edge.duration = travel_time(positions_[edge.from.index()], positions_[edge.to.index()], *most);
    return edge.duration ||
           check_.fail(node, ErrorCode::out_of_range, "the lane takes too long at this speed");
  }

  const Document& document_;
  text::Checker check_;
  const Resolution& resolution_;
  const Speed speed_;
  std::vector<Point> positions_;
  std::vector<std::string> names_;
  std::vector<Edge> edges_;
  std::size_t num_zero_length_edges_ = 0;
};

}  // namespace

Result<NavGraph> read_nav_graph(std::istream& in, const std::string& file,
                                const Resolution& resolution, Speed speed) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  const auto document = text::parse_yaml(*text, file);
  if (!document) return document.error();
  return NavGraphReader(*document, resolution, speed).run();
}

Result<NavGraph> read_nav_graph(const std::filesystem::path& path, const Resolution& resolution,
                                Speed speed) {
  std::ifstream in;
  if (const auto error = text::open_input(path, in)) return *error;
  return read_nav_graph(in, path.string(), resolution, speed);
}

}  // namespace quadrille::continuous
