// SPDX-License-Identifier: MIT
// Limits and interrupts: a search stops soon, says why, and never claims what it has not proved.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "quadrille/discrete/verify.hpp"
#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/sanitizer.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;
using namespace std::chrono_literals;

/// Within this time a search has to return after its limit was met. Counted in CPU time: what the
/// clock says depends on what else the machine does.
constexpr double kSoon = 2.0;

/// Every agent on a walk across a room: much too hard to finish within the limits below.
Instance hard_instance() {
  Random random(2);
  return random_grid(random, {20, 20, 0, 360, 360});
}

TunedOptions with_limits(TunedOptions options, const Limits& limits) {
  options.limits = limits;
  return options;
}

std::vector<TunedOptions> systems_for_both_objectives() {
  std::vector<TunedOptions> systems = all_systems(Objective::sum_of_costs);
  const std::vector<TunedOptions> more = all_systems(Objective::makespan);
  systems.insert(systems.end(), more.begin(), more.end());
  // The first plan of the hard instance has the least makespan, which would be the end.
  for (TunedOptions& options : systems)
    if (options.objective == Objective::makespan) options.first_plan = false;
  return systems;
}

struct Stopped {
  SolveOutcome outcome;
  double cpu_s = 0;
};

Stopped run(const Instance& instance, const TunedOptions& options) {
  const double begin = cpu_seconds();
  SolveOutcome outcome = solve(instance, options).value();
  EXPECT_EQ(find_inconsistency(instance, options, outcome), "")
      << instance_text(instance) << options_text(options);
  return {std::move(outcome), cpu_seconds() - begin};
}

bool is_proof(Status status) { return status == Status::optimal || status == Status::infeasible; }

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

// Every look at the limits is the last one once: those deep inside the theory, which leave by an
// exception, too.
TEST(SolverLimits, CutAtAnyLookNothingFalseIsClaimed) {
  constexpr std::int64_t kLooks = 200;
  const std::int64_t stride = kLooks / static_cast<std::int64_t>(scaled(kLooks));
  Random random(7);
  const Instance instance = random_grid(random, {14, 14, 15, 30, 30});
  int num_cut = 0, num_bounded = 0;
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
    TunedOptions uncut;
    uncut.objective = objective;
    const SolveOutcome truth = run(instance, uncut).outcome;
    ASSERT_EQ(truth.status, Status::optimal);
    for (TunedOptions options : all_systems(objective))
      for (const bool first_plan : {false, true})
        for (std::int64_t looks = 1; looks <= kLooks; looks += stride) {
          options.first_plan = first_plan;
          options.limits.looks = looks;
          SCOPED_TRACE(options_text(options) + " looks " + std::to_string(looks));
          const SolveOutcome outcome = run(instance, options).outcome;
          ASSERT_GE(outcome.lower_bound, 0);
          ASSERT_LE(outcome.lower_bound, *truth.cost);
          ASSERT_NE(outcome.status, Status::infeasible);
          if (outcome.cost) {
            ASSERT_GE(*outcome.cost, *truth.cost);
          }
          if (outcome.status == Status::optimal) {
            ASSERT_EQ(*outcome.cost, *truth.cost);
            continue;
          }
          ASSERT_EQ(outcome.stop, StopReason::interrupt) << to_string(outcome.stop);
          ++num_cut;
          if (outcome.lower_bound == *truth.cost) ++num_bounded;
        }
  }
  EXPECT_GT(num_cut, kLooks / stride);
  EXPECT_GT(num_bounded, 0);
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

struct Interrupted {
  SolveOutcome outcome;
  double late_s = 0;  // CPU time from the interrupt to the answer.
};

Interrupted solve_interrupted(const Instance& instance, TunedOptions options, double delay_s) {
  std::atomic<bool> interrupt = false;
  options.limits.interrupt = &interrupt;
  std::atomic<double> set_at = 0;
  std::thread killer([&] {
    std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
    set_at = cpu_seconds();
    interrupt = true;
  });
  SolveOutcome outcome = solve(instance, options).value();
  const double returned = cpu_seconds();
  killer.join();
  EXPECT_EQ(find_inconsistency(instance, options, outcome), "");
  EXPECT_EQ(outcome.stop, StopReason::interrupt);
  return {std::move(outcome), returned - set_at};
}

