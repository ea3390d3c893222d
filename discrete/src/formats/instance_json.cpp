// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance_json.hpp"

#include <algorithm>
#include <istream>
#include <ostream>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/document.hpp"
#include "formats/instance_document.hpp"
#include "formats/rules_document.hpp"
#include "formats/text_input.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/text/goals.hpp"
#include "quadrille/text/names.hpp"
#include "quadrille/text/sniff.hpp"

namespace quadrille::discrete {
namespace {

using Node = Document::Node;

class JsonInstanceReader {
 public:
  JsonInstanceReader(const Document& document, std::size_t most_vertices)
      : document_(document), check_(document), most_vertices_(most_vertices) {}

  Result<Instance> run(text::Names* names) {
    std::optional<Node> kind, version, now, graph, grid, agents, goal_sets, obstacles, robust, turn;
    if (!check_.members(Document::kRoot, {{"quadrille", &kind},
                                          {"version", &version},
                                          {"now", &now, false},
                                          {"graph", &graph, false},
                                          {"grid", &grid, false},
                                          {"agents", &agents},
                                          {"goal_sets", &goal_sets, false},
                                          {"obstacles", &obstacles, false},
                                          {"robust", &robust, false},
                                          {"turn", &turn, false}}) ||
        !read_version(*kind, *version) || (now && !read_now(check_, *now, now_)))
      return check_.error();
    if (graph.has_value() == grid.has_value()) {
      check_.fail(Document::kRoot, "expected either 'graph' or 'grid'");
      return check_.error();
    }
    if (graph ? !read_graph(*graph) : !read_grid(*grid)) return check_.error();
    if (goal_sets && !read_goal_sets(*goal_sets)) return check_.error();
    std::vector<PlacedTask> tasks;
    Rules rules;
    RulesReader reader(check_, document_, *graph_, now_);
    if (!read_agents(*agents, reader, tasks) ||
        (obstacles && !reader.read_obstacles(*obstacles, rules.blockages)) ||
        (robust && !reader.read_robust(*robust, rules.robust)) ||
        (turn && !reader.read_turn(*turn, rules.turn)) || !reader.headings_mean_something(rules))
      return check_.error();
    auto instance = make_instance(check_, std::move(*graph_), tasks, now_, std::move(rules));
    if (instance && names != nullptr) *names = std::move(names_);
    return instance;
  }

 private:
  bool read_version(Node kind, Node version) {
    std::string_view name;
    std::int64_t number = 0;
    if (!check_.text(kind, name)) return false;
    if (name != "instance")
      return check_.fail(kind, "expected 'instance', found " + in_quotes(name));
    return check_.integer(version, kInstanceJsonVersion, kInstanceJsonVersion, number);
  }

  bool read_graph(Node node) {
    std::optional<Node> vertices, edges, directed, one_way;
    std::int64_t count = 0;
    bool is_directed = false;
    if (!check_.members(node, {{"vertices", &vertices},
                               {"edges", &edges},
                               {"directed", &directed, false},
                               {"one_way", &one_way, false}}) ||
        !check_.integer(*vertices, 0, kMaxDeclaredVertices, count) ||
        !check_.array(*edges, "edges") || (directed && !check_.boolean(*directed, is_directed)))
      return false;
    if (is_directed && one_way)
      return check_.fail(*one_way, "all edges of a directed graph lead one way");
    if (!has_most_vertices(check_, *vertices, count, most_vertices_)) return false;
    std::vector<Graph::Edge> list;
    std::vector<std::tuple<std::int64_t, std::int64_t, Node>> sorted;
    for (Node e = document_.first(*edges); e < document_.next(*edges); e = document_.next(e)) {
      std::int64_t a = 0, b = 0;
      if (!check_.pair(e, INT32_MAX, a, b)) return false;
      if (a >= count || b >= count)
        return check_.fail(e, ErrorCode::invalid_instance,
                           "there is no vertex " + std::to_string(std::max(a, b)) + " among " +
                               std::to_string(count));
      if (a == b) return check_.fail(e, ErrorCode::invalid_instance, "the edge is a loop");
      list.emplace_back(VertexId(static_cast<std::size_t>(a)),
                        VertexId(static_cast<std::size_t>(b)));
      if (is_directed)
        sorted.emplace_back(a, b, e);
      else
        sorted.emplace_back(std::min(a, b), std::max(a, b), e);
    }
    if (!no_edge_twice(sorted)) return false;
    const auto size = static_cast<std::size_t>(count);
    auto graph = is_directed ? Graph::make_directed(size, list) : Graph::make(size, list);
    if (!graph) return check_.fail(node, graph.error().code, graph.error().message);
    graph_ = std::move(graph).value();
    return !one_way || read_one_way(*one_way);
  }

