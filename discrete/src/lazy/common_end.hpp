// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/agent_distances.hpp"

namespace quadrille::discrete {

/// The states of an agent that may end in several of them, and states behind these that all lead to
/// one: explicit paths need one to end in (docs/soundness/lazy.md, 6.7).
///
/// Who arrives in an end at `a` is at rest in a state of this end at a + 1. From there it goes
/// along a chain, which all ends share, for as many steps as the price of its goal: so it is home
/// at two timesteps after what it costs.
class CommonEnd {
 public:
  /// It may end in several states, or where that has a price.
  [[nodiscard]] static bool is_needed(const AgentDistances& distances) {
    return !distances.has_one_end() || distances.price(distances.goals().only()) > 0;
  }
  /// O(V + E + goals + largest price).
  explicit CommonEnd(const AgentDistances& distances);

  struct End {
    VertexId state;  // of the agent
    VertexId goal;   // the vertex
    VertexId rest;   // of the graph
  };
  /// States of the agent have the numbers that they had.
  [[nodiscard]] const Graph& graph() const noexcept { return graph_; }
  [[nodiscard]] const std::vector<End>& ends() const noexcept { return ends_; }
  [[nodiscard]] VertexId home() const noexcept { return home_; }
  /// For an agent that arrives in that end at `arrival`: where it is at `t`, later than that.
  [[nodiscard]] VertexId state_at(const End& end, Timestep arrival, Timestep price,
                                  Timestep t) const;

 private:
  std::vector<End> ends_;
  VertexId home_;
  Graph graph_;
};

/// How much later than its cost says an agent is home.
inline constexpr Timestep kWayHome = 2;

}  // namespace quadrille::discrete
