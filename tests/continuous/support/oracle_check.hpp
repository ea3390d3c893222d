// SPDX-License-Identifier: MIT
#pragma once

#include "continuous/routes/order_search.hpp"
#include "quadrille/continuous/solver.hpp"

namespace quadrille::continuous::test {

struct Tally {
  int optimal = 0, infeasible = 0, unknown = 0;
  int solvable = 0;  ///< Says the oracle.
};

/// Solves the instance. Whatever the solver says has to agree with what the oracle found with
/// routes of at most `max_moves` moves; fatal failures otherwise.
void check_against(const OrderSearch& oracle, std::size_t max_moves, const Instance& instance,
                   const SolveOptions& options, Tally& tally);

}  // namespace quadrille::continuous::test
