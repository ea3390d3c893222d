// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::poses {

/// The same instance on the grid in discrete time, where turns take time (discrete::Rules::turn):
/// its plans have the same costs. nullopt if there is none: for agents that are no discs of at most
/// PoseGrid::kRadius or whose moves do not take one tick, goals with some headings only, a
/// beginning later than 0, agents that leave, are released, have a deadline, are under way or
/// overlap at their starts, two with the same cell as their only goal, moving obstacles, turns of
/// more than discrete::kMaxTurn ticks, and a roadmap that is not like `grid`'s. O(V + E + goals).
[[nodiscard]] std::optional<discrete::Instance> in_steps(const continuous::PoseGrid& grid,
                                                         const continuous::Instance& instance);

/// A plan of the instance that `in_steps` makes, as one of the instance it was made of. Robots turn
/// as soon as they have come, and a half turn to the right. Requires a valid plan. O(plan).
[[nodiscard]] continuous::Plan in_ticks(const continuous::PoseGrid& grid,
                                        const continuous::Instance& instance,
                                        const discrete::Plan& plan);
/// The other way round. What a robot turns after it has come to its goal is dropped, so that a plan
/// may cost less then. Requires a valid plan whose moves and stays begin at whole ticks. O(length
/// of the plan).
[[nodiscard]] discrete::Plan in_steps(const continuous::PoseGrid& grid,
                                      const discrete::Instance& instance,
                                      const continuous::Plan& plan);

/// continuous::solve, by the discrete domain where `in_steps` knows the instance, which is many
/// times faster; with `explain` or `proof`, or another system than dpll, by the continuous one. The
/// plan is verified in continuous time. Errors as those of continuous::solve.
[[nodiscard]] Result<continuous::SolveOutcome> solve(const continuous::PoseGrid& grid,
                                                     const continuous::Instance& instance,
                                                     const continuous::SolveOptions& options);

}  // namespace quadrille::poses

QUADRILLE_API_END
