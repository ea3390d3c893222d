// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/continuous/solver.hpp"
#include "solve/companion.hpp"
#include "solve/cost_report.hpp"
#include "solve/inheritance.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// One search for the least cost with a model and an engine of its own, in the calling thread.
/// `scene` is complete and watches `limits`; `known`: a bound, and a plan of any cost if there is
/// one; `companion`, unless null: others that search beside it; of `inheritance`, what was
/// learned counts here. If a limit or the memory ends it, that is in the outcome. Throws what
/// callbacks throw.
[[nodiscard]] SolveOutcome search_alone(Scene& scene, const SolveOptions& options,
                                        const CostReport& known, LimitMonitor& limits,
                                        Companion* companion, const Inheritance& inheritance = {});

/// The outcome of a search that was cut short: says what its plan and bound amount to.
void keep_best(const SolveOptions& options, SolveOutcome& outcome);

}  // namespace quadrille::continuous
