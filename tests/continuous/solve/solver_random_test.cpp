// SPDX-License-Identifier: MIT
// Random instances against the oracle, others for each objective and system.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>

#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

class SolverRandom : public testing::TestWithParam<Asked> {};

TEST_P(SolverRandom, AgreesWithTheOracle) {
  const auto [objective, system] = GetParam();
  const auto count = static_cast<std::uint32_t>(support::scaled(500));
  const std::uint32_t part = 2 * static_cast<std::uint32_t>(objective == Objective::makespan) +
                             static_cast<std::uint32_t>(system == System::smt_cbs);
  const std::uint32_t first = part * 1'000'000;
  constexpr std::size_t max_moves = 4;
  Tally tally;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    RandomOptions random;
    random.num_agents = 2 + seed % 2;
    random.num_vertices = 4 + seed / 2 % 4;
    random.edge_percent = 30 + static_cast<int>(seed / 8 % 3) * 15;
    random.space_percent = 40;
    random.polygon_percent = 30;
    const Instance instance = random_instance(seed, random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const OrderSearch oracle = search_orders(instance, objective, max_moves);
    if (oracle.best) {
      ASSERT_TRUE(verify(instance, oracle.best_plan).valid());
    }
    SolveOptions options;
    options.objective = objective;
    options.system = system;
    options.limits.conflicts = 3000;
    // Without the joint search. Half of them without the search of routes, the others with little
    // of it or as much as usual.
    options.joint_work = 0;
    const std::int64_t route_work[] = {0, 1000, 0, SolveOptions().route_work};
    options.route_work = route_work[seed / 24 % 4];
    // The latter may have no plan, and no conflicts either.
    options.limits.cpu_s = oracle.best ? 2 : 0.1;
    options.debug.audit = true;
    // Half of them without: the known plan spares plans that cost more than the incumbent, whose
    // cores are weaker than those that solves without one learn.
    if (!oracle.some_plans.empty() && seed % 2 == 0)
      options.debug.known_plan = oracle.some_plans[seed % oracle.some_plans.size()];
    if (!oracle.some_plans.empty() && seed % 5 == 0)
      options.initial_plan = oracle.some_plans[seed / 5 % oracle.some_plans.size()];
    check_against(oracle, max_moves, instance, options, tally);
    if (HasFatalFailure()) return;
  }
  record(tally);
  if (count < 250) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(2 * tally.solvable, static_cast<int>(count));
  EXPECT_GE(10 * tally.optimal, 8 * tally.solvable);
}

INSTANTIATE_TEST_SUITE_P(All, SolverRandom, all_asked(), name_of);

/// On instances that are too large for the oracle, half of them in space, the others with polygons.
class SystemsAgree : public testing::TestWithParam<Objective> {};

TEST_P(SystemsAgree, WithPolygonsAndInSpace) {
  const auto count = static_cast<int>(support::scaled(500));
  int in_space = 0, optimal = 0;
  for (int seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomInstanceOptions random;
    random.num_vertices = 14 + static_cast<std::size_t>(seed) % 7;
    random.num_agents = 2 + static_cast<std::size_t>(seed) / 2 % 3;
    random.width = random.height = 8'000'000;
    random.radius = 300'000;
    random.mixed = true;
    if (seed % 2 == 0) random.altitude = 3'000'000;
    const Instance instance = random_instance(random, static_cast<std::uint64_t>(seed)).value();
    const auto answer = [&](System system) {
      SolveOptions options;
      options.objective = GetParam();
      options.system = system;
      options.limits.conflicts = 2000;
      options.limits.looks = 3000;  // Some are hard.
      SolveOutcome outcome = solve(instance, options).value();
      EXPECT_FALSE(outcome.internal_error) << outcome.internal_error->to_string();
      EXPECT_TRUE(!outcome.plan || verify(instance, *outcome.plan).valid());
      return outcome;
    };
    const SolveOutcome inside = answer(System::dpll), after = answer(System::smt_cbs);
    for (const auto& [a, b] : {std::pair(&inside, &after), std::pair(&after, &inside)}) {
      EXPECT_TRUE(!a->plan || b->status != Status::infeasible);
      EXPECT_TRUE(!a->cost || b->lower_bound <= *a->cost);
    }
    const auto is_proof = [](const SolveOutcome& outcome) {
      return outcome.status == Status::optimal || outcome.status == Status::infeasible;
    };
    in_space += instance.is_flat() ? 0 : 1;
    if (!is_proof(inside) || !is_proof(after)) continue;
    optimal += inside.plan ? 1 : 0;
    ASSERT_EQ(inside.status, after.status);
    ASSERT_EQ(inside.cost, after.cost);
  }
  RecordProperty("optimal", optimal);
  EXPECT_GE(2 * in_space, count);
  EXPECT_GE(2 * optimal, count);
}

INSTANTIATE_TEST_SUITE_P(All, SystemsAgree,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const testing::TestParamInfo<Objective>& param) {
                           return std::string(param.param == Objective::makespan ? "Makespan"
                                                                                 : "SumOfCosts");
                         });

}  // namespace
}  // namespace quadrille::continuous::test
