// SPDX-License-Identifier: MIT
//
// GraphML in the three ways in which people have places in it: coords "x,y" or "x,y,z" of a node
// (OMPL, CCBS), keys of their own for x, y and z (networkx, Gephi), and pictures of nodes (yEd).
#include "formats/graphml.hpp"

#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "formats/roadmap_builder.hpp"

namespace quadrille::continuous {
namespace {

class GraphmlReader {
 public:
  GraphmlReader(const XmlFile& xml, const MapFileOptions& options) : xml_(xml), builder_(options) {}

  Result<MapFile> read() {
    if (auto error = xml_.misplaced({{"graphml"},
                                     {"graphml", "key"},
                                     {"graphml", "graph"},
                                     {"graphml", "graph", "node"},
                                     {"graphml", "graph", "edge"}}))
      return *error;
    if (auto error = find_keys()) return *error;
    const auto graph = xml_.only_child(xml_.root(), "graph");
    if (!graph) return graph.error();
    if (!*graph) return xml_.error(xml_.root(), "there is no <graph>");
    const std::string_view edges = graph->attribute("edgedefault").value();
    if (edges != "directed" && edges != "undirected")
      return xml_.error(*graph, "edgedefault has to be \"directed\" or \"undirected\"");
    for (const pugi::xml_node node : graph->children("node"))
      if (auto error = read_node(node)) return *error;
    for (const pugi::xml_node edge : graph->children("edge"))
      if (auto error = read_edge(edge, edges == "directed")) return *error;
    return std::move(builder_).finish(xml_.file());
  }

 private:
  enum Role { coords, x, y, z, picture, label, num_roles };
  static constexpr std::array<const char*, num_roles> kNames = {"coords", "x",     "y",
                                                                "z",      nullptr, "label"};

  static std::optional<Role> role_of(const pugi::xml_node& key) {
    const std::string_view of = key.attribute("for").value();
    if (of != "node" && of != "all") return std::nullopt;
    if (std::string_view(key.attribute("yfiles.type").value()) == "nodegraphics") return picture;
    for (int role = 0; role < num_roles; ++role)
      if (kNames[static_cast<std::size_t>(role)] != nullptr &&
          key.attribute("attr.name").value() ==
              std::string_view(kNames[static_cast<std::size_t>(role)]))
        return static_cast<Role>(role);
    return std::nullopt;
  }

  std::optional<Error> find_keys() {
    std::set<std::string_view> ids;
    for (const pugi::xml_node key : xml_.root().children("key")) {
      const std::string_view id = key.attribute("id").value();
      if (!ids.insert(id).second)
        return xml_.error(key,
                          "there is a second <key> with the id " + quoted(std::string_view(id)));
      const auto role = role_of(key);
      if (!role) continue;
      const std::string what = *role == picture ? "nodegraphics" : kNames[*role];
      if (!keys_[*role].empty()) return xml_.error(key, "there is a second <key> for " + what);
      if (id.empty()) return xml_.error(key, "the <key> for " + what + " has no id");
      keys_[*role] = id;
    }
    if (keys_[coords].empty() && (keys_[x].empty() || keys_[y].empty()) && keys_[picture].empty())
      return xml_.error(xml_.root(),
                        "nodes have no places: there is no <key for=\"node\"> with the attr.name "
                        "coords, or x and y, nor pictures of yEd");
    return std::nullopt;
  }

  /// The node's <data> with that role; null if there is none.
  Result<pugi::xml_node> data(const pugi::xml_node& node, Role role) const {
    pugi::xml_node found;
    if (keys_[role].empty()) return found;
    for (const pugi::xml_node data : node.children("data")) {
      if (keys_[role] != data.attribute("key").value()) continue;
      if (found)
        return xml_.error(data, role == label ? "the label of a node is given twice"
                                              : "the coordinates of a node are given twice");
      found = data;
    }
    return found;
  }

  std::optional<Error> read_node(const pugi::xml_node& node) {
    const std::string id = node.attribute("id").value();
    if (id.empty()) return xml_.error(node, "a node without an id");
    std::array<double, 3> at{};
    const auto error = !keys_[coords].empty()                 ? read_coords(node, id, at)
                       : keys_[x].empty() || keys_[y].empty() ? read_picture(node, id, at)
                                                              : read_xyz(node, id, at);
    if (error) return error;
    const VertexId vertex(builder_.num_vertices());
    if (const auto fault = builder_.add_vertex(id, at))
      return xml_.error(node, "node " + quoted(std::string_view(id)) + ": " + fault->message,
                        fault->code);
    const auto name = data(node, label);
    if (!name) return name.error();
    const auto text = xml_.text(*name);
    if (*name && text && !text->empty()) builder_.add_place(std::string(*text), vertex);
    return std::nullopt;
  }

