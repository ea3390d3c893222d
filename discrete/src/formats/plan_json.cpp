// SPDX-License-Identifier: MIT
#include <ostream>
#include <utility>

#include "formats/document.hpp"
#include "formats/instance_document.hpp"
#include "formats/plan_codecs.hpp"
#include "formats/text_input.hpp"

namespace quadrille::discrete {
namespace {

using Node = Document::Node;
constexpr std::int64_t kPlanJsonVersion = 1;

class JsonPlanReader {
 public:
  JsonPlanReader(const Document& document, const Graph& graph)
      : document_(document), check_(document), graph_(graph) {}

  Result<PlanFile> run() {
    std::optional<Node> kind, version, objective, cost, plan, agents, status;
    std::optional<Node> bound;
    std::optional<Node> statistics, seed, options, stop, internal_error,
        explanation;  // Of a result; unread.
    if (!check_.members(Document::kRoot, {{"quadrille", &kind, false},
                                          {"version", &version, false},
                                          {"objective", &objective, false},
                                          {"cost", &cost, false},
                                          {"plan", &plan, false},
                                          {"agents", &agents, false},
                                          {"status", &status, false},
                                          {"lower_bound", &bound, false},
                                          {"statistics", &statistics, false},
                                          {"seed", &seed, false},
                                          {"options", &options, false},
                                          {"stop_reason", &stop, false},
                                          {"internal_error", &internal_error, false},
                                          {"explanation", &explanation, false}}) ||
        !read_kind(kind, version, status) || !read_cost(objective, cost) ||
        !read_bound(objective, bound))
      return check_.error();
    if (!plan || document_.kind(*plan) == Document::Kind::null) {
      check_.fail(plan.value_or(Document::kRoot), ErrorCode::invalid_plan, "there is no plan");
      return check_.error();
    }
    if (!read_paths(*plan) || (agents && !read_agents(*agents))) return check_.error();
    return std::move(file_);
  }

 private:
  /// A plan states its own version; a result has a status, and the version is the program's.
  bool read_kind(std::optional<Node> kind, std::optional<Node> version,
                 std::optional<Node> status) {
    std::string_view name = status ? "result" : "plan";
    std::int64_t number = 0;
    if (kind && !check_.text(*kind, name)) return false;
    if (status && !read_status(*status)) return false;
    if (name == "result") return true;
    if (name != "plan")
      return check_.fail(*kind, "expected 'plan' or 'result', found " + in_quotes(name));
    if (!version) return check_.fail(Document::kRoot, "the key 'version' is missing");
    return check_.integer(*version, kPlanJsonVersion, kPlanJsonVersion, number);
  }

  bool read_status(Node node) {
    std::string_view text;
    if (!check_.text(node, text)) return false;
    file_.stated.status = parse_status(text);
    return file_.stated.status ||
           check_.fail(node, "expected 'optimal', 'feasible', 'infeasible' or 'unknown', found " +
                                 in_quotes(text));
  }

  bool read_cost(std::optional<Node> objective, std::optional<Node> cost) {
    std::string_view name;
    if (objective && !check_.text(*objective, name)) return false;
    const auto known = parse_objective(name);
    if (objective && !known)
      return check_.fail(*objective,
                         "expected 'sum-of-costs' or 'makespan', found " + in_quotes(name));
    if (known) file_.stated.objective = *known;
    if (!cost || document_.kind(*cost) == Document::Kind::null) return true;
    if (!objective) return check_.fail(*cost, "a cost needs the key 'objective'");
    Cost value = 0;
    if (!check_.integer(*cost, 0, INT64_MAX, value)) return false;
    (*known == Objective::makespan ? file_.stated.makespan : file_.stated.sum_of_costs) = value;
    return true;
  }

  bool read_bound(std::optional<Node> objective, std::optional<Node> bound) {
    if (!bound || document_.kind(*bound) == Document::Kind::null) return true;
    if (!objective) return check_.fail(*bound, "a lower bound needs the key 'objective'");
    return check_.integer(*bound, 0, INT64_MAX, file_.stated.lower_bound.emplace());
  }

  bool read_paths(Node plan) {
    if (!check_.array(plan, "paths")) return false;
    for (Node p = document_.first(plan); p < document_.next(plan); p = document_.next(p)) {
      if (!check_.array(p, "places")) return false;
      Path path;
      for (Node v = document_.first(p); v < document_.next(p); v = document_.next(v)) {
        path.emplace_back();
        if (!read_place(check_, document_, graph_, v, ErrorCode::invalid_plan, path.back()))
          return false;
      }
      if (path.empty()) return check_.fail(p, ErrorCode::invalid_plan, "the path is empty");
      file_.plan.paths.push_back(std::move(path));
    }
    return true;
  }

  bool read_agents(Node agents) {
    std::int64_t count = 0;
    if (!check_.integer(agents, 0, INT64_MAX, count)) return false;
    if (count == static_cast<std::int64_t>(file_.plan.paths.size())) return true;
    return check_.fail(agents, ErrorCode::invalid_plan,
                       std::to_string(count) + " agents, but " +
                           std::to_string(file_.plan.paths.size()) + " paths");
  }

  const Document& document_;
  Checker check_;
  const Graph& graph_;
  PlanFile file_;
};

}  // namespace

Result<PlanFile> read_json_plan(const std::string& text, const std::string& file,
                                const Graph& graph) {
  const auto document = parse_json(text, file);
  if (!document) return document.error();
  return JsonPlanReader(*document, graph).run();
}

std::string path_to_json(const Graph& graph, const Path& path) {
  std::string text = "[";
  for (const VertexId v : path) {
    if (text.size() > 1) text += ", ";
    if (graph.layout()) {
      const Cell cell = graph.layout()->cell_of(v);
      text += "[" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + "]";
    } else {
      text += std::to_string(v.value());
    }
  }
  return text + "]";
}

std::string plan_to_json(const Graph& graph, const Plan& plan) {
  std::string text = "[";
  for (const Path& path : plan.paths) {
    if (text.size() > 1) text += ", ";
    text += path_to_json(graph, path);
  }
  return text + "]";
}

void write_json_plan(std::ostream& out, const Graph& graph, const Plan& plan) {
  out << "{\n  \"quadrille\": \"plan\",\n  \"version\": " << kPlanJsonVersion
      << ",\n  \"objective\": \"" << to_string(Objective::sum_of_costs)
      << "\",\n  \"cost\": " << plan.cost(Objective::sum_of_costs) << ",\n  \"plan\": [";
  bool first = true;
  for (const Path& path : plan.paths) {
    out << (first ? "\n    " : ",\n    ") << path_to_json(graph, path);
    first = false;
  }
  out << (first ? "]\n}\n" : "\n  ]\n}\n");
}

}  // namespace quadrille::discrete
