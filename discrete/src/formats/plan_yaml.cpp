// SPDX-License-Identifier: MIT
#include <ostream>
#include <utility>
#include <vector>

#include "formats/document.hpp"
#include "formats/instance_document.hpp"
#include "formats/plan_codecs.hpp"
#include "formats/text_input.hpp"

namespace quadrille::discrete {
namespace {

using Node = Document::Node;

class YamlPlanReader {
 public:
  YamlPlanReader(const Document& document, const Graph& graph)
      : document_(document), check_(document), graph_(graph) {}

  Result<PlanFile> run() {
    std::optional<Node> statistics, schedule, cost;
    if (!check_.members(Document::kRoot, {{"statistics", &statistics, false},
                                          {"schedule", &schedule},
                                          // Of atb033's planners, which count the places of paths.
                                          {"cost", &cost, false}}) ||
        (statistics && !read_statistics(*statistics)) || !read_schedule(*schedule))
      return check_.error();
    return std::move(file_);
  }

 private:
  bool read_statistics(Node node) {
    std::optional<Node> cost, makespan, runtime, high, low;
    return check_.members(node, {{"cost", &cost, false},
                                 {"makespan", &makespan, false},
                                 {"runtime", &runtime, false},
                                 {"highLevelExpanded", &high, false},
                                 {"lowLevelExpanded", &low, false}}) &&
           read_cost(cost, file_.stated.sum_of_costs) && read_cost(makespan, file_.stated.makespan);
  }

  bool read_cost(std::optional<Node> node, std::optional<Cost>& cost) {
    return !node || check_.integer(*node, 0, INT64_MAX, cost.emplace());
  }

  /// The entries are named agent0, agent1, ...; they may come in any order.
  bool read_schedule(Node schedule) {
    if (document_.kind(schedule) != Document::Kind::object)
      return check_.fail(schedule, "expected an entry per agent");
    std::size_t count = 0;
    for (Node key = document_.first(schedule); key < document_.next(schedule); ++count)
      key = document_.next(document_.first(key));
    auto& paths = file_.plan.paths;
    paths.resize(count);
    for (Node key = document_.first(schedule); key < document_.next(schedule);) {
      const std::string_view name = document_.text(key);
      const bool prefixed = name.starts_with("agent");
      const Natural number = parse_natural(prefixed ? name.substr(5) : "", INT32_MAX);
      const auto agent = static_cast<std::size_t>(number.value);
      // One name for each agent: not agent01.
      if (number.fault != NumberFault::none || agent >= count ||
          name != "agent" + std::to_string(agent))
        return check_.fail(key, "expected a name from agent0 to agent" + std::to_string(count - 1));
      Path& path = paths[AgentId(agent)];
      if (!path.empty()) return check_.fail(key, "this agent is given twice");
      if (!read_path(document_.first(key), path)) return false;
      key = document_.next(document_.first(key));
    }
    return true;
  }

  bool read_path(Node list, Path& path) {
    if (!check_.array(list, "places")) return false;
    for (Node p = document_.first(list); p < document_.next(list); p = document_.next(p)) {
      const auto t = static_cast<std::int64_t>(path.size());
      std::optional<Node> time;
      VertexId vertex;
      std::int64_t found = 0;
      if (!read_step(p, vertex, time) || !check_.integer(*time, 0, INT32_MAX, found)) return false;
      if (found != t)
        return check_.fail(
            *time, "expected timestep " + std::to_string(t) + ", found " + std::to_string(found));
      path.push_back(vertex);
    }
    return !path.empty() || check_.fail(list, ErrorCode::invalid_plan, "the path is empty");
  }

  bool read_step(Node step, VertexId& vertex, std::optional<Node>& time) {
    std::optional<Node> x_node, y_node, v_node;
    if (!graph_.layout())
      return check_.members(step, {{"v", &v_node}, {"t", &time}}) &&
             read_place(check_, document_, graph_, *v_node, ErrorCode::invalid_plan, vertex);
    std::int64_t x = 0, y = 0;
    if (!check_.members(step, {{"x", &x_node}, {"y", &y_node}, {"t", &time}}) ||
        !check_.integer(*x_node, 0, INT32_MAX, x) || !check_.integer(*y_node, 0, INT32_MAX, y))
      return false;
    const auto found = find_vertex(*graph_.layout(), x, y);
    if (!found)
      return check_.fail(step, ErrorCode::invalid_plan, not_passable(*graph_.layout(), x, y));
    vertex = *found;
    return true;
  }

  const Document& document_;
  Checker check_;
  const Graph& graph_;
  PlanFile file_;
};

}  // namespace

Result<PlanFile> read_yaml_plan(const std::string& text, const std::string& file,
                                const Graph& graph) {
  const auto document = parse_yaml(text, file);
  if (!document) return document.error();
  return YamlPlanReader(*document, graph).run();
}

void write_yaml_plan(std::ostream& out, const Graph& graph, const Plan& plan) {
  out << "statistics:\n  cost: " << plan.cost(Objective::sum_of_costs)
      << "\n  makespan: " << plan.cost(Objective::makespan)
      << "\nschedule:" << (plan.paths.empty() ? " {}\n" : "\n");
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    out << "  agent" << i << ":\n";
    std::size_t t = 0;
    for (const VertexId v : plan.paths[AgentId(i)]) {
      if (graph.layout()) {
        const Cell cell = graph.layout()->cell_of(v);
        out << "    - x: " << cell.x << "\n      y: " << cell.y << '\n';
      } else {
        out << "    - v: " << v.value() << '\n';
      }
      out << "      t: " << t++ << '\n';
    }
    if (!out) return;
  }
}

}  // namespace quadrille::discrete
