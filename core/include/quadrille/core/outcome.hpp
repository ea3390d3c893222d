// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What is minimised. The cost of an agent is the time at which it arrives at its goal for the last
/// time; the makespan is the largest of them.
enum class Objective { sum_of_costs, makespan };

/// What is claimed about an instance. Only `optimal` and `infeasible` are proofs.
enum class Status {
  optimal,     ///< A plan whose cost equals the proven lower bound.
  feasible,    ///< A plan, and a proven lower bound that is smaller than its cost.
  infeasible,  ///< Proved: no plan exists.
  unknown,     ///< No plan; a limit ended the search, or a proof was lost.
};

/// What ended a search. `none`: it ended by itself. `gap`: the plan is as close to the lower bound
/// as was asked for.
enum class StopReason { none, wall_time, cpu_time, memory, conflicts, interrupt, gap };

[[nodiscard]] std::string_view to_string(
    Objective objective) noexcept;                                 ///< "sum-of-costs" | "makespan"
[[nodiscard]] std::string_view to_string(Status status) noexcept;  ///< "optimal" | ...
[[nodiscard]] std::string_view to_string(
    StopReason reason) noexcept;  ///< "none" | "wall-time" | ...

/// By how many per cent of the lower bound a plan may be too dear: 100 * (cost - bound) / bound.
/// Infinite for a bound of 0 and a higher cost. Requires 0 <= bound <= cost.
[[nodiscard]] double gap_percent(Cost cost, Cost lower_bound);
/// Whether that is no more than `wanted`; not so when nothing is wanted.
[[nodiscard]] bool is_within_gap(std::optional<double> wanted, Cost cost, Cost lower_bound);

}  // namespace quadrille

QUADRILLE_API_END
