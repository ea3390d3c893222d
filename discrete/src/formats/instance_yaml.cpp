// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance_yaml.hpp"

#include <algorithm>
#include <istream>
#include <ostream>
#include <utility>
#include <vector>

#include "formats/document.hpp"
#include "formats/instance_document.hpp"
#include "formats/text_input.hpp"
#include "quadrille/text/names.hpp"

namespace quadrille::discrete {
namespace {

using Node = Document::Node;

class YamlInstanceReader {
 public:
  YamlInstanceReader(const Document& document, std::size_t most_vertices)
      : document_(document), check_(document), most_vertices_(most_vertices) {}

  Result<Instance> run(text::Names* names) {
    std::optional<Node> map, agents, roadmap;
    std::vector<PlacedTask> tasks;
    // The roadmap comes first: files that have one have no map, and deserve the right reason.
    if (!check_.members(
            Document::kRoot,
            {{"map", &map, false}, {"agents", &agents, false}, {"roadmap", &roadmap, false}}) ||
        (roadmap && !check_.fail(*roadmap, "roadmaps are not supported, only grids")) ||
        (!map && !check_.fail(Document::kRoot, "the key 'map' is missing")) ||
        (!agents && !check_.fail(Document::kRoot, "the key 'agents' is missing")) ||
        !read_map(*map) || !read_agents(*agents, tasks))
      return check_.error();
    auto instance = make_instance(check_, std::move(*graph_), tasks);
    if (instance && names != nullptr) *names = std::move(names_);
    return instance;
  }

 private:
  bool read_map(Node map) {
    std::optional<Node> dimensions, obstacles;
    std::int64_t width = 0, height = 0;
    if (!check_.members(map, {{"dimensions", &dimensions}, {"obstacles", &obstacles, false}}) ||
        !check_.pair(*dimensions, kMaxDeclaredVertices, width, height))
      return false;
    if (width == 0 || height == 0) return check_.fail(*dimensions, "the map has no cells");
    if (width * height > kMaxDeclaredVertices)
      return check_.fail(
          *dimensions, ErrorCode::out_of_range,
          "the map is larger than " + std::to_string(kMaxDeclaredVertices) + " cells");
    std::vector<bool> passable(static_cast<std::size_t>(width * height), true);
    if (obstacles) {
      if (!check_.array(*obstacles, "obstacles")) return false;
      for (Node o = document_.first(*obstacles); o < document_.next(*obstacles);
           o = document_.next(o)) {
        std::int64_t x = 0, y = 0;
        if (!check_.pair(o, INT32_MAX, x, y)) return false;
        if (x >= width || y >= height)
          return check_.fail(o, ErrorCode::invalid_instance,
                             "the obstacle is outside the map of " + std::to_string(width) + " x " +
                                 std::to_string(height) + " cells");
        passable[static_cast<std::size_t>(y * width + x)] = false;
      }
    }
    if (!has_most_vertices(check_, *dimensions, std::count(passable.begin(), passable.end(), true),
                           most_vertices_))
      return false;
    graph_ =
        Graph::grid(static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), passable);
    return true;
  }

  bool read_agents(Node agents, std::vector<PlacedTask>& tasks) {
    if (!check_.array(agents, "agents")) return false;
    std::vector<Node> places;
    for (Node a = document_.first(agents); a < document_.next(agents); a = document_.next(a)) {
      std::optional<Node> start, goal, name, potential;
      if (!check_.members(a, {{"start", &start},
                              {"goal", &goal, false},
                              {"name", &name, false},
                              {"potentialGoals", &potential, false}}))
        return false;
      if (potential) return check_.fail(*potential, "target assignment is not supported");
      if (!goal) return check_.fail(a, "the key 'goal' is missing");
      auto& own = names_.agents.emplace_back();
      if (name && !text::read_name(check_, document_, *name, own)) return false;
      places.push_back(a);
      VertexId from, to;
      if (!read_place(check_, document_, *graph_, *start, ErrorCode::invalid_instance, from) ||
          !read_place(check_, document_, *graph_, *goal, ErrorCode::invalid_instance, to))
        return false;
      tasks.push_back({{from, to}, *start, *goal});
    }
    return are_distinct(check_, names_.agents, places);
  }

  const Document& document_;
  Checker check_;
  const std::size_t most_vertices_;
  std::optional<Graph> graph_;
  text::Names names_;
};

}  // namespace

Result<Instance> read_instance_yaml(std::istream& in, const std::string& file,
                                    std::size_t most_vertices, text::Names* names) {
  const auto text = read_all(in, file);
  if (!text) return text.error();
  const auto document = parse_yaml(*text, file);
  if (!document) return document.error();
  return YamlInstanceReader(*document, most_vertices).run(names);
}

Result<Instance> read_instance_yaml(const std::filesystem::path& path, std::size_t most_vertices) {
  std::ifstream in;
  if (auto error = open_input(path, in)) return *error;
  return read_instance_yaml(in, path.string(), most_vertices);
}

std::optional<Error> write_instance_yaml(std::ostream& out, const std::string& file,
                                         const Instance& instance, const text::Names& names) {
  if (!instance.graph().layout())
    return Error{ErrorCode::invalid_instance, "this YAML format needs a grid", {file, 0}};
  if (instance.has_goal_sets())
    return Error{ErrorCode::invalid_instance,
                 "this YAML format has one goal for each agent, not a set of several",
                 {file, 0}};
  if (instance.now() != 0)
    return Error{ErrorCode::invalid_instance,
                 "instances of this YAML format begin at timestep 0, and this one at " +
                     std::to_string(instance.now()),
                 {file, 0}};
  const GridLayout& grid = *instance.graph().layout();
  const auto pair = [](Cell c) {
    return "[" + std::to_string(c.x) + ", " + std::to_string(c.y) + "]";
  };
  out << "map:\n  dimensions: " << pair({grid.width(), grid.height()}) << "\n  obstacles:";
  bool any = false;
  for (std::int32_t y = 0; y < grid.height(); ++y)
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      if (grid.vertex_at({x, y})) continue;
      out << "\n    - " << pair({x, y});
      any = true;
    }
  out << (any ? "\n" : " []\n") << "agents:" << (instance.num_agents() == 0 ? " []\n" : "\n");
  for (const AgentId i : instance.agent_ids()) {
    const Agent& task = instance.agents()[i];
    out << "  - name: ";
    if (const std::string* name = names.agent(i.index()))
      out << text::quoted_json(*name);
    else
      out << "agent" << i.value();
    out << "\n    start: " << pair(grid.cell_of(task.start))
        << "\n    goal: " << pair(grid.cell_of(task.goal())) << '\n';
  }
  return finish_output(out, file);
}

}  // namespace quadrille::discrete
