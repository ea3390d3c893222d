// SPDX-License-Identifier: MIT
#include "quadrille/continuous/roadmap_xml.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <initializer_list>
#include <map>
#include <string_view>
#include <utility>

#include "formats/graphml.hpp"
#include "formats/roadmap_readers.hpp"
#include "formats/xml_input.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/core/decimal.hpp"
#include "quadrille/text/sniff.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::continuous {
namespace {

constexpr std::int64_t kMaxVertices = std::int64_t{1} << 26;
constexpr std::int64_t kMaxSide = std::int64_t{1} << 16;

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

Result<MapFile> read_grid(const XmlFile& xml) {
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
  return MapFile{std::move(grid)};
}

Result<MapFile> read_map(const Result<XmlFile>& xml, const MapFileOptions& options) {
  if (!xml) return xml.error();
  const std::string_view name = xml->root().name();
  if (name == "graphml") return read_graphml(*xml, options);
  if (name == "root") return read_grid(*xml);
  return xml->error(xml->root(), "neither <graphml> nor <root> but " + quoted(name));
}

constexpr std::array<const char*, 6> kAttributes = {"start_id", "goal_id", "start_i",
                                                    "start_j",  "goal_i",  "goal_j"};

/// What is there of kAttributes.
using Places = std::map<std::string_view, std::string_view>;

bool has_only(const Places& places, std::initializer_list<const char*> names) {
  return places.size() == names.size() &&
         std::all_of(names.begin(), names.end(), [&](auto name) { return places.contains(name); });
}

std::optional<Error> read_agent(const XmlFile& xml, const pugi::xml_node& agent, TaskXml& task) {
  Places texts;
  std::map<std::string_view, std::int64_t> numbers;
  for (const char* const name : kAttributes) {
    const pugi::xml_attribute attribute = agent.attribute(name);
    if (!attribute) continue;
    texts.emplace(name, attribute.value());
    const auto number = parse_integer(attribute.value(), 0, kMaxVertices);
    if (number)
      numbers.emplace(name, *number);
    else if (!std::string_view(name).ends_with("_id"))
      return xml.error(
          agent, std::string(name) + " is " + quoted(attribute.value()) + ", not a natural number");
  }
  TaskRow row{xml.line(agent), {}};
  if (has_only(texts, {"start_id", "goal_id"})) {
    if (numbers.size() == 2)
      row.places = std::pair{numbers["start_id"], numbers["goal_id"]};
    else
      row.places = std::pair{std::string(texts["start_id"]), std::string(texts["goal_id"])};
  } else if (has_only(texts, {"start_i", "start_j", "goal_i", "goal_j"})) {
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

/// `find(place)`: the vertex, or why there is none.
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
    if (!start || !goal) {
      const Error& why = start ? goal.error() : start.error();
      return Error{why.code,
                   std::string("the ") + (start ? "goal" : "start") + " of agent " +
                       std::to_string(i) + ": " + why.message,
                   {task.file, row.line}};
    }
    agents.push_back({*start, *goal, Disc{radius}, speed});
  }
  return agents;
}

Error no_vertex(const std::string& why, ErrorCode code = ErrorCode::invalid_instance) {
  return {code, why, {}};
}

struct FindOnRoadmap {
  const Roadmap& roadmap;
  const VertexNames& names;

  Result<VertexId> operator()(const std::string& text) const {
    return names.find(text, roadmap.num_vertices());
  }
  Result<VertexId> operator()(std::int64_t id) const {
    if (names.are_ids) return (*this)(std::to_string(id));
    if (id < static_cast<std::int64_t>(roadmap.num_vertices()))
      return VertexId(static_cast<std::size_t>(id));
    return no_vertex("there is no vertex " + std::to_string(id) + " among " +
                     std::to_string(roadmap.num_vertices()));
  }
  Result<VertexId> operator()(Cell) const { return no_vertex("a roadmap has vertices, not cells"); }
};

struct FindOnGrid {
  const GridRoadmap& grid;
  Length radius;

  Result<VertexId> operator()(const std::string& text) const {
    return no_vertex(quoted(std::string_view(text)) + " is no number of a cell");
  }
  Result<VertexId> operator()(std::int64_t id) const {
    return (*this)(Cell{static_cast<std::int32_t>(id % grid.width()),
                        static_cast<std::int32_t>(id / grid.width())});
  }
  Result<VertexId> operator()(Cell cell) const {
    if (const auto vertex = grid.vertex(cell)) return *vertex;
    const std::string place = "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ")";
    if (cell.x >= grid.width() || cell.y >= grid.height())
      return no_vertex(place + " is outside of the grid of " + std::to_string(grid.width()) +
                       " x " + std::to_string(grid.height()) + " cells");
    if (!grid.is_passable(cell)) return no_vertex(place + " is blocked");
    return no_vertex("a disc of radius " +
                         decimal(radius_in_input_units(radius, grid.resolution())) +
                         " does not fit at " + place,
                     ErrorCode::no_plan);
  }
};

}  // namespace

Result<MapFile> read_xml_map(const std::string& text, const std::string& file,
                             const MapFileOptions& options) {
  return read_map(XmlFile::parse(text, file), options);
}

Result<MapFile> read_map_xml(std::istream& in, const std::string& file, double resolution) {
  return read_map(XmlFile::read(in, file), {resolution, kUnitSpeed});
}
Result<MapFile> read_map_xml(const std::filesystem::path& path, double resolution) {
  return read_map(XmlFile::read(path), {resolution, kUnitSpeed});
}

Result<TaskXml> read_task_xml(std::istream& in, const std::string& file) {
  const auto text = text::read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(*text, file, {text::FileKind::ccbs_task})) return *error;
  return read_task(XmlFile::parse(*text, file));
}
Result<TaskXml> read_task_xml(const std::filesystem::path& path) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return *error;
  return read_task_xml(in, path.string());
}

Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                     const Roadmap& roadmap, Length radius, Speed speed,
                                     const VertexNames& names) {
  return make_agents(task, num_agents, radius, speed, FindOnRoadmap{roadmap, names});
}

Result<std::vector<Agent>> agents_of(const TaskXml& task, std::size_t num_agents,
                                     const GridRoadmap& grid, Length radius, Speed speed) {
  return make_agents(task, num_agents, radius, speed, FindOnGrid{grid, radius});
}

}  // namespace quadrille::continuous
