// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/discrete/graph.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// Where an agent begins and where it has to stay at the end.
struct Task {
  VertexId start;
  VertexId goal;
  friend bool operator==(const Task&, const Task&) = default;
};

/// A classic MAPF instance: a graph and one task per agent. Immutable; cheap to copy (the graph is
/// shared).
class Instance {
 public:
  /// Errors (invalid_instance): a vertex out of range, two agents with the same start, two agents
  /// with the same goal. Agents are named by their index in the message. No agents are allowed.
  [[nodiscard]] static Result<Instance> make(std::shared_ptr<const Graph> graph,
                                             std::vector<Task> tasks);
  [[nodiscard]] static Result<Instance> make(Graph graph, std::vector<Task> tasks);

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }
  [[nodiscard]] std::shared_ptr<const Graph> shared_graph() const noexcept { return graph_; }
  [[nodiscard]] const IdVector<AgentId, Task>& tasks() const noexcept { return tasks_; }
  [[nodiscard]] std::size_t num_agents() const noexcept { return tasks_.size(); }
  [[nodiscard]] IdRange<AgentId> agents() const noexcept { return IdRange<AgentId>(num_agents()); }

 private:
  Instance(std::shared_ptr<const Graph> graph, IdVector<AgentId, Task> tasks);
  std::shared_ptr<const Graph> graph_;
  IdVector<AgentId, Task> tasks_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
