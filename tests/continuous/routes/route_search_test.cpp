// SPDX-License-Identifier: MIT
//
// The search of routes goes up in steps. What it has proved when its work ends has to be true
// wherever that is, also for plans that cost as much as a step reaches, or one tick less.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "continuous/support/roads.hpp"
#include "quadrille/continuous/solver.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using support::scaled;

constexpr Ticks kDirect = 160;

/// Agent 0 would need 160 ticks, but for agent 1, who stands in the way for ever, and can take
/// `detour`.
Instance one_in_the_way(Ticks detour) {
  const VertexId start(0), goal(1), beside(2), far(3);
  auto map =
      Roadmap::make({{0, 0}, {1'000, 0}, {500, 10}, {500, 1'000}},
                    {{start, goal, kDirect}, {start, far, Ticks{70}}, {far, goal, detour - 70}})
          .value();
  return Instance::make(
             std::make_shared<const Roadmap>(std::move(map)),
             {agent(start.index(), goal.index(), 30), agent(beside.index(), beside.index(), 30)})
      .value();
}

class RouteSearch : public testing::TestWithParam<Objective> {};

TEST_P(RouteSearch, ItsBoundHoldsWhereverItsWorkEnds) {
  int optimal = 0, unfinished = 0;
  const auto step = std::max<std::int64_t>(1, 1'000 / static_cast<std::int64_t>(scaled(50)));
  for (Ticks detour = kDirect + 1; detour <= kDirect + 24; ++detour) {
    const Instance instance = one_in_the_way(detour);
    // Other ends with each detour, where there are few of them.
    for (std::int64_t work = step - 20 * detour.value() % step; work <= 1'000; work += step) {
      SCOPED_TRACE(testing::Message() << "detour " << detour << ", work " << work);
      SolveOptions options;
      options.objective = GetParam();
      options.route_work = work;
      options.joint_work = 0;
      options.limits.conflicts = 1;
      const SolveOutcome outcome = solve(instance, options).value();
      ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
      ASSERT_LE(outcome.lower_bound, as_cost(detour));
      ++(outcome.statistics.sat_calls == 0 ? optimal : unfinished);
    }
  }
  // Both happen: the search of routes answers, and its work ends before.
  EXPECT_GT(optimal, 0);
  EXPECT_GT(unfinished, 0);
}

INSTANTIATE_TEST_SUITE_P(All, RouteSearch,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& param) {
                           return std::string(param.param == Objective::makespan ? "Makespan"
                                                                                 : "SumOfCosts");
                         });

}  // namespace
}  // namespace quadrille::continuous::test