  Error no_place(const pugi::xml_node& node, const std::string& id, std::string_view text,
                 const char* form) const {
    return xml_.error(node, "node " + quoted(std::string_view(id)) + " has the coordinates " +
                                quoted(text) + ", not " + form);
  }

  std::optional<Error> read_coords(const pugi::xml_node& node, const std::string& id,
                                   std::array<double, 3>& at) {
    const auto found = data(node, coords);
    if (!found) return found.error();
    const auto text = xml_.text(*found);
    if (!text) return text.error();
    std::string_view rest = *text;
    std::size_t axis = 0;
    for (bool more = true; more; ++axis) {
      const auto comma = rest.find(',');
      more = comma != std::string_view::npos;
      const auto number = parse_number(rest.substr(0, comma));
      if (!number || axis == at.size())
        return no_place(node, id, *text, "two or three finite numbers");
      at[axis] = *number;
      if (more) rest.remove_prefix(comma + 1);
    }
    if (axis < 2) return no_place(node, id, *text, "two or three finite numbers");
    if (axis == 3) note_heights("the third number of coords");
    return std::nullopt;
  }

  std::optional<Error> read_xyz(const pugi::xml_node& node, const std::string& id,
                                std::array<double, 3>& at) {
    for (const Role axis : {x, y, z}) {
      const auto found = data(node, axis);
      if (!found) return found.error();
      if (axis == z && !*found) continue;
      const auto text = xml_.text(*found);
      if (!text) return text.error();
      const auto number = parse_number(*text);
      if (!number)
        return xml_.error(node, "node " + quoted(std::string_view(id)) + ": " + kNames[axis] +
                                    " is " + quoted(*text) + ", not a finite number");
      at[static_cast<std::size_t>(axis - x)] = *number;
      if (axis == z) note_heights("z");
    }
    return std::nullopt;
  }

  /// Where a user may have meant something else.
  void note_heights(const std::string& what) {
    if (has_heights_) return;
    has_heights_ = true;
    builder_.note(what +
                  " is read as a height; of SE(2) it would be a heading, which is wrong here");
  }

  /// The middle of a picture; yEd's y grows downwards, as that of grids does here.
  std::optional<Error> read_picture(const pugi::xml_node& node, const std::string& id,
                                    std::array<double, 3>& at) {
    const auto found = data(node, picture);
    if (!found) return found.error();
    const pugi::xml_node shape = found->find_child(
        [](const pugi::xml_node& child) { return child.type() == pugi::node_element; });
    const pugi::xml_node geometry = shape.child("y:Geometry");
    std::array<double, 2> sizes{};
    const auto read = [&](const char* name, double& value) {
      const auto number = parse_number(geometry.attribute(name).value());
      value = number.value_or(0);
      return number.has_value();
    };
    if (!read("x", at[0]) || !read("y", at[1]) || !read("width", sizes[0]) ||
        !read("height", sizes[1]))
      return xml_.error(node, "node " + quoted(std::string_view(id)) +
                                  " has no picture with <y:Geometry x= y= width= height=>");
    at[0] += sizes[0] / 2;
    at[1] += sizes[1] / 2;
    const pugi::xml_node name = shape.child("y:NodeLabel");
    const std::string_view text = name.child_value();
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos) {
      const auto last = text.find_last_not_of(" \t\r\n");
      builder_.add_place(std::string(text.substr(first, last - first + 1)),
                         VertexId(builder_.num_vertices()));
    }
    return std::nullopt;
  }

  std::optional<Error> read_edge(const pugi::xml_node& edge, bool is_directed) {
    const pugi::xml_attribute directed = edge.attribute("directed");
    const std::string_view way = directed ? directed.value() : is_directed ? "true" : "false";
    if (way != "true" && way != "false")
      return xml_.error(edge, "directed is " + quoted(way) + ", neither true nor false");
    const std::string from = edge.attribute("source").value(),
                      to = edge.attribute("target").value();
    auto fault = builder_.add_edge(from, to);
    if (!fault && way == "false") fault = builder_.add_edge(to, from);
    if (!fault) return std::nullopt;
    return xml_.error(edge, fault->message, fault->code);
  }

  const XmlFile& xml_;
  RoadmapBuilder builder_;
  std::array<std::string, num_roles> keys_;
  bool has_heights_ = false;
};

}  // namespace

Result<MapFile> read_graphml(const XmlFile& xml, const MapFileOptions& options) {
  return GraphmlReader(xml, options).read();
}

}  // namespace quadrille::continuous
