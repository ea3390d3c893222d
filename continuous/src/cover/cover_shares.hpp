// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cover/core_table.hpp"

namespace quadrille::continuous {

/// A part of what the cheapest cover costs above the free costs: any costs that hit all cores of
/// some shares amount to their sum or more.
struct CoverShare {
  Cost amount = 0;  ///< At least 1.
  std::vector<AgentId> agents;
  bool is_of_one_core = true;  ///< Else of all cores of these agents.
};

/// Divides what covers of some cores cost at least, `bound` above the free costs, among the cores:
/// multipliers of a linear program, in integers. What these do not explain, because a cover costs
/// more than fractional ones, is one share of all cores together. One linear program; the shares
/// amount to `bound` or more. Requires levels above the free costs.
[[nodiscard]] std::vector<CoverShare> share_out(const IdVector<AgentId, Cost>& free_costs,
                                                std::span<const LevelCore* const> cores,
                                                Cost bound);

}  // namespace quadrille::continuous
