// SPDX-License-Identifier: MIT
#include "continuous/support/oracle_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous::test {
namespace {

bool has_long_path(const Plan& plan, std::size_t max_moves) {
  return std::any_of(plan.paths.begin(), plan.paths.end(),
                     [&](const Path& path) { return path.size() > max_moves + 1; });
}

}  // namespace

void check_against(const OrderSearch& oracle, std::size_t max_moves, const Instance& instance,
                   const SolveOptions& options, Tally& tally) {
  const SolveOutcome outcome = solve(instance, options).value();
  ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
  if (oracle.best) {
    ++tally.solvable;
    ASSERT_LE(outcome.lower_bound, *oracle.best);
  }
  switch (outcome.status) {
    case Status::optimal:
      ++tally.optimal;
      ASSERT_TRUE(verify(instance, *outcome.plan).valid());
      ASSERT_EQ(cost(*outcome.plan, options.objective), outcome.lower_bound);
      if (!has_long_path(*outcome.plan, max_moves)) {
        ASSERT_TRUE(oracle.best) << "the oracle found no plan";
        ASSERT_EQ(outcome.lower_bound, *oracle.best);
      }
      break;
    case Status::infeasible:
      ++tally.infeasible;
      ASSERT_FALSE(oracle.best);
      break;
    case Status::unknown:
      ++tally.unknown;
      break;
    case Status::feasible:
      ++tally.unknown;
      ASSERT_TRUE(verify(instance, *outcome.plan).valid());
      ASSERT_GT(cost(*outcome.plan, options.objective), outcome.lower_bound);
      break;
  }
}

void record(const Tally& tally) {
  testing::Test::RecordProperty("optimal", tally.optimal);
  testing::Test::RecordProperty("infeasible", tally.infeasible);
  testing::Test::RecordProperty("unknown", tally.unknown);
  testing::Test::RecordProperty("solvable", tally.solvable);
}

std::string name_of(const testing::TestParamInfo<Asked>& param) {
  const auto [objective, system] = param.param;
  return std::string(objective == Objective::makespan ? "Makespan" : "SumOfCosts") +
         (system == System::dpll ? "Dpll" : "SmtCbs");
}

}  // namespace quadrille::continuous::test
