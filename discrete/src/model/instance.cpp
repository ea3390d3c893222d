// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance.hpp"

#include <optional>
#include <string>
#include <utility>

namespace quadrille::discrete {
namespace {

Error invalid(std::string message) { return {ErrorCode::invalid_instance, std::move(message), {}}; }

/// The first agent whose `end` of the task is taken already, as an error.
std::optional<Error> find_shared(const Graph& graph, const std::vector<Task>& tasks,
                                 VertexId Task::*end, const char* name) {
  constexpr std::size_t kNobody = SIZE_MAX;
  std::vector<std::size_t> owner(graph.num_vertices(), kNobody);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const VertexId v = tasks[i].*end;
    if (owner[v.index()] != kNobody)
      return invalid("agents " + std::to_string(owner[v.index()]) + " and " + std::to_string(i) +
                     " have the same " + name + " " + vertex_name(graph, v));
    owner[v.index()] = i;
  }
  return std::nullopt;
}

}  // namespace

Instance::Instance(std::shared_ptr<const Graph> graph, IdVector<AgentId, Task> tasks)
    : graph_(std::move(graph)), tasks_(std::move(tasks)) {}

Result<Instance> Instance::make(std::shared_ptr<const Graph> graph, std::vector<Task> tasks) {
  QUADRILLE_REQUIRE(graph != nullptr, "an instance has a graph");
  for (std::size_t i = 0; i < tasks.size(); ++i)
    for (const VertexId v : {tasks[i].start, tasks[i].goal})
      if (v.index() >= graph->num_vertices())
        return invalid("agent " + std::to_string(i) + " names vertex " + std::to_string(v.value()) +
                       ", but there are only " + std::to_string(graph->num_vertices()) +
                       " vertices");
  if (auto error = find_shared(*graph, tasks, &Task::start, "start")) return *error;
  if (auto error = find_shared(*graph, tasks, &Task::goal, "goal")) return *error;
  return Instance(std::move(graph), IdVector<AgentId, Task>(std::move(tasks)));
}

Result<Instance> Instance::make(Graph graph, std::vector<Task> tasks) {
  return make(std::make_shared<const Graph>(std::move(graph)), std::move(tasks));
}

}  // namespace quadrille::discrete
