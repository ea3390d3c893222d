// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pibt/guidance.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// A path for each agent, such that they meet in few places: whoever moves agents along them has
/// fewer jams than by shortest paths, which crowd in the same lanes (space utilisation
/// optimisation; Han and Yu, "Optimizing space utilization for more effective multi-robot path
/// planning", ICRA 2022; as a guide of LaCAM: Okumura, "Engineering LaCAM*", AAMAS 2024).
class Guide final : public Guidance {
 public:
  /// Elementary steps, a few seconds. Agents that are left then keep the path they have, at first a
  /// shortest one.
  static constexpr std::int64_t kMostEffort = 10'000'000;

  /// Plans a path without waits for one agent after the other, with as few meetings as possible
  /// with those of the others among those that are at most `margin` longer than a shortest one; and
  /// again, up to three times, until that brings fewer meetings no more. Every vertex is reached at
  /// one time only, so that it is not quite the fewest. Takes O(agents * vertices) at worst, the
  /// length of the paths where there is room; memory for the paths. When a limit is met some agents
  /// have no path. `distances` are those of `instance`; every goal can be reached; margin >= 0.
  Guide(const Instance& instance, const GoalDistances& distances, Timestep margin,
        std::uint32_t seed, LimitMonitor& limits);

  /// Where the agent's path leads on from a vertex. nullopt if it ends there or does not pass it.
  /// O(log(length of the path)).
  [[nodiscard]] std::optional<VertexId> next(AgentId agent, VertexId from) const override;
  /// Elementary steps that it took.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  struct Step {
    VertexId from, to;
  };
  IdVector<AgentId, std::vector<Step>> steps_;  // In order of `from`.
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::discrete
