// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lazy/lazy_model.hpp"
#include "paths/explanation.hpp"
#include "paths/path_finder.hpp"
#include "paths/path_index.hpp"
#include "quadrille/lazy/cheapest.hpp"

namespace quadrille::discrete {

/// Searches for paths of one agent around some of its obstacles, with few collisions with the
/// current paths of the others, and says why there is no cheaper one.
class PathSearch {
 public:
  /// Both outlive the object.
  PathSearch(const LazyModel& model, const PathIndex& paths, LimitMonitor& limits);

  using Cheapest = lazy::Cheapest<PathSearch>;
  /// A cheapest path of at most `max_cost` around the obstacles, and of these one with few
  /// collisions.
  [[nodiscard]] Cheapest find_cheapest(AgentId agent, std::span<const ObstacleId> obstacles,
                                       Timestep max_cost);
  /// A path of at most `max_cost` around the obstacles that has fewer collisions than the agent's
  /// current one, valid until the next search. Null if there is none, or if it takes long to find.
  [[nodiscard]] const Path* find_quieter(AgentId agent, std::span<const ObstacleId> obstacles,
                                         Timestep max_cost);

  /// States that all searches have expanded.
  [[nodiscard]] std::int64_t effort() const noexcept { return finder_.effort(); }

 private:
  friend Cheapest;
  /// Some of the obstacles, such that every path of cost at most `bound` does what one of them
  /// forbids. Requires that `bound` is at least the free cost, and less than the cost of the path
  /// that was found, or not above the limit if there is none.
  [[nodiscard]] std::vector<ObstacleId> blame(AgentId agent, Timestep bound);
  void load(AgentId agent, std::span<const ObstacleId> obstacles);

  const LazyModel& model_;
  const PathIndex& paths_;
  ObstacleMap map_;
  PathFinder finder_;
  Explainer explainer_;
  std::int64_t num_searches_ = 0;
  std::vector<ObstacleId> loaded_;  // by slot of map_
  Path path_;
};

}  // namespace quadrille::discrete
