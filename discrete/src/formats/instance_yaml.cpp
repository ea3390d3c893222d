// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance_yaml.hpp"

#include <algorithm>
#include <functional>
#include <istream>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/document.hpp"
#include "formats/instance_document.hpp"
#include "formats/text_input.hpp"
#include "quadrille/text/goals.hpp"
#include "quadrille/text/names.hpp"
#include "quadrille/text/sniff.hpp"

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
    if (!check_.members(
            Document::kRoot,
            {{"map", &map, false}, {"agents", &agents, false}, {"roadmap", &roadmap, false}}) ||
        (!map && !roadmap && !check_.fail(Document::kRoot, "the key 'map' is missing")) ||
        (map && roadmap && !check_.fail(*roadmap, "a map and a roadmap")) ||
        (!agents && !check_.fail(Document::kRoot, "the key 'agents' is missing")) ||
        !(map ? read_map(*map) : read_roadmap(*roadmap)) || !read_agents(*agents, tasks))
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

  /// The lists of edges, and perhaps of vertices with places, of which only the names count: all
  /// moves take one timestep.
  bool read_roadmap(Node roadmap) {
    std::optional<Node> undirected, waits, vertices, edges, conflicts;
    if (!check_.members(roadmap, {{"undirected", &undirected},
                                  {"allow_wait_actions", &waits},
                                  {"vertices", &vertices, false},
                                  {"edges", &edges},
                                  {"conflicts", &conflicts, false}}))
      return false;
    if (conflicts)
      return check_.fail(*conflicts, ErrorCode::invalid_instance,
                         "conflicts between edges are not supported");
    if (!is_true(*undirected))
      return check_.fail(*undirected, ErrorCode::invalid_instance,
                         "only undirected roadmaps are supported: true");
    if (!is_true(*waits))
      return check_.fail(*waits, ErrorCode::invalid_instance,
                         "agents may always wait here: only true is supported");
    if (vertices) {
      if (document_.kind(*vertices) != Document::Kind::object)
        return check_.fail(*vertices, "expected vertices by their names");
      for (Node key = document_.first(*vertices); key < document_.next(*vertices);
           key = document_.next(document_.first(key)))
        if (!numbers_.emplace(document_.text(key), numbers_.size()).second)
          return check_.fail(key, "this vertex is given twice");
    }
    if (!check_.array(*edges, "edges")) return false;
    std::set<Graph::Edge> known;
    for (Node e = document_.first(*edges); e < document_.next(*edges); e = document_.next(e)) {
      VertexId from, to;
      if (!check_.array(e, "vertices", 2) || !read_vertex(document_.first(e), true, from) ||
          !read_vertex(document_.next(document_.first(e)), true, to))
        return false;
      if (from == to)
        return check_.fail(e, ErrorCode::invalid_instance, "an edge from a vertex to itself");
      known.emplace(std::min(from, to), std::max(from, to));
    }
    if (!has_most_vertices(check_, roadmap, static_cast<std::int64_t>(numbers_.size()),
                           most_vertices_))
      return false;
    auto graph = Graph::make(numbers_.size(), {known.begin(), known.end()});
    if (!graph) return check_.fail(*edges, graph.error().code, graph.error().message);
    graph_ = std::move(graph).value();
    return true;
  }

  /// YAML 1.1 has many words for it; these are what the programs and their users write.
  bool is_true(Node node) {
    return document_.kind(node) == Document::Kind::string &&
           (document_.text(node) == "true" || document_.text(node) == "True");
  }

  /// A vertex of a roadmap by its name. `may_be_new`: as the first edges name the vertices, too.
  bool read_vertex(Node node, bool may_be_new, VertexId& vertex) {
    std::optional<std::string> name;
    if (!text::read_name(check_, document_, node, name)) return false;
    if (may_be_new) numbers_.emplace(*name, numbers_.size());
    const auto found = numbers_.find(*name);
    if (found == numbers_.end())
      return check_.fail(node, ErrorCode::invalid_instance,
                         "there is no vertex " + in_quotes(*name));
    vertex = VertexId(found->second);
    return true;
  }

  /// A cell of a map, or a vertex of a roadmap.
  bool read_end(Node node, VertexId& vertex) {
    if (!graph_->layout()) return read_vertex(node, false, vertex);
    return read_place(check_, document_, *graph_, node, ErrorCode::invalid_instance, vertex);
  }

  bool read_agents(Node agents, std::vector<PlacedTask>& tasks) {
    if (!check_.array(agents, "agents")) return false;
    std::vector<Node> places;
    for (Node a = document_.first(agents); a < document_.next(agents); a = document_.next(a)) {
      std::optional<Node> start, name;
      text::GoalNodes goals;
      goals.plural = "potentialGoals";
      if (!check_.members(a, {{"start", &start},
                              {"goal", &goals.goal, false},
                              {"name", &name, false},
                              {"potentialGoals", &goals.goals, false}}))
        return false;
      auto& own = names_.agents.emplace_back();
      if (name && !text::read_name(check_, document_, *name, own)) return false;
      places.push_back(a);
      Agent task;
      const auto end = [&](Node node, VertexId& vertex) { return read_end(node, vertex); };
      const auto in_words = [&](VertexId v) { return vertex_name(*graph_, v); };
      if (!read_end(*start, task.start) ||
          !text::read_goals(check_, document_, a, goals, {}, end, in_words, task.goals))
        return false;
      tasks.push_back({std::move(task), *start, goals.node()});
    }
    return are_distinct(check_, names_.agents, places);
  }

  const Document& document_;
  Checker check_;
  const std::size_t most_vertices_;
  std::optional<Graph> graph_;
  std::map<std::string, std::size_t, std::less<>> numbers_;  // Of a roadmap's vertices.
  text::Names names_;
};

}  // namespace

Result<Instance> read_instance_yaml(std::istream& in, const std::string& file,
                                    std::size_t most_vertices, text::Names* names) {
  const auto text = read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(
          *text, file, {text::FileKind::libmrp_instance, text::FileKind::libmrp_roadmap}))
    return *error;
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
  if (!instance.is_plain())
    return Error{ErrorCode::invalid_instance,
                 "this YAML format knows no rules, such as one-way edges or agents that leave",
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
        << (task.goals.is_single() ? "\n    goal: " : "\n    potentialGoals: [");
    for (const VertexId& goal : task.goals.vertices())
      out << (&goal == task.goals.vertices().data() ? "" : ", ") << pair(grid.cell_of(goal));
    out << (task.goals.is_single() ? "\n" : "]\n");
  }
  return finish_output(out, file);
}

}  // namespace quadrille::discrete
