// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "paths/agent_distances.hpp"
#include "paths/obstacle_map.hpp"

namespace quadrille::discrete {

/// Says why an agent has no cheap path: a cut of the time-expanded graph between its start and a
/// rest at any of its goals from the bound on; of an agent that leaves, any arrival by then. Steps
/// that rules forbid are no part of that graph.
class Explainer {
 public:
  explicit Explainer(std::size_t num_vertices) : seen_(num_vertices, 0) {}

  /// Appends slots of `obstacles` such that every path of cost at most `bound` meets one of them.
  /// Requires that there is no such path around the loaded obstacles, that `bound` is at least the
  /// free cost, and `first_hits` of a PathFinder::find_cheapest that failed with a limit of at
  /// least `bound` or found a path that costs more than `bound`. Prefers low slots.
  void explain(const AgentDistances& distances, const ObstacleMap& obstacles,
               std::span<const Timestep> first_hits, Timestep bound,
               std::vector<std::size_t>& slots);

 private:
  /// Collects a slot for each goal that some slot forbids when a path that costs `bound` arrives
  /// there, or later. The others that can be reached by then become ends, the latest first.
  void cut_off_blocked_goals(const AgentDistances& distances, const ObstacleMap& obstacles,
                             Timestep bound, std::vector<std::size_t>& slots);
  /// Of an agent that leaves: makes all its arrivals within the bound ends, the latest first.
  /// `is_cut(goal, t)`.
  template <class IsCut>
  void begin_with_arrivals(const AgentDistances& distances, Timestep bound, const IsCut& is_cut);

  std::vector<Visit> ends_;                 // of states
  std::vector<VertexId> frontier_, next_;   // states of the agent
  IdVector<VertexId, std::uint64_t> seen_;  // likewise
  std::uint64_t stamp_ = 0;
  std::vector<char> taken_;   // by slot
  std::vector<char> is_cut_;  // by goal
};

}  // namespace quadrille::discrete
