// SPDX-License-Identifier: MIT
#include "quadrille/discrete/feasibility.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "feasibility/feasibility_parts.hpp"
#include "feasibility/goal_choice.hpp"

namespace quadrille::discrete {
namespace feasibility {
namespace {

/// Components differ in their shape, and only the shape and the number of free vertices matter.
std::optional<Obstruction> check_component(const Component& component, const Arrangement& start,
                                           const Arrangement& goal) {
  const std::size_t root_degree = component.degree(0);
  if (root_degree <= 1) return check_path(component, start, goal);
  if (root_degree == 2) {
    std::vector<Local> cycle(component.size());
    std::iota(cycle.begin(), cycle.end(), Local{0});
    return check_cycle(component, cycle, start, goal);
  }
  if (component.agents.size() == component.vertices.size())
    return check_full(component, start, goal);
  return check_corridors(component, start, goal);
}

}  // namespace

Arrangement::Arrangement(std::size_t num_vertices, std::vector<Local> vertices)
    : vertex_of(std::move(vertices)),
      agent_at(num_vertices, kNone),
      count_before(num_vertices + 1, 0) {
  for (Local agent = 0; agent < vertex_of.size(); ++agent) agent_at[vertex_of[agent]] = agent;
  for (Local v = 0; v < num_vertices; ++v)
    count_before[v + 1] = count_before[v] + (occupied(v) ? 1 : 0);
}

namespace {

Arrangement arrange(const Instance& instance, const ComponentNumbering& numbering,
                    const Component& component, bool is_goal) {
  std::vector<Local> vertices;
  vertices.reserve(component.agents.size());
  for (const AgentId agent : component.agents)
    vertices.push_back(numbering.number(is_goal ? instance.agents()[agent].goal()
                                                : instance.agents()[agent].start));
  return {component.vertices.size(), std::move(vertices)};
}

Feasibility as_answer(const Component& component, Obstruction obstruction) {
  Feasibility answer;
  answer.feasible = false;
  answer.reason = std::move(obstruction.reason);
  for (const Local agent : obstruction.agents) answer.agents.push_back(component.agents[agent]);
  answer.invariant.kind = obstruction.kind;
  answer.invariant.agent = answer.agents.front();
  std::sort(answer.agents.begin(), answer.agents.end());
  const auto as_vertices = [&](const std::vector<Local>& locals) {
    std::vector<VertexId> vertices;
    for (const Local v : locals) vertices.push_back(component.vertices[v]);
    return vertices;
  };
  answer.vertices = as_vertices(obstruction.vertices);
  answer.invariant.vertices =
      obstruction.invariant.empty() ? answer.vertices : as_vertices(obstruction.invariant);
  if (obstruction.beyond != kNone) answer.invariant.beyond = component.vertices[obstruction.beyond];
  return answer;
}

}  // namespace
}  // namespace feasibility

Feasibility check_feasibility(const Instance& instance) {
  if (!instance.is_plain()) {
    Feasibility open;
    open.is_decided = false;
    return open;
  }
  if (instance.has_goal_sets()) return choose_goals(instance, nullptr).feasibility;
  using namespace feasibility;
  const Graph& graph = instance.graph();
  ComponentNumbering numbering(graph);
  std::vector<Component> components;
  for (const AgentId agent : instance.agent_ids()) {
    const VertexId start = instance.agents()[agent].start, goal = instance.agents()[agent].goal();
    if (numbering.component_of(start) == kNone) components.push_back(numbering.explore(start));
    const Local index = numbering.component_of(start);
    if (numbering.component_of(goal) != index)
      return {false,
              "agent " + std::to_string(agent.value()) + " cannot reach its goal " +
                  vertex_name(graph, goal) + ": no way leads there from its start " +
                  vertex_name(graph, start),
              {agent},
              {start, goal},
              true,
              {Invariant::Kind::component, agent}};
    components[index].agents.push_back(agent);
  }
  for (const Component& component : components) {
    if (component.agents.size() < 2) continue;  // An agent alone goes where it likes.
    const Arrangement start = arrange(instance, numbering, component, false);
    const Arrangement goal = arrange(instance, numbering, component, true);
    if (auto obstruction = check_component(component, start, goal))
      return as_answer(component, std::move(*obstruction));
  }
  return {};
}

}  // namespace quadrille::discrete
