// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/discrete/graph.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// The latest timestep at which an instance may begin.
inline constexpr Timestep kMaxNow = 1'000'000'000;

/// Where an agent begins, and where it may end: it stays for ever at any one of its goals.
struct Agent {
  VertexId start;
  Goals goals;  ///< At least one.

  /// Requires that there is one goal only.
  [[nodiscard]] VertexId goal() const { return goals.only(); }
  friend bool operator==(const Agent&, const Agent&) = default;
};

/// A classic MAPF instance: a graph and the agents on it, which are at their starts at the timestep
/// `now`, 0 if nothing else is said. All timesteps of its plans are absolute, and what they cost
/// counts from `now`. Immutable; cheap to copy (the graph is shared).
class Instance {
 public:
  /// Errors: invalid_instance for a vertex out of range, an agent without a goal, two agents with
  /// the same start, two agents with the same goal and no other one; out_of_range for `now` outside
  /// [0, kMaxNow]. Sets of several goals may overlap. Agents are named by their index in the
  /// message. No agents are allowed. O(V + all goals).
  [[nodiscard]] static Result<Instance> make(std::shared_ptr<const Graph> graph,
                                             std::vector<Agent> agents, Timestep now = 0);
  [[nodiscard]] static Result<Instance> make(Graph graph, std::vector<Agent> agents,
                                             Timestep now = 0);
  /// The same with other agents. Errors as those of `make`.
  [[nodiscard]] Result<Instance> with_agents(std::vector<Agent> agents) const;
  /// The same, but begun at another timestep. Errors: out_of_range. O(agents).
  [[nodiscard]] Result<Instance> with_now(Timestep now) const;

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }
  [[nodiscard]] std::shared_ptr<const Graph> shared_graph() const noexcept { return graph_; }
  [[nodiscard]] const IdVector<AgentId, Agent>& agents() const noexcept { return agents_; }
  [[nodiscard]] std::size_t num_agents() const noexcept { return agents_.size(); }
  [[nodiscard]] IdRange<AgentId> agent_ids() const noexcept {
    return IdRange<AgentId>(num_agents());
  }
  /// The timestep at which all agents are at their starts.
  [[nodiscard]] Timestep now() const noexcept { return now_; }
  /// Some agent has more than one goal.
  [[nodiscard]] bool has_goal_sets() const noexcept { return has_goal_sets_; }

 private:
  Instance(std::shared_ptr<const Graph> graph, IdVector<AgentId, Agent> agents, Timestep now);
  std::shared_ptr<const Graph> graph_;
  IdVector<AgentId, Agent> agents_;
  Timestep now_;
  bool has_goal_sets_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
