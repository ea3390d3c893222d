// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// What is fixed about the paths of one agent: its task and distances on the empty graph. Where
/// goals have prices, a path costs its arrival and the price of the goal where it ends, and all
/// that is about costs means that.
class AgentDistances {
 public:
  /// Requires that a goal can be reached from the start. `instance` and `table`, which are of the
  /// same graph and agents, outlive the object, and so do `prices`, which are those of the table;
  /// null: there are none.
  AgentDistances(const Instance& instance, const GoalDistances& table, AgentId agent,
                 const GoalPrices* prices = nullptr);

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }
  [[nodiscard]] VertexId start() const noexcept { return task_.start; }
  [[nodiscard]] const Goals& goals() const noexcept { return task_.goals; }
  [[nodiscard]] bool is_goal(VertexId v) const {
    if (task_.goals.is_single()) return v == task_.goals.only();
    return has_prices() ? task_.goals.contains(v) : to_goal_[v] == 0;
  }
  [[nodiscard]] bool has_prices() const noexcept { return prices_ != nullptr; }
  /// Of a goal.
  [[nodiscard]] Timestep price(VertexId goal) const { return has_prices() ? (*prices_)[goal] : 0; }
  /// Of a goal, for an agent that is there with that slack: the slack of a path that ends so.
  [[nodiscard]] Timestep end_slack(VertexId goal, Timestep slack) const {
    return has_prices() ? slack + price(goal) - to_goal(goal) : slack;
  }
  /// When an agent with that slack is there.
  [[nodiscard]] Timestep time(VertexId v, Timestep slack) const {
    return free_cost() + slack - to_goal(v);
  }
  /// The cost of a path that nothing hinders.
  [[nodiscard]] Timestep free_cost() const noexcept { return to_goal_[task_.start]; }
  /// To the nearest goal, or to the one where the rest of the cost is least; kUnreachable where
  /// there is no way.
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
  const GoalPrices* prices_;
  mutable std::unique_ptr<const GoalDistances::OwnRow> from_start_;
};

}  // namespace quadrille::discrete
