// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "model/blocked_times.hpp"
#include "model/poses.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// What is fixed about the paths of one agent: its task, the rules that it obeys whoever else is
/// there, and distances on the empty graph. Where goals have prices, a path costs its arrival and
/// the price of the goal where it ends, and all that is about costs means that.
///
/// Searches go over *states*. Those of most agents are the vertices. Where turns take time they are
/// the poses, of which several are in one vertex. An agent that has waypoints is in one of these
/// having visited the first so many of them, all that it could.
class AgentDistances {
 public:
  /// Requires that a goal can be reached from the start unless the instance has rules. `instance`
  /// and `table`, which are of the same graph and agents, outlive the object, and so do `prices`,
  /// which are those of the table, and `blocked`; null: there are none.
  AgentDistances(const Instance& instance, const GoalDistances& table, AgentId agent,
                 const GoalPrices* prices = nullptr, const BlockedTimes* blocked = nullptr);

  // ---- the task

  /// The vertices and edges.
  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }
  /// A vertex.
  [[nodiscard]] VertexId start() const noexcept { return task_.start; }
  /// Vertices.
  [[nodiscard]] const Goals& goals() const noexcept { return task_.goals; }
  [[nodiscard]] bool leaves() const noexcept { return task_.leaves; }
  /// It is there at that timestep, whatever it does.
  [[nodiscard]] bool is_inevitable(VertexId v, Timestep t) const {
    return v == task_.start && (t == 0 || (t <= task_.release && !may_end_at_once_));
  }
  [[nodiscard]] bool has_prices() const noexcept { return prices_ != nullptr; }
  /// Of a goal.
  [[nodiscard]] Timestep price(VertexId goal) const { return has_prices() ? (*prices_)[goal] : 0; }

  // ---- states

  [[nodiscard]] const Graph& states() const noexcept { return layers_ ? *layers_ : *graph_; }
  [[nodiscard]] VertexId start_state() const noexcept { return start_state_; }
  /// The vertex.
  [[nodiscard]] VertexId place(VertexId state) const {
    return layers_ ? VertexId(state.index() % graph_->num_vertices()) : state;
  }
  /// Calls `tell(state)` for each state in which the agent, at that goal, may end: one, or two
  /// where it turns and need not go anywhere.
  template <class Tell>
  void for_each_end(VertexId goal, const Tell& tell) const {
    const std::size_t first = task_.waypoints.size() * num_poses_;
    if (!has_poses_) return tell(VertexId(first + goal.index()));
    tell(VertexId(first + kParked * graph_->num_vertices() + goal.index()));
    if (VertexId(start_state_.index() % graph_->num_vertices()) == goal &&
        start_state_.index() >= first)
      tell(start_state_);
  }
  /// There is one goal, and one state to end in.
  [[nodiscard]] bool has_one_end() const {
    return task_.goals.is_single() && (!has_poses_ || task_.start != task_.goals.only());
  }
  /// Calls `tell(state)` for each one in that vertex.
  template <class Tell>
  void for_each_state(VertexId v, const Tell& tell) const {
    for (std::size_t s = v.index(); s < states().num_vertices(); s += graph_->num_vertices())
      tell(VertexId(s));
  }
  /// Calls `tell(from, to)` for each step between states that is a move from vertex to vertex.
  template <class Tell>
  void for_each_step(VertexId v, VertexId w, const Tell& tell) const {
    for_each_state(v, [&](VertexId from) {
      if (!layers_) return tell(from, w);
      for (const VertexId to : layers_->neighbours(from))
        if (place(to) == w) tell(from, to);
    });
  }
  /// Where somebody is at `t` whose path this is.
  [[nodiscard]] VertexId state_at(const Path& path, Timestep t) const;
  /// Whether the agent may end in the state.
  [[nodiscard]] bool is_goal(VertexId state) const {
    if (layers_) return own_to_goal_[state] == 0;
    if (task_.goals.is_single()) return state == task_.goals.only();
    return has_prices() ? task_.goals.contains(state) : to_goal_[state] == 0;
  }

  // ---- rules

  /// Something forbids steps besides obstacles.
  [[nodiscard]] bool has_bans() const noexcept { return blocked_ != nullptr || task_.release > 0; }
  /// Rules forbid to be in a vertex at that timestep.
  [[nodiscard]] bool is_banned(VertexId v, Timestep t) const {
    return (t <= task_.release && v != task_.start) ||
           (blocked_ != nullptr && blocked_->forbids(v, t));
  }
  /// Rules forbid to go from vertex to vertex then, or to be there after it.
  [[nodiscard]] bool is_step_banned(VertexId from, VertexId to, Timestep t) const {
    return is_banned(to, t + 1) ||
           (from != to && blocked_ != nullptr && blocked_->forbids_move(from, to, t));
  }
  /// The first timestep from `t` on at which rules allow to begin the move from vertex to vertex,
  /// if it may be there after it; kForever: never.
  [[nodiscard]] Timestep next_move(VertexId from, VertexId to, Timestep t) const {
    return blocked_ == nullptr ? t : blocked_->next_move(from, to, t);
  }
  /// From when on rules allow to rest at a goal; kForever: never.
  [[nodiscard]] Timestep may_rest_from(VertexId goal) const {
    return blocked_ == nullptr || task_.leaves ? 0 : blocked_->free_from(goal);
  }
  /// Calls `tell(first, last)` for each span of time in which rules forbid to be in a vertex.
  template <class Tell>
  void for_each_ban(VertexId v, const Tell& tell) const {
    if (v != task_.start && task_.release > 0) tell(Timestep{0}, task_.release);
    if (blocked_ == nullptr) return;
    for (const BlockedTimes::Span& span : blocked_->at(v)) tell(span.first, span.last);
  }
  [[nodiscard]] std::optional<Timestep> deadline() const noexcept { return task_.deadline; }

  // ---- distances

  /// The cost of a path that no other agent hinders. Where there are rules, that has to be told
  /// with `set_free_cost`; until then, what the way to the goal is long.
  [[nodiscard]] Timestep free_cost() const noexcept { return free_cost_; }
  void set_free_cost(Timestep cost) noexcept { free_cost_ = cost; }
  /// What the way to the goal is long; kUnreachable: there is none. Slack is counted from here.
  [[nodiscard]] Timestep length() const noexcept { return length_; }
  /// Of a goal, for an agent that is there with that slack: the slack of a path that ends so.
  [[nodiscard]] Timestep end_slack(VertexId goal, Timestep slack) const {
    return has_prices() ? slack + price(goal) - to_goal(goal) : slack;
  }
  /// When an agent with that slack is in that state.
  [[nodiscard]] Timestep time(VertexId state, Timestep slack) const {
    return length_ + slack - to_goal(state);
  }
  /// From a state to the nearest goal, or to the one where the rest of the cost is least;
  /// kUnreachable where there is no way.
  [[nodiscard]] Timestep to_goal(VertexId state) const {
    return layers_ ? own_to_goal_[state] : to_goal_[state];
  }
  /// Of state and timestep: an agent that passes there is at least that much later than on the
  /// shortest way.
  [[nodiscard]] Timestep slack(VertexId state, Timestep t) const {
    return t + to_goal(state) - length_;
  }
  /// The most that one step adds to the slack. O(1) on undirected graphs.
  [[nodiscard]] Timestep largest_step() const noexcept { return largest_step_; }
  /// To a state, without bans. Computed at the first call: only agents that meet others need it.
  [[nodiscard]] Timestep from_start(VertexId state) const {
    if (layers_) {
      if (own_from_start_.empty()) own_from_start_ = distances_from(*layers_, start_state_);
      return own_from_start_[state];
    }
    if (from_start_ == nullptr) find_from_start();
    return (*from_start_)[state];
  }

 private:
  void find_from_start() const;
  /// Of poses or vertices, and how many waypoints are visited.
  void make_layers(const Graph& poses);
  void find_largest_step();

  const Graph* graph_;
  const GoalDistances* table_;
  Agent task_;
  GoalDistances::Row to_goal_;
  const GoalPrices* prices_;
  const BlockedTimes* blocked_;
  // state = number of waypoints visited * number of poses + pose, where a pose is in the vertex
  // that is left over by V; null where the states are the vertices.
  std::shared_ptr<const Graph> layers_;
  IdVector<VertexId, Timestep> own_to_goal_;
  mutable IdVector<VertexId, Timestep> own_from_start_;
  std::size_t num_poses_;
  bool has_poses_;
  VertexId start_state_;
  Timestep length_ = 0, free_cost_ = 0, largest_step_ = 2;
  bool may_end_at_once_ = false;
  mutable std::unique_ptr<const GoalDistances::OwnRow> from_start_;
};

}  // namespace quadrille::discrete
