// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "quadrille/core/portfolio.hpp"
#include "quadrille/discrete/primal.hpp"
#include "quadrille/discrete/verify.hpp"
#include "solve/portfolio.hpp"
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
class Prompter final : public Companion {
 public:
  Prompter(Role role, int silence, News news)
      : role_(role), silence_(silence), news_(std::move(news)) {}
  Role role() const override { return role_; }
  std::optional<News> on_effort(std::int64_t, const std::function<News()>& tell) override {
    const News told = tell();
    lower_ = std::max(lower_, told.lower);
    if (++num_calls_ < silence_) return News();
    return news_;
  }
  const std::atomic<bool>& cancelled() const override { return cancelled_; }
  std::shared_ptr<ResourceAccount> account() const override { return account_; }
  std::shared_ptr<const GoalDistances> distances(LimitMonitor& limits) override {
    return GoalDistances::make(*instance, limits);
  }
  [[nodiscard]] Cost lower() const { return lower_; }

  const Instance* instance = nullptr;

 private:
  const Role role_;
  const int silence_;
  const News news_;
  int num_calls_ = 0;
  Cost lower_ = 0;
  const std::atomic<bool> cancelled_ = false;
  const std::shared_ptr<ResourceAccount> account_ = std::make_shared<ResourceAccount>();
};

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
      News news;
      if (random.percent(70)) {
        const auto plan = find_plan(instance, limits, static_cast<std::uint32_t>(round));
        ASSERT_TRUE(plan);
        news.cost = plan->cost(objective);
        news.plan = std::make_shared<const Plan>(*plan);
        if (random.percent(50)) news.draft = news.plan;
      }
      if (random.percent(50)) news.lower = truth.cost - static_cast<Cost>(random.below(2));
      news.others_ended = true;
      SolveOptions options;
      options.objective = objective;
      const Role role = random.percent(30)   ? Role::plans
                        : random.percent(50) ? Role::bound
                                             : Role::both;
      Prompter prompter(role, static_cast<int>(random.below(6)), news);
      prompter.instance = &instance;
      const SolveOutcome outcome = solve_alone(instance, options, tuner_for(instance), &prompter);
      ASSERT_FALSE(outcome.internal_error) << instance_text(instance);
      EXPECT_LE(prompter.lower(), truth.cost) << instance_text(instance);
      EXPECT_LE(outcome.lower_bound, truth.cost) << instance_text(instance);
      ASSERT_TRUE(outcome.plan) << instance_text(instance);
      ASSERT_TRUE(verify(instance, *outcome.plan).valid());
      if (outcome.status == Status::optimal) {
        EXPECT_EQ(outcome.cost, truth.cost);
      }
      if (role == Role::plans) continue;
      ++num_heard;
      EXPECT_EQ(outcome.status, Status::optimal) << instance_text(instance);
      EXPECT_EQ(outcome.cost, truth.cost) << instance_text(instance);
    }
  }
  EXPECT_GE(num_heard, scaled(300));
}

// Who looks for plans knows itself when its plan is good enough, and does not wait for the others.
TEST(Threads, WhoMakesPlansEndsAtTheGap) {
  const Instance instance = crowd(14, 75, 4);
  News news;
  for (const AgentId i : instance.agent_ids())
    news.lower +=
        distances_from(instance.graph(), instance.agents()[i].goal)[instance.agents()[i].start];
  Prompter prompter(Role::plans, 0, news);
  prompter.instance = &instance;
  SolveOptions options;
  options.gap_percent = 20;
  options.limits.looks = 1'000'000;
  const SolveOutcome outcome = solve_alone(instance, options, tuner_for(instance), &prompter);
  EXPECT_EQ(outcome.stop, StopReason::gap);
  ASSERT_TRUE(outcome.plan);
  EXPECT_TRUE(is_proof(outcome));
  EXPECT_TRUE(is_within_gap(options.gap_percent, *outcome.cost, outcome.lower_bound));
}

TEST(Threads, ABoundAboveAPlanIsAnInternalError) {
  const Instance instance = crowd(6, 5, 1);
  News news;
  news.lower = 100'000;
  for (const Role role : {Role::plans, Role::both}) {
    news.others_ended = true;
    Prompter prompter(role, 0, news);
    prompter.instance = &instance;
    const SolveOutcome outcome = solve_alone(instance, {}, tuner_for(instance), &prompter);
    if (role == Role::both && !outcome.internal_error) {
      // It was over before it heard of it.
      EXPECT_EQ(outcome.status, Status::optimal);
      continue;
    }
    EXPECT_TRUE(outcome.internal_error);
    EXPECT_FALSE(outcome.plan);
  }
}

}  // namespace
}  // namespace quadrille::discrete
