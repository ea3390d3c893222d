// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "quadrille/sat/cost_search.hpp"

namespace quadrille::sat {

/// Asks the engine for a plan under some assumptions, which bound every agent's cost. Models that
/// are no plans are excluded on the way; the plan is offered to the bounds. `unknown` when the
/// limits, or that number of conflicts, came before an answer. Solves in slices of effort, and
/// passes the yield point after each.
[[nodiscard]] Verdict find_plan(const CostSearchContext& context, std::span<const Lit> assumptions,
                                std::optional<std::int64_t> conflicts = std::nullopt);

}  // namespace quadrille::sat
