// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/solve/settle.hpp"

namespace quadrille::discrete {

/// check_feasibility, or what choices of goals tell where agents have several. Requires that there
/// are no rules.
[[nodiscard]] Feasibility decide_feasibility(const Instance& instance, LimitMonitor& limits);

/// The same as an answer. Requires that it is infeasible.
[[nodiscard]] solve::Infeasibility as_answer(Feasibility feasibility);

/// Of an instance that has rules: that it has no plan, if an agent has none when it is alone, or if
/// there would be none without the rules. Absent: not decided. Throws LimitReached.
[[nodiscard]] std::optional<solve::Infeasibility> refuted_by_rules(const Instance& instance,
                                                                   LimitMonitor& limits);

}  // namespace quadrille::discrete
