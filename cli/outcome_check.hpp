// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/outcome.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::cli {

/// Replays the plan of an outcome and holds its claims against the replay. A claim that fails turns
/// the outcome into `unknown` with an internal error, without plan, cost and lower bound.
discrete::VerifyReport check_outcome(const discrete::Instance& instance, Objective objective,
                                     discrete::SolveOutcome& outcome);

}  // namespace quadrille::cli
