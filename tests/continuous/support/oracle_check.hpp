// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tuple>

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

/// Leaves it in the report of the test that runs.
void record(const Tally& tally);

/// Parameters of tests that ask all systems, for each objective.
using Asked = std::tuple<Objective, System>;
[[nodiscard]] inline auto all_asked() {
  return testing::Combine(testing::Values(Objective::sum_of_costs, Objective::makespan),
                          testing::Values(System::dpll, System::smt_cbs));
}
/// "SumOfCostsDpll", ...
[[nodiscard]] std::string name_of(const testing::TestParamInfo<Asked>& param);

}  // namespace quadrille::continuous::test
