// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// Later than all times of a plan (2^61); sums and differences of up to three such times do not
/// overflow.
inline constexpr Ticks kForever{std::numeric_limits<std::int64_t>::max() / 4};
/// More than any plan costs.
inline constexpr Cost kAnyCost = as_cost(kForever);

/// An agent's arrivals have to be before this: after its deadline, or kForever.
[[nodiscard]] inline Ticks arrival_bound(const Instance& instance, AgentId agent) {
  const auto& deadline = instance.agent(agent).deadline;
  return deadline ? *deadline + 1 : kForever;
}

/// One move of a path.
struct Move {
  EdgeId edge;
  Ticks start = 0;
  friend bool operator==(const Move&, const Move&) = default;
};

/// A path as the search sees it: its moves in order; the stays follow from them.
struct TimedPath {
  std::vector<Move> moves;
  Ticks arrival = 0;  ///< At the goal, for the last time.
  friend bool operator==(const TimedPath&, const TimedPath&) = default;
};

/// The path with these stops: the first edge that fits takes it from each to the next. Requires a
/// valid path of the agent.
[[nodiscard]] TimedPath without_stops(const Instance& instance, AgentId agent, const Path& stops);

/// The path with its stops.
[[nodiscard]] Path with_stops(const Instance& instance, AgentId agent, const TimedPath& path);

}  // namespace quadrille::continuous
