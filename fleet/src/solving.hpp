// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "quadrille/continuous/solver.hpp"
#include "quadrille/fleet/solver.hpp"

namespace quadrille::fleet {

/// continuous::solve, or one that knows what has been solved before.
using Search = std::function<Result<continuous::SolveOutcome>(const continuous::Instance&,
                                                              const continuous::SolveOptions&)>;

/// `solve`, by that search for `fleet.instance()`.
[[nodiscard]] Result<SolveOutcome> solve_with(const Fleet& fleet, const SolveOptions& options,
                                              const Search& search);

/// A plan that counts in other units than the fleet. `what`: what it is called.
[[nodiscard]] std::optional<Error> refuse_other_units(const Fleet& fleet, const TimedPlan& plan,
                                                      const std::string& what);

}  // namespace quadrille::fleet
