// SPDX-License-Identifier: MIT
// Limits: a search stops soon, and says why.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "discrete/solve/limits.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/sanitizer.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

/// On an instance that is too hard, every limit that binds is met and named.
void expect_stopped_by(StopReason reason, const Limits& limits) {
  const Instance instance = hard_instance();
  for (const TunedOptions& options : systems_for_both_objectives()) {
    SCOPED_TRACE(options_text(options));
    malloc_trim(0);  // What earlier searches have left to the process would be no growth.
    const auto [outcome, seconds] = run(instance, with_limits(options, limits));
    EXPECT_LT(seconds, kSoon + limits.wall_s.value_or(0) + limits.cpu_s.value_or(0));
    EXPECT_FALSE(is_proof(outcome.status)) << to_string(outcome.status);
    EXPECT_EQ(outcome.stop, reason) << to_string(outcome.stop);
  }
}

TEST(SolverLimits, WallTimeZero) {
  Limits limits;
  limits.wall_s = 0;
  expect_stopped_by(StopReason::wall_time, limits);
}

TEST(SolverLimits, WallTimeOneMillisecond) {
  Limits limits;
  limits.wall_s = 0.001;
  expect_stopped_by(StopReason::wall_time, limits);
}

TEST(SolverLimits, CpuTime) {
  Limits limits;
  for (const double seconds : {0.0, 0.001, 0.05}) {
    limits.cpu_s = seconds;
    expect_stopped_by(StopReason::cpu_time, limits);
  }
}

TEST(SolverLimits, Conflicts) {
  Limits limits;
  int num_stopped = 0;
  for (const std::int64_t conflicts : {0, 1, 10}) {
    limits.conflicts = conflicts;
    const Instance instance = hard_instance();
    limits.wall_s = 4;  // may end first where formulas are large or paths take long
    for (const TunedOptions& options : systems_for_both_objectives()) {
      SCOPED_TRACE(options_text(options) + std::to_string(conflicts));
      const auto [outcome, seconds] = run(instance, with_limits(options, limits));
      if (!is_proof(outcome.status) && outcome.stop != StopReason::wall_time) {
        EXPECT_EQ(outcome.stop, StopReason::conflicts);
        ++num_stopped;
      }
      EXPECT_LE(outcome.statistics.conflicts, conflicts + 100);  // looked at now and then
    }
  }
  EXPECT_GT(num_stopped, 20);
}

TEST(SolverLimits, BetterPlansAreTold) {
  const Instance instance = hard_instance();
  for (TunedOptions options : systems_for_both_objectives()) {
    if (!options.first_plan) continue;
    options.limits.conflicts = 300;
    options.plan_interval_s = 0;
    std::vector<Cost> told;
    options.on_plan = [&](const Plan& plan) {
      EXPECT_TRUE(verify(instance, plan).valid());
      told.push_back(plan.cost(options.objective));
    };
    const SolveOutcome outcome = solve(instance, options).value();
    ASSERT_FALSE(told.empty()) << options_text(options);
    EXPECT_TRUE(std::is_sorted(told.rbegin(), told.rend(), std::less_equal<>()));
    EXPECT_LE(outcome.cost, told.back());
    options.on_plan = {};
    EXPECT_EQ(solve(instance, options).value().plan, outcome.plan) << "nothing depends on it";
  }
}

TEST(SolverLimits, Memory) {
  Limits limits;
  limits.memory_mib = 1;
  expect_stopped_by(StopReason::memory, limits);
}

// A host that holds memory and burns CPU all the time runs two searches, each for as much CPU or
// memory as it may take itself. Either would end at once by what the others use.
TEST(SolverLimits, BelongToTheSolve) {
  malloc_trim(0);
  const std::vector<char> of_the_host(500 << 20, 'x');
  std::atomic<bool> done = false;
  std::thread host([&] {
    std::size_t sum = 0;
    while (!done)
      for (std::size_t i = 0; i < of_the_host.size() && !done; i += 4096)
        sum += of_the_host[i] == 'x';
    EXPECT_GT(sum, 0U);
  });
  TunedOptions small, large;
  small.limits.cpu_s = 1;
  small.limits.memory_mib = 60;
  large.system = System::mdd_sat;
  large.limits.cpu_s = 20;
  large.limits.memory_mib = 200;
  Random random(6);
  const Instance short_paths = random_grid(random, {12, 12, 0, 120, 120});
  const Instance long_paths = random_grid(random, {40, 40, 0, 700, 700});
  SolveOutcome by_cpu, by_memory;
  std::thread second([&] { by_memory = solve(long_paths, large).value(); });
  by_cpu = solve(short_paths, small).value();
  second.join();
  done = true;
  host.join();
  EXPECT_EQ(by_cpu.stop, StopReason::cpu_time) << to_string(by_cpu.stop);
  EXPECT_GE(by_cpu.statistics.cpu_s, 1);
  EXPECT_LT(by_cpu.statistics.cpu_s, 1.3);
  EXPECT_EQ(by_memory.stop, StopReason::memory) << to_string(by_memory.stop);
  EXPECT_LT(by_memory.statistics.cpu_s, 20);
}

