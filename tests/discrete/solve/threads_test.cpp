// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "quadrille/discrete/primal.hpp"
#include "quadrille/discrete/verify.hpp"
#include "solve/desk.hpp"
#include "solve/search.hpp"
#include "solve/tuning.hpp"
#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"
#include "support/solver_cases.hpp"
#include "support/tuned_options.hpp"

namespace quadrille::discrete {
namespace {

using quadrille::support::scaled;
using support::instance_text;
using support::Random;
using support::TunedOptions;

/// An empty grid with random tasks.
Instance crowd(std::int32_t side, std::size_t num_agents, std::uint64_t seed) {
  const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  Random random(seed);
  return support::random_tasks(random, Graph::grid(side, side, std::vector<bool>(cells, true)),
                               num_agents);
}

TEST(Threads, FiveRunsGiveTheSameAnswer) {
  const Instance instance = crowd(14, 75, 4);
  for (const std::size_t threads : {2U, 3U}) {
    TunedOptions options;
    options.threads = threads;
    options.round = 20'000;
    options.limits.conflicts = 600;
    std::optional<SolveOutcome> first;
    for (int run = 0; run < 5; ++run) {
      SolveOutcome outcome = support::solve(instance, options).value();
      ASSERT_TRUE(outcome.plan);
      ASSERT_TRUE(verify(instance, *outcome.plan).valid());
      if (!first) {
        EXPECT_GT(*outcome.cost, outcome.lower_bound) << "too easy";
        first = std::move(outcome);
        continue;
      }
      EXPECT_EQ(outcome.status, first->status);
      EXPECT_EQ(outcome.stop, first->stop);
      EXPECT_EQ(outcome.cost, first->cost);
      EXPECT_EQ(outcome.lower_bound, first->lower_bound);
      EXPECT_EQ(*outcome.plan, *first->plan);
      EXPECT_EQ(outcome.statistics.conflicts, first->statistics.conflicts);
      EXPECT_EQ(outcome.statistics.cores, first->statistics.cores);
    }
  }
}

TEST(Threads, TheGapIsThatOfAllTogether) {
  const Instance instance = crowd(14, 75, 4);
  for (const bool race : {false, true}) {
    TunedOptions options;
    options.threads = 2;
    options.race = race;
    options.round = 5000;
    options.gap_percent = 20;
    const SolveOutcome outcome = support::solve(instance, options).value();
    EXPECT_EQ(outcome.status, Status::feasible);
    EXPECT_EQ(outcome.stop, StopReason::gap);
    EXPECT_TRUE(is_within_gap(options.gap_percent, *outcome.cost, outcome.lower_bound));
  }
}

/// Others who know a plan and a bound after some time.
class Prompter final : public solve::Exchange<Message> {
 public:
  Prompter(Role role, int silence, Message message)
      : role_(role), silence_(silence), message_(std::move(message)) {}
  bool has_others() const override { return true; }
  Role role() const override { return role_; }
  std::optional<Message> arrive(Effort, const std::function<Message()>& tell) override {
    const Message told = tell();
    lower_ = std::max(lower_, told.lower);
    if (++num_calls_ < silence_) return Message();
    return message_;
  }
  [[nodiscard]] Cost lower() const { return lower_; }

 private:
  const Role role_;
  const int silence_;
  const Message message_;
  int num_calls_ = 0;
  Cost lower_ = 0;
};

struct Found {
  Knowledge known;
  solve::Settlement settled;
};

Found search_beside(Prompter& prompter, const Instance& instance, const SolveOptions& options) {
  Found found;
  ProofDraft proof;
  LimitMonitor limits(options.limits);
  solve::Pulse<Plan> pulse(options, limits, found.known, true);
  solve::run_guarded(found.known, limits, [&] {
    search(
        instance, options, tuner_for(instance)(options), {limits, found.known, pulse, prompter},
        [&](LimitMonitor& own) { return GoalDistances::make(instance, own); }, proof);
  });
  found.settled = settle(found.known, options.gap_percent);
  return found;
}

// A plan or a bound that comes from elsewhere, at any moment, never makes the answer worse.
TEST(Threads, WhatIsHeardNeverWorsensTheAnswer) {
  Random random(5);
  std::size_t num_heard = 0;
  for (std::size_t round = 0; round < scaled(600); ++round) {
    const Instance instance = support::random_grid(random, {2, 4, 25, 2, 4});
    for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
      const auto truth = support::joint_search(instance, objective);
      if (truth.status != Status::optimal) continue;
      LimitMonitor limits{Limits{}};
      Message message;
      if (random.percent(70)) {
        const auto plan = find_plan(instance, limits, static_cast<std::uint32_t>(round));
        ASSERT_TRUE(plan);
        message.cost = plan->cost(objective);
        message.plan = std::make_shared<const Plan>(*plan);
        if (random.percent(50)) message.extra.paths = message.plan;
      }
      if (random.percent(50)) message.lower = truth.cost - static_cast<Cost>(random.below(2));
      message.others_ended = true;
      SolveOptions options;
      options.objective = objective;
      const Role role = random.percent(30)   ? Role::plans
                        : random.percent(50) ? Role::bound
                                             : Role::all;
      Prompter prompter(role, static_cast<int>(random.below(6)), message);
      const Found found = search_beside(prompter, instance, options);
      ASSERT_FALSE(found.settled.error) << instance_text(instance);
      EXPECT_LE(prompter.lower(), truth.cost) << instance_text(instance);
      EXPECT_LE(found.known.lower(), truth.cost) << instance_text(instance);
      ASSERT_TRUE(found.known.plan) << instance_text(instance);
      ASSERT_TRUE(verify(instance, *found.known.plan).valid());
      if (found.settled.status == Status::optimal) {
        EXPECT_EQ(found.known.cost, truth.cost);
      }
      if (role == Role::plans) continue;
      ++num_heard;
      EXPECT_EQ(found.settled.status, Status::optimal) << instance_text(instance);
      EXPECT_EQ(found.known.cost, truth.cost) << instance_text(instance);
    }
  }
  EXPECT_GE(num_heard, scaled(300));
}

// Who looks for plans knows itself when its plan is good enough, and does not wait for the others.
TEST(Threads, WhoMakesPlansEndsAtTheGap) {
  const Instance instance = crowd(14, 75, 4);
  Message message;
  for (const AgentId i : instance.agent_ids())
    message.lower +=
        distances_from(instance.graph(), instance.agents()[i].goal())[instance.agents()[i].start];
  Prompter prompter(Role::plans, 0, message);
  SolveOptions options;
  options.gap_percent = 20;
  options.limits.looks = 1'000'000;
  const Found found = search_beside(prompter, instance, options);
  EXPECT_EQ(found.settled.stop, StopReason::gap);
  ASSERT_TRUE(found.known.plan);
  EXPECT_TRUE(is_proof(found.known, options.gap_percent));
  EXPECT_TRUE(is_within_gap(options.gap_percent, *found.known.cost, found.known.lower()));
}

TEST(Threads, ABoundAboveAPlanIsAnInternalError) {
  const Instance instance = crowd(6, 5, 1);
  Message message;
  message.lower = 100'000;
  for (const Role role : {Role::plans, Role::all}) {
    message.others_ended = true;
    Prompter prompter(role, 0, message);
    const solve::Settlement settled = search_beside(prompter, instance, {}).settled;
    if (role == Role::all && !settled.error) {
      // It was over before it heard of it.
      EXPECT_EQ(settled.status, Status::optimal);
      continue;
    }
    EXPECT_TRUE(settled.error);
  }
}

}  // namespace
}  // namespace quadrille::discrete
