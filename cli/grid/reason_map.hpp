// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "quadrille/core/reasons.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::cli {

/// The grid with the places of the first `max_sites` sites of each reason, as describe_attribution
/// lists them: the number of the reason, 1 to 9 and then letters, the first one where there are
/// several. Empty for a graph that is no grid, for a grid too large to be shown, and without a
/// place.
[[nodiscard]] std::string draw_reasons(const discrete::Instance& instance,
                                       const Attribution& attribution,
                                       const std::vector<Reason>& reasons, std::size_t max_sites);

/// The grid with the place that an infeasible instance has no plan because of (*), and the starts
/// (a, b, ...) and goals (A, B, ...) of the agents that are named. Empty as above.
[[nodiscard]] std::string draw_obstruction(const discrete::Instance& instance,
                                           const discrete::Feasibility& feasibility);

}  // namespace quadrille::cli
