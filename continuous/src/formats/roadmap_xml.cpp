// SPDX-License-Identifier: MIT
#include "quadrille/continuous/roadmap_xml.hpp"

#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "formats/xml_input.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::continuous {
namespace {

constexpr std::int64_t kMaxVertices = std::int64_t{1} << 26;
constexpr std::int64_t kMaxSide = std::int64_t{1} << 16;

std::optional<std::int64_t> parse_node_id(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const auto number = parse_integer(text.substr(1), 0, kMaxVertices);
  // One name for each node: not n01, nor n with a blank.
  if (!number || text != "n" + std::to_string(*number)) return std::nullopt;
  return number;
}

class GraphmlReader {
 public:
  GraphmlReader(const XmlFile& xml, double resolution) : xml_(xml), resolution_(resolution) {}

  Result<MapXml> read() {
    if (auto error = xml_.misplaced({{"graphml"},
                                     {"graphml", "key"},
                                     {"graphml", "graph"},
                                     {"graphml", "graph", "node"},
                                     {"graphml", "graph", "edge"}}))
      return *error;
    if (auto error = find_coords_key()) return *error;
    const auto graph = xml_.only_child(xml_.root(), "graph");
    if (!graph) return graph.error();
    if (!*graph) return xml_.error(xml_.root(), "there is no <graph>");
    if (std::string_view(graph->attribute("edgedefault").value()) != "directed")
      return xml_.error(*graph, "edgedefault has to be \"directed\"");
    for (const pugi::xml_node node : graph->children("node"))
      if (auto error = read_node(node)) return *error;
    for (const pugi::xml_node edge : graph->children("edge"))
      if (auto error = read_edge(edge)) return *error;
    auto roadmap = Roadmap::make(std::move(positions_), std::move(edges_));
    if (!roadmap) return Error{roadmap.error().code, roadmap.error().message, {xml_.file(), 0}};
    return MapXml{std::move(roadmap).value(), num_zero_length_edges_};
  }

 private:
  std::optional<Error> find_coords_key() {
    std::set<std::string_view> ids;
    for (const pugi::xml_node key : xml_.root().children("key")) {
      const std::string_view id = key.attribute("id").value();
      if (!ids.insert(id).second)
        return xml_.error(key, "there is a second <key> with the id " + quoted(id));
      if (std::string_view(key.attribute("for").value()) != "node" ||
          std::string_view(key.attribute("attr.name").value()) != "coords")
        continue;
      if (!coords_key_.empty()) return xml_.error(key, "there is a second <key> for coords");
      if (id.empty()) return xml_.error(key, "the <key> for coords has no id");
      coords_key_ = id;
    }
    if (coords_key_.empty())
      return xml_.error(xml_.root(), "there is no <key for=\"node\" attr.name=\"coords\">");
    return std::nullopt;
  }

  /// The text of the node's <data> with the coordinates, empty if there is none.
  Result<std::string_view> coordinates(const pugi::xml_node& node) const {
    pugi::xml_node found;
    for (const pugi::xml_node data : node.children("data")) {
      if (coords_key_ != data.attribute("key").value()) continue;
      if (found) return xml_.error(data, "the coordinates of a node are given twice");
      found = data;
    }
    return xml_.text(found);
  }

  std::optional<Error> read_node(const pugi::xml_node& node) {
    const std::string_view id = node.attribute("id").value();
    const std::string expected = "n" + std::to_string(positions_.size());
    if (id != expected)
      return xml_.error(node, "node " + quoted(id) + " where " + expected + " is due");
    const auto data = coordinates(node);
    if (!data) return data.error();
    const std::string_view text = data.value();
    const auto comma = text.find(',');
    const auto x = parse_number(text.substr(0, comma));
    const auto y =
        comma == std::string_view::npos ? std::nullopt : parse_number(text.substr(comma + 1));
    if (!x || !y)
      return xml_.error(node, "node " + expected + " has the coordinates " + quoted(text) +
                                  ", not two finite numbers");
    const auto unit_x = quantise_coordinate(*x, resolution_);
    const auto unit_y = quantise_coordinate(*y, resolution_);
    if (!unit_x || !unit_y)
      return xml_.error(node, "node " + expected + " is too far away for the resolution",
                        ErrorCode::out_of_range);
    positions_.push_back({*unit_x, *unit_y});
    return std::nullopt;
  }

