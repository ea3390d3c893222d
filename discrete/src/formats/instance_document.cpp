// SPDX-License-Identifier: MIT
#include "formats/instance_document.hpp"

#include <utility>

namespace quadrille::discrete {
namespace {

/// `end_of(agent)`: null if it has none that counts.
template <class EndOf>
bool all_distinct(Checker& checker, const Graph& graph, const std::vector<PlacedTask>& tasks,
                  const EndOf& end_of, Document::Node PlacedTask::*place, const char* name) {
  constexpr std::size_t kNone = SIZE_MAX;
  IdVector<VertexId, std::size_t> owner(graph.num_vertices(), kNone);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const VertexId* const v = end_of(tasks[i].task);
    if (v == nullptr) continue;
    if (owner[*v] != kNone)
      return checker.fail(tasks[i].*place, ErrorCode::invalid_instance,
                          "agents " + std::to_string(owner[*v]) + " and " + std::to_string(i) +
                              " have the same " + name + " " + vertex_name(graph, *v));
    owner[*v] = i;
  }
  return true;
}

}  // namespace

bool has_most_vertices(Checker& checker, Document::Node node, std::int64_t count,
                       std::size_t most) {
  if (static_cast<std::size_t>(count) <= most) return true;
  return checker.fail(node, ErrorCode::out_of_range,
                      "there are " + std::to_string(count) + " vertices, more than " +
                          std::to_string(most) + ", which are the most that can be solved");
}

std::optional<VertexId> find_vertex(const GridLayout& grid, std::int64_t x, std::int64_t y) {
  if (x < 0 || y < 0 || x >= grid.width() || y >= grid.height()) return std::nullopt;
  return grid.vertex_at({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
}

std::string not_passable(const GridLayout& grid, std::int64_t x, std::int64_t y) {
  const std::string cell = "(" + std::to_string(x) + ", " + std::to_string(y) + ")";
  if (x >= 0 && y >= 0 && x < grid.width() && y < grid.height()) return cell + " is blocked";
  return cell + " is outside the grid of " + std::to_string(grid.width()) + " x " +
         std::to_string(grid.height()) + " cells";
}

bool read_place(Checker& checker, const Document& document, const Graph& graph, Document::Node node,
                ErrorCode code, VertexId& vertex) {
  if (graph.layout()) {
    std::int64_t x = 0, y = 0;
    if (!checker.pair(node, INT32_MAX, x, y)) return false;
    const auto found = find_vertex(*graph.layout(), x, y);
    if (!found) return checker.fail(node, code, not_passable(*graph.layout(), x, y));
    vertex = *found;
    return true;
  }
  const auto count = static_cast<std::int64_t>(graph.num_vertices());
  if (document.kind(node) == Document::Kind::integer &&
      (document.integer(node) < 0 || document.integer(node) >= count))
    return checker.fail(node, code,
                        "there is no vertex " + std::to_string(document.integer(node)) +
                            ", only 0 to " + std::to_string(count - 1));
  std::int64_t number = 0;
  if (!checker.integer(node, 0, INT32_MAX, number)) return false;
  vertex = VertexId(static_cast<std::size_t>(number));
  return true;
}

bool read_now(Checker& checker, Document::Node node, Timestep& now) {
  std::int64_t number = 0;
  if (!checker.integer(node, 0, kMaxNow, number)) return false;
  now = static_cast<Timestep>(number);
  return true;
}

Result<Instance> make_instance(Checker& checker, Graph graph, const std::vector<PlacedTask>& tasks,
                               Timestep now, Rules rules) {
  const auto start = [](const Agent& agent) { return &agent.start; };
  const auto only_goal = [](const Agent& agent) {
    return agent.goals.is_single() && !agent.leaves ? agent.goals.vertices().data() : nullptr;
  };
  if (!all_distinct(checker, graph, tasks, start, &PlacedTask::start, "start") ||
      !all_distinct(checker, graph, tasks, only_goal, &PlacedTask::goal, "goal"))
    return checker.error();
  std::vector<Agent> plain;
  plain.reserve(tasks.size());
  for (const PlacedTask& placed : tasks) plain.push_back(placed.task);
  return Instance::make(std::move(graph), std::move(plain), now, std::move(rules));
}

}  // namespace quadrille::discrete