TEST(SolverLimits, InterruptAtRandomMoments) {
  const Instance instance = hard_instance();
  Random random(3);
  const auto systems = systems_for_both_objectives();
  for (std::size_t round = 0; round < scaled(2 * systems.size()); ++round) {
    const TunedOptions& options = systems[round % systems.size()];
    SCOPED_TRACE(options_text(options));
    const double delay = static_cast<double>(random.below(400)) / 1000;
    const auto [outcome, late_s] = solve_interrupted(instance, options, delay);
    EXPECT_FALSE(is_proof(outcome.status)) << to_string(outcome.status);
    EXPECT_LT(late_s, kSoon);
  }
}

/// Limits that may end a search anywhere.
Limits random_limits(Random& random) {
  Limits limits;
  if (random.percent(30)) limits.wall_s = static_cast<double>(random.below(20)) / 10'000;
  if (random.percent(20)) limits.cpu_s = static_cast<double>(random.below(20)) / 10'000;
  if (random.percent(60)) limits.conflicts = static_cast<std::int64_t>(random.below(30));
  if (random.percent(5)) limits.memory_mib = 1;
  return limits;
}

// From the first look at the distances on, through guides, first plans, drafts and cores.
TEST(SolverLimits, ThousandAgentsAreInterruptedAtRandomMoments) {
  Random random(12);
  const Instance instance = random_grid(random, {100, 100, 20, 1000, 1000});
  Cost free_costs = 0;
  for (const AgentId i : instance.agent_ids())
    free_costs +=
        distances_from(instance.graph(), instance.agents()[i].goal)[instance.agents()[i].start];
  int num_with_plan = 0;
  // Later and later if the machine is too busy for a plan.
  const auto is_enough = [&](std::size_t round) {
    return round >= scaled(8) && (num_with_plan > 0 || round >= 10 * scaled(8));
  };
  for (std::size_t round = 0; !is_enough(round); ++round) {
    TunedOptions options;
    options.threads = 1 + round % 2;
    const double delay = static_cast<double>(random.below(2'500)) / 1000 *
                         static_cast<double>(1 + round / scaled(8));
    SCOPED_TRACE(delay);
    const auto [outcome, late_s] = solve_interrupted(instance, options, delay);
    EXPECT_LT(late_s, kSoon);
    EXPECT_GT(outcome.lower_bound, 0);
    if (!outcome.plan) continue;
    ++num_with_plan;
    EXPECT_TRUE(verify(instance, *outcome.plan).valid());
    EXPECT_GE(outcome.lower_bound, free_costs);
  }
  EXPECT_GT(num_with_plan, 0);
}

// Whatever ends the search: a bound above the optimum, a plan that is none, or a false claim of
// infeasibility would show here.
TEST(SolverLimits, NeverClaimsWhatIsNotTrue) {
  int stopped = 0, finished = 0;
  for (std::uint64_t seed = 0; seed < scaled(400); ++seed) {
    Random random(500'000 + seed);
    const Instance instance = random_grid(random, {2, 5, 40, 2, 3});
    const Objective objective = random.percent(50) ? Objective::sum_of_costs : Objective::makespan;
    const JointAnswer truth = joint_search(instance, objective);
    for (TunedOptions options : random_systems(random, objective)) {
      options.debug.known_plan.reset();
      options.initial_plan.reset();
      options.limits = random_limits(random);
      SCOPED_TRACE("seed " + std::to_string(500'000 + seed) + "\n" + instance_text(instance) +
                   options_text(options));
      const SolveOutcome outcome = run(instance, options).outcome;
      (outcome.stop == StopReason::none ? finished : stopped)++;
      if (outcome.status == Status::infeasible) {
        ASSERT_EQ(truth.status, Status::infeasible);
      }
      if (outcome.plan) {
        ASSERT_EQ(truth.status, Status::optimal);
      }
      if (outcome.status == Status::optimal) {
        ASSERT_EQ(outcome.cost, truth.cost);
      }
      if (outcome.plan) {
        ASSERT_GE(*outcome.cost, truth.cost);
      }
      if (truth.status == Status::optimal) {
        ASSERT_LE(outcome.lower_bound, truth.cost);
      }
      if (outcome.stop == StopReason::none) {
        ASSERT_EQ(outcome.status, truth.status);
      }
    }
  }
  EXPECT_GT(stopped, 0);
  EXPECT_GT(finished, 0);
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
