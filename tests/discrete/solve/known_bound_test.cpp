// SPDX-License-Identifier: MIT
// Lower bounds that the user knows: what rests on them says so, and a wrong one is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

struct Case {
  Instance instance;
  SolveOptions options;
  Cost truth = 0;
};

std::vector<Case> cases(std::size_t count) {
  std::vector<Case> found;
  Random random(5);
  for (int k = 0; found.size() < count && k < 400; ++k) {
    const Instance instance = random_grid(random, {5, 5, 4, 4, 6});
    SolveOptions options;
    options.objective = k % 2 == 0 ? Objective::makespan : Objective::sum_of_costs;
    constexpr System kSystems[] = {System::dpll, System::dpll_mdd, System::smt_cbs,
                                   System::mdd_sat};
    options.system = kSystems[k % 4];
    options.threads = k % 5 == 0 ? 3 : 1;
    options.first_plan = k % 3 != 0;
    options.limits.cpu_s = 0.3;
    const SolveOutcome truth = solve(instance, options).value();
    if (truth.status == Status::optimal) found.push_back({instance, options, *truth.cost});
  }
  return found;
}

/// Few of them rest on the bound.
std::size_t many() { return std::max<std::size_t>(20, scaled(40)); }

TEST(KnownBound, TrueOnesChangeNoAnswer) {
  int num_resting = 0, num_raised = 0;
  for (const Case& c : cases(many()))
    for (const Cost less : {0, 1, 3}) {
      SolveOptions options = c.options;
      options.known_lower_bound = std::max<Cost>(c.truth - less, 0);
      const SolveOutcome outcome = solve(c.instance, options).value();
      ASSERT_EQ(outcome.status, Status::optimal) << outcome.explanation;
      ASSERT_EQ(outcome.cost, c.truth);
      if (outcome.rests_on_known_bound) {
        ASSERT_EQ(*options.known_lower_bound, c.truth);
        ++num_resting;
      } else if (less > 0) {
        ++num_raised;
      }
    }
  EXPECT_GT(num_resting, 0);
  EXPECT_GT(num_raised, 0);
}

TEST(KnownBound, WrongOnesAreRefusedWhenAPlanSaysSo) {
  int num_refused = 0, num_believed = 0;
  for (const Case& c : cases(many()))
    for (const Cost more : {1, 4}) {
      SolveOptions options = c.options;
      options.known_lower_bound = c.truth + more;
      const auto outcome = solve(c.instance, options);
      if (!outcome) {
        ++num_refused;
        ASSERT_EQ(outcome.error().code, ErrorCode::out_of_range);
        ASSERT_NE(outcome.error().message.find("the known lower bound is wrong"),
                  std::string::npos);
        continue;
      }
      ++num_believed;
      ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message;
      ASSERT_EQ(outcome->lower_bound, c.truth + more);
      ASSERT_TRUE(outcome->rests_on_known_bound);
    }
  EXPECT_GT(num_refused, num_believed);
}

TEST(KnownBound, APlanOfThatCostIsAllThatIsNeeded) {
  for (Case& c : cases(12)) {
    SolveOptions options = c.options;
    options.initial_plan = solve(c.instance, options).value().plan;
    options.known_lower_bound = c.truth;
    const SolveOutcome outcome = solve(c.instance, options).value();
    EXPECT_EQ(outcome.status, Status::optimal);
    EXPECT_EQ(outcome.statistics.conflicts, 0);
    options.known_lower_bound = c.truth + 1;
    EXPECT_EQ(solve(c.instance, options).error().code, ErrorCode::out_of_range);
    options.known_lower_bound = -1;
    EXPECT_EQ(solve(c.instance, options).error().code, ErrorCode::out_of_range);
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
