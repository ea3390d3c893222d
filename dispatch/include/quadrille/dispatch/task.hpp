// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

/// Of the fleet's time: timesteps on grids and graphs.
using geometry::Ticks;

/// Somewhere to go.
struct Task {
  Goals goals;        ///< Any one of these.
  Ticks service = 0;  ///< How long the robot stays there before it is free again.
  /// By when it should be there. Says who is more urgent, and no more: who comes late does come.
  std::optional<Ticks> deadline = {};
};

/// What a call of a dispatcher did.
struct News {
  std::vector<AgentId> served;  ///< Whose task is done, in order; once per task.
  std::size_t num_sent = 0;     ///< That got a path to their goal.
  std::size_t num_waiting =
      0;  ///< That have a task and no path to it: for want of one, or of turn.
  bool has_new_plan = false;
  /// There was a new plan, but somebody has been allowed already what it leaves to others.
  bool was_too_late = false;
  bool has_new_origin = false;  ///< Late robots are planned for from where they are.
  /// Of the robots with a path to their goal: from the beginning of what is not settled yet until
  /// they arrive, in sum, and what that is at least: without the others.
  Cost cost = 0, lower_bound = 0;
  Effort effort;
};

}  // namespace quadrille::dispatch

QUADRILLE_API_END