  /// The edges that lead from their first place to their second only.
  bool read_one_way(Node node) {
    std::vector<Graph::Edge> arcs;
    if (!read_edges(check_, document_, *graph_, node, arcs)) return false;
    auto graph = graph_->with_one_way(arcs);
    if (!graph) return check_.fail(node, graph.error().code, graph.error().message);
    graph_ = std::move(graph).value();
    return true;
  }

  bool no_edge_twice(std::vector<std::tuple<std::int64_t, std::int64_t, Node>>& sorted) {
    std::sort(sorted.begin(), sorted.end());
    std::optional<Node> first_repetition;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      const auto& [a, b, node] = sorted[i];
      const auto& [c, d, before] = sorted[i - 1];
      if (a == c && b == d && (!first_repetition || node < *first_repetition))
        first_repetition = node;
    }
    if (!first_repetition) return true;
    return check_.fail(*first_repetition, ErrorCode::invalid_instance, "the edge is given twice");
  }

  bool read_grid(Node node) {
    std::optional<Node> width, height, rows, one_way;
    std::int64_t w = 0, h = 0;
    if (!check_.members(node, {{"width", &width},
                               {"height", &height},
                               {"rows", &rows},
                               {"one_way", &one_way, false}}) ||
        !check_.integer(*width, 1, kMaxMapCells, w) || !check_.integer(*height, 1, kMaxMapCells, h))
      return false;
    if (w * h > kMaxMapCells)
      return check_.fail(node, ErrorCode::out_of_range,
                         "the grid is larger than " + std::to_string(kMaxMapCells) + " cells");
    if (!check_.array(*rows, "rows", static_cast<std::size_t>(h))) return false;
    std::vector<bool> passable;
    for (Node row = document_.first(*rows); row < document_.next(*rows);
         row = document_.next(row)) {
      std::string_view letters;
      if (!check_.text(row, letters)) return false;
      if (letters.size() != static_cast<std::size_t>(w))
        return check_.fail(row, "the row has " + std::to_string(letters.size()) +
                                    " letters instead of " + std::to_string(w));
      for (const char& c : letters) {
        if (c != '.' && c != '@')
          return check_.fail(
              row, "the letter " + in_quotes(std::string_view(&c, 1)) + " is neither '.' nor '@'");
        passable.push_back(c == '.');
      }
    }
    const auto count = std::count(passable.begin(), passable.end(), true);
    if (!has_most_vertices(check_, node, count, most_vertices_)) return false;
    graph_ = Graph::grid(static_cast<std::int32_t>(w), static_cast<std::int32_t>(h), passable);
    return !one_way || read_one_way(*one_way);
  }

  bool read_vertex(Node node, VertexId& vertex) {
    return read_place(check_, document_, *graph_, node, ErrorCode::invalid_instance, vertex);
  }

  bool read_goal_sets(Node sets) {
    return text::read_goal_sets(
        check_, document_, sets, [&](Node node, VertexId& v) { return read_vertex(node, v); },
        [&](VertexId v) { return vertex_name(*graph_, v); }, goal_sets_);
  }

