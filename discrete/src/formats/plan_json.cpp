// SPDX-License-Identifier: MIT
#include <ostream>
#include <utility>

#include "formats/document.hpp"
#include "formats/instance_document.hpp"
#include "formats/plan_codecs.hpp"
#include "quadrille/text/plan_header.hpp"

namespace quadrille::discrete {
namespace {

using Node = Document::Node;

class JsonPlanReader {
 public:
  JsonPlanReader(const Document& document, const Graph& graph)
      : document_(document), check_(document), header_(document, check_), graph_(graph) {}

  Result<PlanFile> run() {
    std::optional<Node> now;
    Node paths = Document::kRoot;
    if (!header_.read({{"now", &now, false}}, file_.stated) ||
        (now && !read_now(check_, *now, file_.plan.now)) || !read_costs() || !header_.plan(paths) ||
        !read_paths(paths) || !header_.agents(file_.plan.paths.size()))
      return check_.error();
    return std::move(file_);
  }

 private:
  bool read_costs() {
    StatedOutcome& stated = file_.stated;
    const auto& cost = header_.cost();
    const auto& bound = header_.lower_bound();
    auto& stated_cost =
        stated.objective == Objective::makespan ? stated.makespan : stated.sum_of_costs;
    if (!header_.is_null(cost) && (!header_.needs_objective(*cost, "a cost") ||
                                   !check_.integer(*cost, 0, INT64_MAX, stated_cost.emplace())))
      return false;
    return header_.is_null(bound) ||
           (header_.needs_objective(*bound, "a lower bound") &&
            check_.integer(*bound, 0, INT64_MAX, stated.lower_bound.emplace()));
  }

  bool read_paths(Node plan) {
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

  const Document& document_;
  Checker check_;
  text::PlanHeader header_;
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
  out << "{\n  \"quadrille\": \"plan\",\n  \"version\": " << text::kPlanJsonVersion;
  if (plan.now > 0) out << ",\n  \"now\": " << plan.now;
  out << ",\n  \"objective\": \"" << to_string(Objective::sum_of_costs)
      << "\",\n  \"cost\": " << plan.cost(Objective::sum_of_costs) << ",\n  \"plan\": [";
  bool first = true;
  for (const Path& path : plan.paths) {
    out << (first ? "\n    " : ",\n    ") << path_to_json(graph, path);
    first = false;
  }
  out << (first ? "]\n}\n" : "\n  ]\n}\n");
}

}  // namespace quadrille::discrete
