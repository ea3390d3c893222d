// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/statistics.hpp"
#include "solve/cost_problem.hpp"
#include "solve/cost_report.hpp"
#include "solve/cover_search.hpp"

namespace quadrille::continuous {

/// Finds a plan of least makespan from below: all agents are capped by the bound under test, and a
/// core moves it on to the next cost that one of its agents can have. `known`: a bound, and a plan
/// of any makespan if there is one. Adds to `statistics.cores`. `trace`, unless null, is told of
/// each raise as it comes.
[[nodiscard]] CostReport search_makespan(CostProblem& problem, const CostReport& known,
                                         LimitMonitor& limits, Statistics& statistics,
                                         Correspondent& correspondent, CostTrace* trace);

}  // namespace quadrille::continuous