  bool read_agents(Node agents, RulesReader& reader, std::vector<PlacedTask>& tasks) {
    if (!check_.array(agents, "agents")) return false;
    std::vector<Node> places;
    for (Node a = document_.first(agents); a < document_.next(agents); a = document_.next(a)) {
      std::optional<Node> start, name;
      text::GoalNodes goals;
      RulesReader::OfAgent rules;
      if (!check_.members(a, {{"start", &start},
                              {"goal", &goals.goal, false},
                              {"goals", &goals.goals, false},
                              {"release", &rules.release, false},
                              {"deadline", &rules.deadline, false},
                              {"at_goal", &rules.at_goal, false},
                              {"waypoints", &rules.waypoints, false},
                              {"heading", &rules.heading, false},
                              {"name", &name, false}}))
        return false;
      auto& own = names_.agents.emplace_back();
      if (name && !text::read_name(check_, document_, *name, own)) return false;
      places.push_back(a);
      Agent task;
      const auto vertex = [&](Node node, VertexId& v) { return read_vertex(node, v); };
      const auto in_words = [&](VertexId v) { return vertex_name(*graph_, v); };
      if (!vertex(*start, task.start) ||
          !text::read_goals(check_, document_, a, goals, goal_sets_, vertex, in_words,
                            task.goals) ||
          !reader.read_agent(rules, task))
        return false;
      tasks.push_back({std::move(task), *start, goals.node()});
    }
    return are_distinct(check_, names_.agents, places);
  }

  const Document& document_;
  Checker check_;
  const std::size_t most_vertices_;
  Timestep now_ = 0;
  std::optional<Graph> graph_;
  text::GoalSets goal_sets_;
  text::Names names_;
};

void write_grid(std::ostream& out, const Graph& graph) {
  const GridLayout& grid = *graph.layout();
  out << "  \"grid\": {\n    \"width\": " << grid.width() << ",\n    \"height\": " << grid.height()
      << ",\n    \"rows\": [";
  std::string row;
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    row.clear();
    for (std::int32_t x = 0; x < grid.width(); ++x) row += grid.vertex_at({x, y}) ? '.' : '@';
    out << (y == 0 ? "\n      \"" : ",\n      \"") << row << '"';
  }
  out << "\n    ]";
  write_one_way(out, graph);
  out << "\n  }";
}

void write_graph(std::ostream& out, const Graph& graph) {
  out << "  \"graph\": {\n    \"vertices\": " << graph.num_vertices() << ",\n    \"edges\": [";
  bool first = true;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    for (const VertexId w : graph.neighbours(v)) {
      if (w < v && graph.adjacent(w, v)) continue;
      out << (first ? "\n      [" : ",\n      [") << v.value() << ", " << w.value() << ']';
      first = false;
    }
  out << (first ? "]" : "\n    ]");
  write_one_way(out, graph);
  out << "\n  }";
}

}  // namespace

Result<Instance> read_instance_json(std::istream& in, const std::string& file,
                                    std::size_t most_vertices, text::Names* names) {
  const auto text = read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(*text, file,
                                      {text::FileKind::own_instance, text::FileKind::own_roadmap}))
    return *error;
  const auto document = parse_json(*text, file);
  if (!document) return document.error();
  return JsonInstanceReader(*document, most_vertices).run(names);
}

Result<Instance> read_instance_json(const std::filesystem::path& path, std::size_t most_vertices) {
  std::ifstream in;
  if (auto error = open_input(path, in)) return *error;
  return read_instance_json(in, path.string(), most_vertices);
}

std::optional<Error> write_instance_json(std::ostream& out, const std::string& file,
                                         const Instance& instance, const text::Names& names) {
  const Graph& graph = instance.graph();
  out << "{\n  \"quadrille\": \"instance\",\n  \"version\": " << kInstanceJsonVersion << ",\n";
  if (instance.now() > 0) out << "  \"now\": " << instance.now() << ",\n";
  if (graph.layout())
    write_grid(out, graph);
  else
    write_graph(out, graph);
  write_rules(out, graph, instance.rules());
  const auto place = [&](VertexId v) { return place_in_json(graph, v); };
  out << ",\n  \"agents\": [";
  bool first = true;
  for (const AgentId i : instance.agent_ids()) {
    const Agent& task = instance.agents()[i];
    out << (first ? "\n" : ",\n") << "    {\"start\": " << place(task.start) << ", ";
    text::write_goals(out, task.goals, place);
    write_agent_rules(out, graph, task);
    if (const std::string* name = names.agent(i.index()))
      out << ", \"name\": " << text::quoted_json(*name);
    out << '}';
    first = false;
  }
  out << (first ? "]\n}\n" : "\n  ]\n}\n");
  return finish_output(out, file);
}

}  // namespace quadrille::discrete
