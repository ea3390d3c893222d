// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "quadrille/discrete/solver.hpp"
#include "solve/desk.hpp"
#include "solve/tuning.hpp"

namespace quadrille::discrete {

/// Looks for the plan with the fewest moves among those that cost as much as the one that is known,
/// which is proved optimal, and replaces it. Goes upwards from the moves that agents need when they
/// are alone. What is left of the limits binds; `conflicts` of them were used. Needs an instance
/// that the MDD model knows. Throws what callbacks throw.
[[nodiscard]] Moves break_tie(const Instance& instance, const SolveOptions& options,
                              const Tuner& tuner, const std::shared_ptr<ResourceAccount>& account,
                              std::int64_t conflicts, Knowledge& known);

/// Of a plan that is not known to be one of least cost.
[[nodiscard]] Moves count_moves(const Instance& instance, const Plan& plan);

}  // namespace quadrille::discrete
