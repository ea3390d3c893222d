// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// What is fixed about the paths of one agent: its task and distances on the empty graph.
class AgentDistances {
 public:
  /// Requires that the goal can be reached from the start. `graph` and the table of `to_goal`
  /// outlive the object.
  AgentDistances(const Graph& graph, const Task& task, GoalDistances::Row to_goal);

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }
  [[nodiscard]] VertexId start() const noexcept { return task_.start; }
  [[nodiscard]] VertexId goal() const noexcept { return task_.goal; }
  /// The cost of a path that nothing hinders.
  [[nodiscard]] Timestep free_cost() const noexcept { return to_goal_[task_.start]; }
  /// kUnreachable where there is no way.
  [[nodiscard]] Timestep to_goal(VertexId v) const { return to_goal_[v]; }
  /// Of vertex and timestep: an agent that passes there is at least that much later than free.
  [[nodiscard]] Timestep slack(VertexId v, Timestep t) const {
    return t + to_goal_[v] - free_cost();
  }
  /// Computed at the first call: only agents that meet others need it.
  [[nodiscard]] Timestep from_start(VertexId v) const;

 private:
  const Graph* graph_;
  Task task_;
  GoalDistances::Row to_goal_;
  mutable std::optional<IdVector<VertexId, Timestep>> from_start_;
};

}  // namespace quadrille::discrete
