// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance.hpp"

#include <optional>
#include <string>
#include <utility>

namespace quadrille::discrete {
namespace {

Error invalid(std::string message) { return {ErrorCode::invalid_instance, std::move(message), {}}; }

/// The first agent whose start or goal is taken already, as an error.
std::optional<Error> find_shared(const Graph& graph, const std::vector<Agent>& agents,
                                 VertexId Agent::*end, const char* name) {
  constexpr std::size_t kNobody = SIZE_MAX;
  std::vector<std::size_t> owner(graph.num_vertices(), kNobody);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const VertexId v = agents[i].*end;
    if (owner[v.index()] != kNobody)
      return invalid("agents " + std::to_string(owner[v.index()]) + " and " + std::to_string(i) +
                     " have the same " + name + " " + vertex_name(graph, v));
    owner[v.index()] = i;
  }
  return std::nullopt;
}

}  // namespace

Instance::Instance(std::shared_ptr<const Graph> graph, IdVector<AgentId, Agent> agents)
    : graph_(std::move(graph)), agents_(std::move(agents)) {}

Result<Instance> Instance::make(std::shared_ptr<const Graph> graph, std::vector<Agent> agents) {
  QUADRILLE_REQUIRE(graph != nullptr, "an instance has a graph");
  for (std::size_t i = 0; i < agents.size(); ++i)
    for (const VertexId v : {agents[i].start, agents[i].goal})
      if (v.index() >= graph->num_vertices())
        return invalid("agent " + std::to_string(i) + " names vertex " + std::to_string(v.value()) +
                       ", but there are only " + std::to_string(graph->num_vertices()) +
                       " vertices");
  if (auto error = find_shared(*graph, agents, &Agent::start, "start")) return *error;
  if (auto error = find_shared(*graph, agents, &Agent::goal, "goal")) return *error;
  return Instance(std::move(graph), IdVector<AgentId, Agent>(std::move(agents)));
}

Result<Instance> Instance::make(Graph graph, std::vector<Agent> agents) {
  return make(std::make_shared<const Graph>(std::move(graph)), std::move(agents));
}

}  // namespace quadrille::discrete
