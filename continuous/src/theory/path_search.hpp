// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/lazy/cheapest.hpp"
#include "theory/explanation.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// What steps of a PathFinder, edges and visits, take.
[[nodiscard]] constexpr Effort effort_of_paths(std::int64_t steps) {
  return steps * Effort::nanoseconds(50);
}

/// Searches for paths of one agent that obey the bans of some of its obstacles, and says why there
/// is no cheaper one.
class PathSearch {
 public:
  /// `model` outlives the object. Searches throw LimitReached when the model's limits are met.
  explicit PathSearch(Model& model);

  using Cheapest = lazy::Cheapest<PathSearch>;
  /// A cheapest path that obeys the bans of the obstacles and arrives before `bound`.
  [[nodiscard]] Cheapest find(AgentId agent, std::span<const ObstacleId> obstacles, Cost bound);

  /// What all searches have taken.
  [[nodiscard]] Effort effort() const noexcept { return effort_of_paths(finder_.effort()); }

 private:
  friend Cheapest;
  /// Some of the obstacles, such that every path that arrives before `bound` breaks a ban of one of
  /// them; none can be left out. Requires that no path around all of them arrives before `bound`.
  /// Time: some searches for each obstacle that matters.
  [[nodiscard]] std::vector<ObstacleId> blame(AgentId agent, Cost bound);

  const Model& model_;
  PathFinder finder_;
  BanTable bans_;
  Explainer explainer_;
  std::int64_t num_searches_ = 0;
  std::vector<ObstacleId> loaded_;  // by slot of bans_
  TimedPath path_;
};

}  // namespace quadrille::continuous
