// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/solver.hpp"
#include "solve/portfolio.hpp"
#include "solve/tuning.hpp"

namespace quadrille::discrete {

/// Everything but the question whether there is a plan: goal distances, a first plan, the search
/// for the least cost. `companion`, unless null: others that search beside it. The plan in the
/// outcome is not verified yet. Limits and a lack of memory are in the outcome. Throws what
/// callbacks throw.
void search(const Instance& instance, const SolveOptions& options, const Tuning& tuning,
            LimitMonitor& limits, Companion* companion, SolveOutcome& outcome);

}  // namespace quadrille::discrete
