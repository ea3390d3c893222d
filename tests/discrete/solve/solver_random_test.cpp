// SPDX-License-Identifier: MIT
// Random instances with random options: all systems against the joint search, or against each other
// where that is too slow.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::only_system;
using quadrille::support::scaled;

Objective random_objective(Random& random) {
  return random.percent(60) ? Objective::sum_of_costs : Objective::makespan;
}

/// What all systems have to answer: the oracle's word, or else the first system's.
JointAnswer expected_answer(const Instance& instance, Objective objective) {
  const JointAnswer answer = joint_search(instance, objective);
  if (answer.status != Status::unknown) return answer;
  const SolveOutcome outcome = solve(instance, all_systems(objective).back()).value();
  return {outcome.status, outcome.cost.value_or(0), outcome.plan.value_or(Plan())};
}

struct Count {
  int solved = 0, infeasible = 0, oracle = 0;
};

void compare_systems(const Instance& instance, Random& random, const std::string& origin,
                     Count& count) {
  const Objective objective = random_objective(random);
  const JointAnswer expected = expected_answer(instance, objective);
  ASSERT_NE(expected.status, Status::unknown) << origin << "\n";
  count.infeasible += expected.status == Status::infeasible ? 1 : 0;
  for (const TunedOptions& options : random_systems(random, objective)) {
    if (!only_system().empty() && to_string(options.system) != only_system()) continue;
    const std::string fault = solve_and_compare(instance, options, expected, origin);
    ASSERT_EQ(fault, "") << fault;
    ++count.solved;
  }
}

/// Draws `scaled(cases)` instances, each from a seed of its own, and compares all systems on them.
template <class Draw>
void run_shard(const char* name, int shard, std::size_t cases, const Draw& draw) {
  Count count;
  for (std::size_t number = 0; number < scaled(cases); ++number) {
    const std::uint64_t seed = static_cast<std::uint64_t>(shard) * 1'000'000 + number;
    Random random(seed);
    const Instance instance = draw(random);
    compare_systems(instance, random, name + (" seed " + std::to_string(seed)), count);
    if (testing::Test::HasFailure()) return;
  }
  if (!only_system().empty()) {
    ASSERT_GT(count.solved, 0) << "no system has the name " << only_system();
  }
  testing::Test::RecordProperty("solved", count.solved);
  testing::Test::RecordProperty("infeasible", count.infeasible);
}

class SolverRandom : public testing::TestWithParam<int> {};

TEST_P(SolverRandom, SmallGrids) {
  run_shard("small grid", GetParam(), 600, [](Random& random) {
    GridShape shape;
    // The joint search slows down with the agents: many of them on few cells only.
    shape.max_agents = random.percent(50) ? 2 : 3;
    if (random.percent(25)) shape = {1, 3, 30, 4, 4};
    return random_grid(random, shape);
  });
}

// Many agents on few cells: long detours, rotations, and feasibility that depends on cycles.
TEST_P(SolverRandom, CrowdedBoards) {
  run_shard("crowded board", 100 + GetParam(), 60, [](Random& random) {
    return random_grid(random, {2, 3, 15, 4, 5});
  });
}

TEST_P(SolverRandom, SmallGraphs) {
  run_shard("small graph", 200 + GetParam(), 170,
            [](Random& random) { return random_graph(random, 9, 4); });
}

// Too large for the joint search: the systems are compared with mdd-sat.
TEST_P(SolverRandom, LargerGrids) {
  run_shard("larger grid", 300 + GetParam(), 10, [](Random& random) {
    return random_grid(random, {5, 8, 25, 5, 9});
  });
}

INSTANTIATE_TEST_SUITE_P(Shard, SolverRandom, testing::Range(0, 12));

}  // namespace
}  // namespace quadrille::discrete::support
