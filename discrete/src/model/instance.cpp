// SPDX-License-Identifier: MIT
#include "quadrille/discrete/instance.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "model/poses.hpp"

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
    for (const VertexId v : agents[i].waypoints)
      if (auto error = check(v)) return error;
  }
  return std::nullopt;
}

Error out_of_range(std::string message) {
  return {ErrorCode::out_of_range, std::move(message), {}};
}

std::optional<Error> refuse_now(Timestep now) {
  if (0 <= now && now <= kMaxNow) return std::nullopt;
  return out_of_range("the instance begins at timestep " + std::to_string(now) + ", not 0 .. " +
                      std::to_string(kMaxNow));
}

/// `what` happens at that timestep.
std::optional<Error> refuse_time(const std::string& what, Timestep time, Timestep now) {
  if (0 <= time && time - now < kMaxRuleTime) return std::nullopt;
  return out_of_range(what + " at timestep " + std::to_string(time) + ", not 0 .. " +
                      std::to_string(now + kMaxRuleTime - 1));
}

std::optional<Error> refuse_times(const std::vector<Agent>& agents, Timestep now) {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::string name = "agent " + std::to_string(i);
    if (auto error = refuse_time(name + " is released", agents[i].release, now)) return error;
    if (!agents[i].deadline) continue;
    if (auto error = refuse_time(name + " has its deadline", *agents[i].deadline, now))
      return error;
  }
  return std::nullopt;
}

std::optional<Error> refuse_blockage(const Graph& graph, const Blockage& blockage,
                                     const std::string& name, Timestep now) {
  for (const VertexId v : {blockage.vertex, blockage.to.value_or(blockage.vertex)})
    if (v.index() >= graph.num_vertices())
      return invalid(name + " names vertex " + std::to_string(v.value()) + ", but there are only " +
                     std::to_string(graph.num_vertices()) + " vertices");
  if (blockage.to && !graph.adjacent(blockage.vertex, *blockage.to) &&
      !graph.adjacent(*blockage.to, blockage.vertex))
    return invalid(name + " blocks an edge between " + vertex_name(graph, blockage.vertex) +
                   " and " + vertex_name(graph, *blockage.to) + ", which does not exist");
  if (auto error = refuse_time(name + " begins", blockage.first, now)) return error;
  if (!blockage.last) return std::nullopt;
  if (auto error = refuse_time(name + " ends", *blockage.last, now)) return error;
  if (*blockage.last < blockage.first) return invalid(name + " ends before it begins");
  return std::nullopt;
}

std::optional<Error> refuse_rules(const Graph& graph, const Rules& rules, Timestep now) {
  if (rules.robust < 0 || rules.robust >= kMaxRuleTime)
    return out_of_range("plans cannot be " + std::to_string(rules.robust) + "-robust, only 0 to " +
                        std::to_string(kMaxRuleTime - 1));
  if (rules.turn < 0 || rules.turn > kMaxTurn)
    return out_of_range("a quarter turn takes " + std::to_string(rules.turn) +
                        " timesteps, not 1 to " + std::to_string(kMaxTurn));
  if (rules.turn > 0 && !graph.layout())
    return invalid("turns take time on grids; this graph is none");
  for (std::size_t k = 0; k < rules.blockages.size(); ++k)
    if (auto error =
            refuse_blockage(graph, rules.blockages[k], "blockage " + std::to_string(k), now))
      return error;
  return std::nullopt;
}

bool has_no_rules(const Agent& agent, Timestep now) {
  return agent.release <= now && !agent.deadline && !agent.leaves && agent.waypoints.empty();
}

/// Of what lies before `now`, only that it is over by then matters.
Timestep since(Timestep now, Timestep time) { return std::max<Timestep>(0, time - now); }

}  // namespace

Instance::Instance(std::shared_ptr<const Graph> graph, IdVector<AgentId, Agent> agents,
                   Timestep now, std::shared_ptr<const Rules> rules,
                   std::shared_ptr<const Graph> poses)
    : graph_(std::move(graph)),
      poses_(std::move(poses)),
      agents_(std::move(agents)),
      now_(now),
      rules_(std::move(rules)),
      has_goal_sets_(std::any_of(agents_.begin(), agents_.end(),
                                 [](const Agent& agent) { return !agent.goals.is_single(); })),
      is_plain_(!graph_->is_directed() && *rules_ == Rules() &&
                std::all_of(agents_.begin(), agents_.end(),
                            [now](const Agent& agent) { return has_no_rules(agent, now); })) {}

Result<Instance> Instance::make(std::shared_ptr<const Graph> graph, std::vector<Agent> agents,
                                Timestep now, Rules rules) {
  QUADRILLE_REQUIRE(graph != nullptr, "an instance has a graph");
  if (auto error = refuse_now(now)) return *error;
  if (auto error = find_foreign(*graph, agents)) return *error;
  const auto start = [](const Agent& agent) { return &agent.start; };
  const auto only_goal = [](const Agent& agent) {
    return agent.goals.is_single() && !agent.leaves ? agent.goals.vertices().data() : nullptr;
  };
  if (auto error = find_shared(*graph, agents, start, "start")) return *error;
  if (auto error = find_shared(*graph, agents, only_goal, "goal")) return *error;
  if (auto error = refuse_times(agents, now)) return *error;
  if (auto error = refuse_rules(*graph, rules, now)) return *error;
  auto poses = rules.turn > 0 ? make_poses(*graph, rules.turn) : nullptr;
  return Instance(std::move(graph), IdVector<AgentId, Agent>(std::move(agents)), now,
                  std::make_shared<const Rules>(std::move(rules)), std::move(poses));
}

Result<Instance> Instance::make(Graph graph, std::vector<Agent> agents, Timestep now, Rules rules) {
  return make(std::make_shared<const Graph>(std::move(graph)), std::move(agents), now,
              std::move(rules));
}

Result<Instance> Instance::with_agents(std::vector<Agent> agents) const {
  return make(graph_, std::move(agents), now_, *rules_);
}

Result<Instance> Instance::with_rules(Rules rules) const {
  return make(graph_, agents_.items(), now_, std::move(rules));
}

Result<Instance> Instance::with_now(Timestep now) const {
  return make(graph_, agents_.items(), now, *rules_);
}

Instance Instance::since_now() const {
  IdVector<AgentId, Agent> agents = agents_;
  for (Agent& agent : agents) {
    agent.release = since(now_, agent.release);
    // A deadline that is over stays one that is over.
    if (agent.deadline) agent.deadline = std::max<Timestep>(-1, *agent.deadline - now_);
  }
  Rules rules{{}, rules_->robust, rules_->turn};
  for (Blockage blockage : rules_->blockages) {
    if (blockage.last && *blockage.last < now_) continue;
    blockage.first = since(now_, blockage.first);
    if (blockage.last) *blockage.last -= now_;
    rules.blockages.push_back(blockage);
  }
  return {graph_, std::move(agents), 0, std::make_shared<const Rules>(std::move(rules)), poses_};
}

Instance Instance::relaxed() const {
  std::vector<Agent> agents;
  for (const Agent& agent : agents_)
    if (!agent.leaves) agents.push_back({agent.start, agent.goals});
  return make(graph_->is_directed() ? std::make_shared<const Graph>(graph_->undirected()) : graph_,
              std::move(agents))
      .value();
}

}  // namespace quadrille::discrete
