// SPDX-License-Identifier: MIT
#include "feasibility/goal_reach.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "paths/earliest_visits.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous {
namespace {

/// Whether no two agents that stay can end in one place. Polygons may lie beside their positions.
bool are_in_each_others_way(const Instance& instance) {
  std::vector<ClassId> classes;
  for (const AgentId i : instance.agent_ids())
    if (!instance.agent(i).leaves) classes.push_back(instance.class_of(i));
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
  for (const ClassId a : classes)
    for (const ClassId b : classes)
      for (const ShapeId shape : IdRange<ShapeId>(instance.roadmap().num_shapes())) {
        const auto& body = instance.body(a, shape);
        if (std::holds_alternative<Disc>(body)) continue;  // with discs pairs are seen from there
        if (!geometry::bodies_overlap(body, Point{}, instance.body(b, shape), Point{}))
          return false;
      }
  return true;
}

/// Goals of the agents that stay, increasing.
std::vector<VertexId> goals_to_rest_at(const Instance& instance) {
  std::vector<VertexId> goals;
  for (const Agent& agent : instance.agents()) {
    if (agent.leaves) continue;
    const auto own = agent.goals.vertices();
    goals.insert(goals.end(), own.begin(), own.end());
  }
  std::sort(goals.begin(), goals.end());
  goals.erase(std::unique(goals.begin(), goals.end()), goals.end());
  return goals;
}

}  // namespace

std::optional<GoalReach> find_goal_reach(const Instance& instance, LimitMonitor& limits) {
  std::size_t num_pairs = 0;
  for (const Agent& agent : instance.agents()) num_pairs += agent.goals.size();
  if (!are_in_each_others_way(instance) || !limits.has_room_for(num_pairs * sizeof(Reach)))
    return std::nullopt;
  GoalReach found;
  found.goals = goals_to_rest_at(instance);
  for (const AgentId i : instance.agent_ids()) {
    const Agent& agent = instance.agent(i);
    if (agent.leaves) continue;
    if (limits.exhausted_now()) return std::nullopt;
    const std::vector<Ticks> visits = earliest_visits(instance, i);
    found.agents.push_back(i);
    std::vector<Reach>& own = found.reach.emplace_back();
    for (const VertexId goal : agent.goals.vertices()) {
      if (visits[goal.index()] >= kForever) continue;
      const auto at = std::lower_bound(found.goals.begin(), found.goals.end(), goal);
      own.push_back(
          {static_cast<std::size_t>(at - found.goals.begin()), as_cost(visits[goal.index()])});
    }
  }
  return found;
}

std::vector<AgentId> find_crowd(const Instance& instance, LimitMonitor& limits) {
  if (!instance.has_goal_sets()) return {};
  const auto found = find_goal_reach(instance, limits);
  if (!found) return {};
  std::vector<AgentId> crowd = quadrille::find_crowd(found->reach, found->goals.size());
  for (AgentId& i : crowd) i = found->agents[i.index()];
  return crowd;
}

}  // namespace quadrille::continuous