  std::optional<Error> read_edge(const pugi::xml_node& edge) {
    VertexId ends[2];
    for (const int end : {0, 1}) {
      const char* const name = end == 0 ? "source" : "target";
      const std::string_view text = edge.attribute(name).value();
      const auto id = parse_node_id(text);
      if (!id || *id >= static_cast<std::int64_t>(positions_.size()))
        return xml_.error(
            edge, std::string("the ") + name + " " + quoted(text) + " of an edge is no node",
            ErrorCode::invalid_instance);
      ends[end] = VertexId(static_cast<std::size_t>(*id));
    }
    if (ends[0] == ends[1])
      return xml_.error(edge, "an edge from a node to itself", ErrorCode::invalid_instance);
    const pugi::xml_attribute directed = edge.attribute("directed");
    const std::string_view way = directed ? directed.value() : "true";
    if (way != "true" && way != "false")
      return xml_.error(edge, "directed is " + quoted(way) + ", neither true nor false");
    add_edge(ends[0], ends[1]);
    if (way == "false") add_edge(ends[1], ends[0]);
    return std::nullopt;
  }

  void add_edge(VertexId from, VertexId to) {
    edges_.push_back({from, to, std::nullopt});
    // Sampling planners leave such edges in published files. Every move takes time here.
    if (positions_[from.index()] == positions_[to.index()]) {
      edges_.back().duration = Ticks{1};
      ++num_zero_length_edges_;
    }
  }

  const XmlFile& xml_;
  const double resolution_;
  std::string coords_key_;
  std::vector<Point> positions_;
  std::vector<Edge> edges_;
  std::size_t num_zero_length_edges_ = 0;
};

std::optional<Error> read_row(const XmlFile& xml, const pugi::xml_node& row, OccupancyGrid& grid) {
  const auto text = xml.text(row);
  if (!text) return text.error();
  std::int32_t columns = 0;
  for (const char c : *text) {
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    if (c != '0' && c != '1')
      return xml.error(row, "a row consists of 0 and 1 and has " + quoted({&c, 1}));
    grid.passable.push_back(c == '0');
    ++columns;
  }
  if (columns != grid.width)
    return xml.error(row, "a row of " + std::to_string(columns) + " cells where the width is " +
                              std::to_string(grid.width));
  return std::nullopt;
}

Result<MapXml> read_grid(const XmlFile& xml) {
  if (auto error = xml.misplaced({{"root"},
                                  {"root", "map"},
                                  {"root", "map", "width"},
                                  {"root", "map", "height"},
                                  {"root", "map", "grid"},
                                  {"root", "map", "grid", "row"}}))
    return *error;
  const auto map = xml.only_child(xml.root(), "map");
  if (!map) return map.error();
  if (!*map) return xml.error(xml.root(), "there is no <map> in <root>");
  OccupancyGrid grid;
  for (const auto& [name, side] :
       {std::pair{"width", &grid.width}, std::pair{"height", &grid.height}}) {
    const auto element = xml.only_child(*map, name);
    if (!element) return element.error();
    const auto text = xml.text(*element);
    if (!text) return text.error();
    const auto number = parse_integer(*text, 1, kMaxSide);
    if (!number)
      return xml.error(*map, std::string("<") + name + "> has to be 1 .. " +
                                 std::to_string(kMaxSide) + " and is " + quoted(*text));
    *side = static_cast<std::int32_t>(*number);
  }
  const auto cells = xml.only_child(*map, "grid");
  if (!cells) return cells.error();
  std::int32_t rows = 0;
  for (const pugi::xml_node row : cells->children("row")) {
    if (auto error = read_row(xml, row, grid)) return *error;
    ++rows;
  }
  if (rows != grid.height)
    return xml.error(
        *map, std::to_string(rows) + " rows where the height is " + std::to_string(grid.height));
  return MapXml{std::move(grid), 0};
}

Result<MapXml> read_map(const Result<XmlFile>& xml, double resolution) {
  if (!xml) return xml.error();
  const std::string_view name = xml->root().name();
  if (name == "graphml") return GraphmlReader(*xml, resolution).read();
  if (name == "root") return read_grid(*xml);
  return xml->error(xml->root(), "neither <graphml> nor <root> but " + quoted(name));
}

std::optional<Error> read_agent(const XmlFile& xml, const pugi::xml_node& agent, TaskXml& task) {
  std::map<std::string, std::int64_t> numbers;
  for (const char* const name : {"start_id", "goal_id", "start_i", "start_j", "goal_i", "goal_j"}) {
    const pugi::xml_attribute attribute = agent.attribute(name);
    if (!attribute) continue;
    const auto number = parse_integer(attribute.value(), 0, kMaxVertices);
    if (!number)
      return xml.error(
          agent, std::string(name) + " is " + quoted(attribute.value()) + ", not a natural number");
    numbers[name] = *number;
  }
  TaskRow row{xml.line(agent), {}};
  if (numbers.size() == 2 && numbers.contains("start_id") && numbers.contains("goal_id")) {
    row.places = std::pair{numbers["start_id"], numbers["goal_id"]};
  } else if (numbers.size() == 4 && !numbers.contains("start_id") && !numbers.contains("goal_id")) {
    const auto cell = [&](const char* i, const char* j) {
      return Cell{static_cast<std::int32_t>(numbers[j]), static_cast<std::int32_t>(numbers[i])};
    };
    row.places = std::pair{cell("start_i", "start_j"), cell("goal_i", "goal_j")};
  } else {
    return xml.error(agent,
                     "an <agent> has start_id and goal_id, or start_i, start_j, goal_i and goal_j");
  }
  task.rows.push_back(row);
  return std::nullopt;
}

Result<TaskXml> read_task(const Result<XmlFile>& xml) {
  if (!xml) return xml.error();
  if (std::string_view(xml->root().name()) != "root")
    return xml->error(xml->root(), "not <root> but " + quoted(xml->root().name()));
  if (auto error = xml->misplaced({{"root"}, {"root", "agent"}})) return *error;
  TaskXml task{xml->file(), {}};
  for (const pugi::xml_node child : xml->root().children()) {
    if (child.type() != pugi::node_element) continue;
    if (std::string_view(child.name()) != "agent")
      return xml->error(child, "not <agent> but " + quoted(child.name()));
    if (auto error = read_agent(*xml, child, task)) return *error;
  }
  return task;
}

template <class FindVertex>
Result<std::vector<Agent>> make_agents(const TaskXml& task, std::size_t num_agents, Length radius,
                                       Speed speed, const FindVertex& find) {
  if (num_agents > task.rows.size())
    return Error{ErrorCode::invalid_instance,
                 std::to_string(num_agents) + " agents are asked for, but there are " +
                     std::to_string(task.rows.size()),
                 {task.file, 0}};
  std::vector<Agent> agents;
  for (std::size_t i = 0; i < num_agents; ++i) {
    const TaskRow& row = task.rows[i];
    const auto [start, goal] = std::visit(
        [&](const auto& places) {
          return std::pair{find(places.first), find(places.second)};
        },
        row.places);
    if (!start || !goal)
      return Error{ErrorCode::invalid_instance,
                   std::string("the ") + (start ? "goal" : "start") + " of agent " +
                       std::to_string(i) + " is no vertex of the map",
                   {task.file, row.line}};
    agents.push_back({*start, *goal, Disc{radius}, speed});
  }
  return agents;
}

}  // namespace

