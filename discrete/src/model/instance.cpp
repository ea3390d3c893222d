// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace quadrille::discrete {
namespace {

Error invalid(std::string message) { return {ErrorCode::invalid_instance, std::move(message), {}}; }

/// The first agent whose start is taken already, or its only goal, as an error. `end_of(agent)`:
/// null if it has none that counts.
template <class EndOf>
std::optional<Error> find_shared(const Graph& graph, const std::vector<Agent>& agents,
                                 const EndOf& end_of, const char* name) {
  constexpr std::size_t kNobody = SIZE_MAX;
  std::vector<std::size_t> owner(graph.num_vertices(), kNobody);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const VertexId* const v = end_of(agents[i]);
    if (v == nullptr) continue;
    if (owner[v->index()] != kNobody)
      return invalid("agents " + std::to_string(owner[v->index()]) + " and " + std::to_string(i) +
                     " have the same " + name + " " + vertex_name(graph, *v));
    owner[v->index()] = i;
  }
  return std::nullopt;
}

std::optional<Error> find_foreign(const Graph& graph, const std::vector<Agent>& agents) {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const auto check = [&](VertexId v) -> std::optional<Error> {
      if (v.index() < graph.num_vertices()) return std::nullopt;
      return invalid("agent " + std::to_string(i) + " names vertex " + std::to_string(v.value()) +
                     ", but there are only " + std::to_string(graph.num_vertices()) + " vertices");
    };
    if (auto error = check(agents[i].start)) return error;
    if (agents[i].goals.size() == 0) return invalid("agent " + std::to_string(i) + " has no goal");
    for (const VertexId v : agents[i].goals.vertices())
      if (auto error = check(v)) return error;
  }
  return std::nullopt;
}

std::optional<Error> refuse_now(Timestep now) {
  if (0 <= now && now <= kMaxNow) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "the instance begins at timestep " + std::to_string(now) + ", not 0 .. " +
                   std::to_string(kMaxNow),
               {}};
}

}  // namespace

Instance::Instance(std::shared_ptr<const Graph> graph, IdVector<AgentId, Agent> agents,
                   Timestep now)
    : graph_(std::move(graph)),
      agents_(std::move(agents)),
      now_(now),
      has_goal_sets_(std::any_of(agents_.begin(), agents_.end(),
                                 [](const Agent& agent) { return !agent.goals.is_single(); })) {}

Result<Instance> Instance::make(std::shared_ptr<const Graph> graph, std::vector<Agent> agents,
                                Timestep now) {
  QUADRILLE_REQUIRE(graph != nullptr, "an instance has a graph");
  if (auto error = refuse_now(now)) return *error;
  if (auto error = find_foreign(*graph, agents)) return *error;
  const auto start = [](const Agent& agent) { return &agent.start; };
  const auto only_goal = [](const Agent& agent) {
    return agent.goals.is_single() ? agent.goals.vertices().data() : nullptr;
  };
  if (auto error = find_shared(*graph, agents, start, "start")) return *error;
  if (auto error = find_shared(*graph, agents, only_goal, "goal")) return *error;
  return Instance(std::move(graph), IdVector<AgentId, Agent>(std::move(agents)), now);
}

Result<Instance> Instance::make(Graph graph, std::vector<Agent> agents, Timestep now) {
  return make(std::make_shared<const Graph>(std::move(graph)), std::move(agents), now);
}

Result<Instance> Instance::with_agents(std::vector<Agent> agents) const {
  return make(graph_, std::move(agents), now_);
}

Result<Instance> Instance::with_now(Timestep now) const {
  if (auto error = refuse_now(now)) return *error;
  Instance same = *this;
  same.now_ = now;
  return same;
}

}  // namespace quadrille::discrete
