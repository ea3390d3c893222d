// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "quadrille/continuous/solver.hpp"
#include "solve/desk.hpp"
#include "solve/priced_goals.hpp"

namespace quadrille::continuous {

/// nullopt where they are no use. They are for sums of costs; what a bound is made of is told
/// without prices, as certificates are, and the published system knows none.
[[nodiscard]] std::optional<PricedGoals> price_goals(const Instance& instance,
                                                     const SolveOptions& options,
                                                     LimitMonitor& limits);

/// Solves `instance` by the phases of a solve of the one with prices. `account` as for Phases.
/// Throws what callbacks throw.
void search_with_prices(const Instance& instance, const PricedGoals& priced,
                        const SolveOptions& options,
                        const std::shared_ptr<ResourceAccount>& account, const Desk& desk);

}  // namespace quadrille::continuous
