// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// A move whose duration is a whole number of ticks instead of its length divided by the speed.
struct DurationError {
  EdgeId edge;
  AgentId agent;  ///< The first one of its class.
  Ticks planned = 0;
  double exact = 0;  ///< In ticks.
  /// |planned - exact| / exact: by what share of its time the agent is planned to be too fast or
  /// too slow, on all edges that are like this one.
  double relative = 0;
};

/// From this on an error is worth a warning: robots that are planned 5 per cent too fast on one
/// lane after the other are late by a second in twenty.
inline constexpr double kNotableDurationError = 0.05;

/// The largest relative error of a duration that was rounded when the instance was made, among the
/// edges that are open to the agents, of several the one of the first edge and agent. Durations
/// that the roadmap gives are not looked at. nullopt if there are no others. Time: edges times
/// classes of agents.
[[nodiscard]] std::optional<DurationError> largest_duration_error(const Instance& instance);

}  // namespace quadrille::continuous

QUADRILLE_API_END
