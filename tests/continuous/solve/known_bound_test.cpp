// SPDX-License-Identifier: MIT
// Lower bounds that the user knows: what rests on them says so, and a wrong one is refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/free_bound.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

struct Case {
  Instance instance;
  SolveOptions options;
  Cost truth = 0;
};

/// Solved by each of the searches there are. No limit on time: what is drawn must not depend on it.
std::vector<Case> cases(std::size_t count) {
  std::vector<Case> found;
  for (std::uint32_t seed = 1; found.size() < count && seed < 600; ++seed) {
    RandomOptions random;
    random.num_vertices = 8 + seed % 7;
    random.num_agents = 3 + seed % 2;
    random.size = 90;
    random.edge_percent = 30;
    const Instance instance = random_instance(seed, random);
    SolveOptions options;
    options.objective = seed % 2 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.system = seed % 3 == 0 ? System::smt_cbs : System::dpll;
    options.threads = 1 + seed % 2;
    if (seed % 5 != 0) options.joint_work = options.route_work = 0;
    options.limits.conflicts = 300;
    const SolveOutcome truth = solve(instance, options).value();
    if (truth.status == Status::optimal) found.push_back({instance, options, *truth.cost});
  }
  return found;
}

TEST(KnownBound, TrueOnesChangeNoAnswer) {
  int num_resting = 0, num_raised = 0;
  for (const Case& c : cases(support::scaled(20))) {
    SCOPED_TRACE(describe(c.instance));
    for (const Cost less : {0, 1, 5, 40}) {
      SolveOptions options = c.options;
      options.known_lower_bound = std::max<Cost>(c.truth - less, 0);
      // A search that begins elsewhere may take much longer.
      options.limits.conflicts = 30'000;
      const SolveOutcome outcome = solve(c.instance, options).value();
      ASSERT_EQ(outcome.status, Status::optimal);
      ASSERT_EQ(outcome.cost, c.truth);
      ASSERT_EQ(outcome.lower_bound, c.truth);
      if (outcome.rests_on_known_bound) {
        ASSERT_EQ(*options.known_lower_bound, c.truth);
        ++num_resting;
      } else if (less > 0) {
        ++num_raised;
      }
    }
  }
  EXPECT_GT(num_resting, 0);
  EXPECT_GT(num_raised, 0);
}

TEST(KnownBound, WrongOnesAreRefusedWhenAPlanSaysSo) {
  int num_refused = 0, num_believed = 0;
  for (const Case& c : cases(support::scaled(20))) {
    SCOPED_TRACE(describe(c.instance));
    for (const Cost more : {1, 20, 1000}) {
      SolveOptions options = c.options;
      options.known_lower_bound = c.truth + more;
      const auto outcome = solve(c.instance, options);
      if (!outcome) {
        ++num_refused;
        ASSERT_EQ(outcome.error().code, ErrorCode::out_of_range);
        ASSERT_EQ(outcome.error().message.find("the known lower bound is wrong: it is " +
                                               std::to_string(c.truth + more)),
                  0U)
            << outcome.error().message;
        continue;
      }
      ++num_believed;
      ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message;
      ASSERT_EQ(outcome->lower_bound, c.truth + more);
      ASSERT_TRUE(outcome->rests_on_known_bound);
      if (outcome->cost) {
        ASSERT_GE(*outcome->cost, c.truth + more);
      }
    }
  }
  EXPECT_GT(num_refused, num_believed);
}

TEST(KnownBound, WithoutASearchItIsTheBound) {
  int num_resting = 0;
  for (const Case& c : cases(6)) {
    SolveOptions options = c.options;
    options.known_lower_bound = c.truth;
    options.limits = {};
    options.limits.wall_s = 0;
    const SolveOutcome outcome = solve(c.instance, options).value();
    EXPECT_EQ(outcome.status, Status::unknown);
    EXPECT_EQ(outcome.lower_bound, c.truth);
    // What the agents cost alone is known without a search, too.
    const Cost alone = free_bound(c.instance.agent_ids(), options.objective, [&](AgentId i) {
      return as_cost(free_cost(c.instance, i).value());
    });
    EXPECT_EQ(outcome.rests_on_known_bound, alone < c.truth);
    if (outcome.rests_on_known_bound) ++num_resting;
  }
  EXPECT_GE(num_resting, 2);
}

TEST(KnownBound, APlanOfThatCostIsAllThatIsNeeded) {
  int num_resting = 0;
  for (Case& c : cases(12)) {
    SolveOptions options = c.options;
    options.initial_plan = solve(c.instance, options).value().plan;
    options.known_lower_bound = c.truth;
    options.limits.conflicts = 0;
    const SolveOutcome outcome = solve(c.instance, options).value();
    EXPECT_EQ(outcome.status, Status::optimal);
    EXPECT_EQ(outcome.statistics.sat_calls, 0);
    if (outcome.rests_on_known_bound) ++num_resting;
    options.known_lower_bound = c.truth + 1;
    const auto refused = solve(c.instance, options);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
  }
  EXPECT_GT(num_resting, 0);
}

TEST(KnownBound, NegativeOnesAreRefusedAndInfeasibilityRestsOnNone) {
  RandomOptions random;
  SolveOptions options;
  options.known_lower_bound = -1;
  EXPECT_EQ(solve(random_instance(1, random), options).error().code, ErrorCode::out_of_range);
  // Two on a line that have to change places.
  const Instance stuck = Instance::make(roadmap({{0, 0}, {1000, 0}, {2000, 0}}, {{0, 1}, {1, 2}}),
                                        {agent(0, 2, 100), agent(2, 0, 100)})
                             .value();
  options.known_lower_bound = 1'000'000;
  const SolveOutcome outcome = solve(stuck, options).value();
  EXPECT_EQ(outcome.status, Status::infeasible);
  EXPECT_FALSE(outcome.rests_on_known_bound);
}

}  // namespace
}  // namespace quadrille::continuous::test
