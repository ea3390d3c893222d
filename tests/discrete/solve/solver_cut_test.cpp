// SPDX-License-Identifier: MIT
// Wherever a search is cut off, by a limit or by an interrupt, nothing is claimed that is not
// proved.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "discrete/solve/limits.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

/// What the agents cost when each is alone.
Cost alone(const Instance& instance, Objective objective) {
  Cost sum = 0, most = 0;
  for (const Agent& agent : instance.agents()) {
    const Cost cost = distances_from(instance.graph(), agent.goal())[agent.start];
    sum += cost;
    most = std::max(most, cost);
  }
  return objective == Objective::sum_of_costs ? sum : most;
}

// Every look at the limits is the last one once: those deep inside the theory, which leave by an
// exception, too.
TEST(SolverCut, AtAnyLookNothingFalseIsClaimed) {
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
          ASSERT_GE(outcome.lower_bound, alone(instance, objective));
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

// Whatever ends a search before it begins: how far the goals are is known.
TEST(SolverCut, TheFreeBoundIsNeverLost) {
  Random random(8);
  const Instance instance = random_grid(random, {14, 14, 15, 30, 30});
  const std::atomic<bool> interrupt = true;
  std::vector<Limits> all(5);
  all[0].wall_s = 0;
  all[1].cpu_s = 0;
  all[2].conflicts = 0;
  all[3].memory_mib = 0;
  all[4].interrupt = &interrupt;
  for (const Objective objective : {Objective::sum_of_costs, Objective::makespan})
    for (TunedOptions options : all_systems(objective))
      for (const Limits& limits : all)
        for (const std::size_t threads : {std::size_t{1}, std::size_t{3}}) {
          options.limits = limits;
          options.threads = threads;
          const SolveOutcome outcome = run(instance, options).outcome;
          EXPECT_GE(outcome.lower_bound, alone(instance, objective)) << options_text(options);
        }
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

TEST(SolverCut, AtRandomMoments) {
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
TEST(SolverCut, ThousandAgentsAtRandomMoments) {
  Random random(12);
  const Instance instance = random_grid(random, {100, 100, 20, 1000, 1000});
  Cost free_costs = 0;
  for (const AgentId i : instance.agent_ids())
    free_costs +=
        distances_from(instance.graph(), instance.agents()[i].goal())[instance.agents()[i].start];
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
TEST(SolverCut, NeverClaimsWhatIsNotTrue) {
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

}  // namespace
}  // namespace quadrille::discrete::support
