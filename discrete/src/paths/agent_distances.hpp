// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// What is fixed about the paths of one agent: its task and distances on the empty graph.
class AgentDistances {
 public:
  /// Requires that a goal can be reached from the start. `instance` and `table`, which are of the
  /// same graph and agents, outlive the object.
  AgentDistances(const Instance& instance, const GoalDistances& table, AgentId agent);

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }
  [[nodiscard]] VertexId start() const noexcept { return task_.start; }
  [[nodiscard]] const Goals& goals() const noexcept { return task_.goals; }
  [[nodiscard]] bool is_goal(VertexId v) const {
    return task_.goals.is_single() ? v == task_.goals.only() : to_goal_[v] == 0;
  }
  /// The cost of a path that nothing hinders.
  [[nodiscard]] Timestep free_cost() const noexcept { return to_goal_[task_.start]; }
  /// To the nearest goal; kUnreachable where there is no way.
  [[nodiscard]] Timestep to_goal(VertexId v) const { return to_goal_[v]; }
  /// Of vertex and timestep: an agent that passes there is at least that much later than free.
  [[nodiscard]] Timestep slack(VertexId v, Timestep t) const {
    return t + to_goal_[v] - free_cost();
  }
  /// Computed at the first call: only agents that meet others need it.
  [[nodiscard]] Timestep from_start(VertexId v) const {
    if (from_start_ == nullptr) find_from_start();
    return (*from_start_)[v];
  }

 private:
  void find_from_start() const;

  const Graph* graph_;
  const GoalDistances* table_;
  Agent task_;
  GoalDistances::Row to_goal_;
  mutable std::unique_ptr<const GoalDistances::OwnRow> from_start_;
};

}  // namespace quadrille::discrete