Result<MapXml> read_map_xml(std::istream& in, const std::string& file, double resolution) {
  return read_map(XmlFile::read(in, file), resolution);
}
Result<MapXml> read_map_xml(const std::filesystem::path& path, double resolution) {
  return read_map(XmlFile::read(path), resolution);
}

Result<TaskXml> read_task_xml(std::istream& in, const std::string& file) {
  return read_task(XmlFile::read(in, file));
}
Result<TaskXml> read_task_xml(const std::filesystem::path& path) {
  return read_task(XmlFile::read(path));
}

Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                     const Roadmap& roadmap, Length radius, Speed speed) {
  struct Find {
    const Roadmap& roadmap;
    std::optional<VertexId> operator()(std::int64_t id) const {
      if (id >= static_cast<std::int64_t>(roadmap.num_vertices())) return std::nullopt;
      return VertexId(static_cast<std::size_t>(id));
    }
    std::optional<VertexId> operator()(Cell) const { return std::nullopt; }
  };
  return make_agents(task, num_agents, radius, speed, Find{roadmap});
}

Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                     const GridRoadmap& grid, Length radius, Speed speed) {
  struct Find {
    const GridRoadmap& grid;
    std::optional<VertexId> operator()(std::int64_t id) const {
      return grid.vertex({static_cast<std::int32_t>(id % grid.width()),
                          static_cast<std::int32_t>(id / grid.width())});
    }
    std::optional<VertexId> operator()(Cell cell) const { return grid.vertex(cell); }
  };
  return make_agents(task, num_agents, radius, speed, Find{grid});
}

}  // namespace quadrille::continuous