/// A line with a passing place near its end: the agent there has to leave for long searches.
Instance long_line(std::size_t length) {
  std::vector<Graph::Edge> edges;
  for (std::size_t v = 0; v + 1 < length; ++v) edges.emplace_back(VertexId(v), VertexId(v + 1));
  edges.emplace_back(VertexId(length - 4), VertexId(length));
  edges.emplace_back(VertexId(length), VertexId(length + 1));
  edges.emplace_back(VertexId(length + 1), VertexId(length - 2));
  auto graph = std::make_shared<const Graph>(Graph::make(length + 2, edges).value());
  return Instance::make(graph, {{VertexId(0), VertexId(length - 1)},
                                {VertexId(length - 3), VertexId(length - 3)}})
      .value();
}

// Somebody passes a goal very late: no table may be as wide as the line and as high as that.
TEST(SolverLimits, LongLinesTakeTimeAndMemoryInTheirLength) {
  constexpr std::size_t kLength = 60'000;
  const Instance instance = long_line(kLength);
  TunedOptions options;
  options.objective = Objective::makespan;
  options.limits.memory_mib = quadrille::support::kAddressSanitizer ? 400 : 100;
  malloc_trim(0);
  const SolveOutcome outcome = run(instance, options).outcome;
  EXPECT_EQ(outcome.status, Status::optimal) << to_string(outcome.stop);
  EXPECT_EQ(outcome.cost, Cost{kLength - 1});
  // Measured by the whole search of this machine, which may be slow or busy.
  options.limits.cpu_s = outcome.statistics.cpu_s / 4;
  const SolveOutcome by_time = run(instance, options).outcome;
  EXPECT_EQ(by_time.stop, StopReason::cpu_time) << to_string(by_time.stop);
  EXPECT_LT(by_time.statistics.cpu_s, outcome.statistics.cpu_s * 3 / 4);
  EXPECT_EQ(by_time.lower_bound, Cost{kLength - 1});
}

TEST(SolverLimits, PortfoliosCountAllTheirThreads) {
  const Instance instance = hard_instance();
  TunedOptions options;
  options.threads = 3;
  options.race = true;
  options.limits.cpu_s = 0.6;
  const auto [outcome, seconds] = run(instance, options);
  EXPECT_EQ(outcome.stop, StopReason::cpu_time) << to_string(outcome.stop);
  EXPECT_GE(outcome.statistics.cpu_s, 0.6);
  EXPECT_LT(outcome.statistics.cpu_s, 1.2);
  EXPECT_NEAR(outcome.statistics.cpu_s, seconds, 0.2);
}

TEST(SolverLimits, InterruptBeforeTheSearch) {
  const std::atomic<bool> interrupt = true;
  Limits limits;
  limits.interrupt = &interrupt;
  expect_stopped_by(StopReason::interrupt, limits);
}

// Reading the graph for every agent alone takes far longer than the limit allows.
TEST(SolverLimits, HoldWhileTheFormulaIsBuilt) {
  Random random(5);
  const Instance instance = random_grid(random, {400, 400, 0, 400, 400});
  Limits limits;
  for (const double seconds : {0.0, 0.1}) {
    limits.wall_s = seconds;
    for (const TunedOptions& options : systems_for_both_objectives()) {
      const auto [outcome, taken] = run(instance, with_limits(options, limits));
      ASSERT_LT(taken, kSoon + seconds) << options_text(options);
      EXPECT_EQ(outcome.stop, StopReason::wall_time) << options_text(options);
    }
  }
}

TEST(SolverLimits, GenerousLimitsChangeNothing) {
  Limits limits;
  limits.wall_s = limits.cpu_s = 1000;
  limits.memory_mib = 100'000;
  limits.conflicts = 1'000'000'000;
  const std::atomic<bool> interrupt = false;
  limits.interrupt = &interrupt;
  Random random(4);
  const Instance instance = random_grid(random, {4, 5, 10, 3, 3});
  for (const TunedOptions& options : systems_for_both_objectives()) {
    const JointAnswer expected = joint_search(instance, options.objective);
    const auto outcome = run(instance, with_limits(options, limits)).outcome;
    EXPECT_EQ(find_fault(instance, options, outcome, expected), "");
  }
}

// The same instance, options and seed give the same plan and the same counters.
TEST(SolverLimits, SearchesRepeatThemselves) {
  for (std::uint64_t seed = 0; seed < scaled(20); ++seed) {
    Random random(600'000 + seed);
    const Instance instance = random_grid(random, {4, 7, 25, 4, 7});
    for (const TunedOptions& options : random_systems(random, Objective::sum_of_costs)) {
      TunedOptions same = options;
      same.debug.known_plan.reset();
      same.initial_plan.reset();
      same.race = false;
      const SolveOutcome first = solve(instance, same).value(),
                         second = solve(instance, same).value();
      ASSERT_EQ(first.plan, second.plan) << instance_text(instance) << options_text(same);
      EXPECT_EQ(first.statistics.conflicts, second.statistics.conflicts);
      EXPECT_EQ(first.statistics.decisions, second.statistics.decisions);
      EXPECT_EQ(first.statistics.clauses, second.statistics.clauses);
      EXPECT_EQ(first.statistics.checks, second.statistics.checks);
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
