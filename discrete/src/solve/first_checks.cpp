// SPDX-License-Identifier: MIT
#include "solve/first_checks.hpp"

#include <string>
#include <utility>
#include <vector>

#include "feasibility/goal_choice.hpp"
#include "paths/lone_agents.hpp"
#include "quadrille/discrete/goal_distances.hpp"

namespace quadrille::discrete {
namespace {

solve::Infeasibility told_of_stuck(const Instance& instance, AgentId agent) {
  const Agent& task = instance.agents()[agent];
  std::string reason = "agent " + std::to_string(agent.value()) + " has no way from " +
                       vertex_name(instance.graph(), task.start) + " to " +
                       (task.goals.is_single() ? vertex_name(instance.graph(), task.goal())
                                               : std::string("any of its goals")) +
                       " that keeps the rules, even if it is alone";
  if (task.deadline) reason += "; its deadline is one of them";
  std::vector<VertexId> vertices{task.start};
  for (const VertexId goal : task.goals.vertices()) vertices.push_back(goal);
  return {std::move(reason), {agent}, std::move(vertices)};
}

}  // namespace

Feasibility decide_feasibility(const Instance& instance, LimitMonitor& limits) {
  return instance.has_goal_sets() ? choose_goals(instance, &limits).feasibility
                                  : check_feasibility(instance);
}

solve::Infeasibility as_answer(Feasibility feasibility) {
  return {std::move(feasibility.reason), std::move(feasibility.agents),
          std::move(feasibility.vertices)};
}

std::optional<solve::Infeasibility> refuted_by_rules(const Instance& instance,
                                                     LimitMonitor& limits) {
  const auto distances = GoalDistances::make(instance, limits);
  if (!distances) return std::nullopt;
  if (const auto stuck = lone_costs(instance, *distances, limits).stuck)
    return told_of_stuck(instance, *stuck);
  std::vector<AgentId> staying;
  for (const AgentId i : instance.agent_ids())
    if (!instance.agents()[i].leaves) staying.push_back(i);
  Feasibility feasibility = decide_feasibility(instance.relaxed(), limits);
  if (feasibility.feasible) return std::nullopt;
  if (staying.size() < instance.num_agents()) {
    // The reason names agents by other numbers.
    feasibility.reason = "the agents that stay at their goals have no plan, whatever the rules";
    for (AgentId& agent : feasibility.agents) agent = staying[agent.index()];
  }
  return as_answer(std::move(feasibility));
}

}  // namespace quadrille::discrete
