// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "paths/scene.hpp"
#include "primal/first_plan.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/random.hpp"
#include "solve/cost_run.hpp"
#include "solve/portfolio.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

Instance crowd(std::uint32_t seed, std::size_t num_agents) {
  RandomOptions random;
  random.num_vertices = 14;
  random.num_agents = num_agents;
  random.size = 100;
  random.edge_percent = 25;
  return random_instance(seed, random);
}

/// What both searches begin with. Null if the agents have no plan that is found at once.
struct Start {
  Start(const Instance& instance, const SolveOptions& options)
      : account(std::make_shared<ResourceAccount>()),
        limits(options.limits, account),
        scene(instance, limits) {
    for (const AgentId i : instance.agent_ids())
      known.lower_bound = options.objective == Objective::sum_of_costs
                              ? known.lower_bound + scene.free_cost(i)
                              : std::max(known.lower_bound, scene.free_cost(i));
    known.plan = find_first_plan(scene);
  }
  std::shared_ptr<ResourceAccount> account;
  LimitMonitor limits;
  Scene scene;
  CostReport known;
};

struct Case {
  Instance instance;
  SolveOptions options;
  SolveOutcome truth;
};

/// Instances that are not solved at once, with what one thread finds.
std::vector<Case> cases(std::size_t count) {
  std::vector<Case> found;
  for (std::uint32_t seed = 1; found.size() < count && seed < 20 * count; ++seed) {
    const Instance instance = crowd(seed, 3 + seed % 4);
    SolveOptions options;
    options.objective = seed % 5 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.system = seed % 7 == 0 ? System::smt_cbs : System::dpll;
    options.joint_work = options.route_work = 0;
    if (!Start(instance, options).known.plan) continue;
    options.limits.conflicts = 100;
    SolveOutcome truth = solve(instance, options).value();
    if (truth.status != Status::optimal || truth.statistics.conflicts < 3) continue;
    options.limits = {};
    options.seed = seed;
    found.push_back({instance, options, std::move(truth)});
  }
  return found;
}

/// One that takes many conflicts.
Instance hard_instance() {
  for (std::uint32_t seed = 1;; ++seed) {
    Instance instance = crowd(seed, 9);
    SolveOptions options;
    options.limits.conflicts = 100;
    if (!Start(instance, options).known.plan) continue;
    if (solve(instance, options).value().status == Status::feasible) return instance;
  }
}

TEST(ContinuousThreads, FindWhatOneThreadFinds) {
  std::size_t num_known = 0, num_compared = 0;
  for (Case& c : cases(support::scaled(60))) {
    SCOPED_TRACE(describe(c.instance));
    Random random(c.options.seed);
    for (int run = 0; run < 3; ++run) {
      SolveOptions options = c.options;
      options.threads = 2 + random.below(3);
      options.race = run == 2;
      // Half of them without: cores are not exchanged where they have to be proved again.
      options.debug.audit = random.below(4) == 0;
      if (random.below(2) == 0) options.debug.known_plan = c.truth.plan;
      num_known += options.debug.known_plan && !options.debug.audit ? 1 : 0;
      Start start(c.instance, options);
      const Pace pace{static_cast<std::int64_t>(100 + random.below(20'000)),
                      static_cast<std::int64_t>(random.below(4))};
      const SolveOutcome outcome =
          search_side_by_side(start.scene, options, start.known, start.limits, start.account, pace);
      ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
      ASSERT_EQ(outcome.status, Status::optimal);
      EXPECT_EQ(outcome.lower_bound, c.truth.cost);
      EXPECT_EQ(outcome.cost, c.truth.cost);
      ASSERT_TRUE(outcome.plan);
      const VerifyReport replay = verify(c.instance, *outcome.plan);
      ASSERT_TRUE(replay.valid());
      EXPECT_EQ(cost(*outcome.plan, options.objective), c.truth.cost);
      ++num_compared;
    }
  }
  EXPECT_GE(num_compared, support::scaled(150));
  EXPECT_GE(num_known, support::scaled(40));
}

TEST(ContinuousThreads, FiveRunsGiveTheSameAnswer) {
  const Instance instance = hard_instance();
  for (const std::size_t threads : {2U, 3U}) {
    SolveOptions options;
    options.threads = threads;
    options.limits.conflicts = 150;
    std::optional<SolveOutcome> first;
    for (int run = 0; run < 5; ++run) {
      Start start(instance, options);
      SolveOutcome outcome = search_side_by_side(start.scene, options, start.known, start.limits,
                                                 start.account, {5000, 2});
      ASSERT_TRUE(outcome.plan);
      ASSERT_TRUE(verify(instance, *outcome.plan).valid());
      if (!first) {
        first = std::move(outcome);
        continue;
      }
      EXPECT_EQ(outcome.status, first->status);
      EXPECT_EQ(outcome.cost, first->cost);
      EXPECT_EQ(outcome.lower_bound, first->lower_bound);
      EXPECT_EQ(*outcome.plan, *first->plan);
      EXPECT_EQ(outcome.statistics.conflicts, first->statistics.conflicts);
      EXPECT_EQ(outcome.statistics.cores, first->statistics.cores);
    }
  }
}

/// Others who know something after some time.
class Prompter final : public Companion {
 public:
  Prompter(Role role, std::uint64_t silence, News news)
      : role_(role), silence_(silence), news_(std::move(news)) {}
  std::size_t worker() const override { return 0; }
  Role role() const override { return role_; }
  std::optional<News> on_effort(std::int64_t, const std::function<News()>& tell) override {
    const News told = tell();
    lower_ = std::max(lower_, told.lower);
    if (++num_calls_ < silence_) return News();
    return news_;
  }
  [[nodiscard]] Cost lower() const { return lower_; }

 private:
  const Role role_;
  const std::uint64_t silence_;
  const News news_;
  std::uint64_t num_calls_ = 0;
  Cost lower_ = 0;
};

// A plan, a bound or cores that come from elsewhere, at any moment, never make the answer worse.
TEST(ContinuousThreads, WhatIsHeardNeverWorsensTheAnswer) {
  Random random(5);
  for (Case& c : cases(support::scaled(40))) {
    SCOPED_TRACE(describe(c.instance));
    for (const Role role : {Role::all, Role::bound, Role::plans, Role::cores}) {
      News news;
      if (random.below(2) == 0) {
        news.plan = std::make_shared<const Plan>(*c.truth.plan);
        news.cost = *c.truth.cost;
        // No plan is cheaper than this one: so every core holds in those that are.
        const AgentId i(random.below(c.instance.num_agents()));
        if (random.below(2) == 0)
          news.cores.push_back(
              {1, {std::make_shared<const LevelCore>(LevelCore{{i, *c.truth.cost * 2}})}});
      }
      if (random.below(2) == 0) news.lower = *c.truth.cost - static_cast<Cost>(random.below(2));
      Prompter prompter(role, random.below(8), news);
      Start start(c.instance, c.options);
      const SolveOutcome outcome =
          search_alone(start.scene, c.options, start.known, start.limits, &prompter);
      ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->message;
      EXPECT_LE(prompter.lower(), *c.truth.cost);
      ASSERT_EQ(outcome.status, Status::optimal);
      EXPECT_EQ(outcome.cost, c.truth.cost);
      EXPECT_TRUE(verify(c.instance, *outcome.plan).valid());
    }
  }
}

TEST(ContinuousThreads, ABoundAboveAPlanIsAnInternalError) {
  const auto found = cases(5);
  for (const Case& c : found) {
    News news;
    news.lower = 2 * *c.truth.cost;
    Prompter prompter(Role::bound, 0, news);
    Start start(c.instance, c.options);
    const SolveOutcome outcome =
        search_alone(start.scene, c.options, start.known, start.limits, &prompter);
    EXPECT_TRUE(outcome.internal_error);
  }
  EXPECT_EQ(found.size(), 5U);
}

// Nobody waits for a search that has ended, whatever ended it.
TEST(ContinuousThreads, CutAtAnyLookNothingFalseIsClaimed) {
  int num_cut = 0;
  for (const Case& c : cases(8))
    for (std::int64_t looks = 1; looks <= 400;
         looks += 400 / static_cast<int>(support::scaled(50))) {
      SCOPED_TRACE(describe(c.instance) + " looks " + std::to_string(looks));
      SolveOptions options = c.options;
      options.threads = 3;
      options.limits.looks = looks;
      const SolveOutcome outcome = solve(c.instance, options).value();
      ASSERT_FALSE(outcome.internal_error);
      ASSERT_LE(outcome.lower_bound, *c.truth.cost);
      ASSERT_NE(outcome.status, Status::infeasible);
      if (outcome.cost) {
        ASSERT_GE(*outcome.cost, *c.truth.cost);
      }
      num_cut += outcome.status == Status::optimal ? 0 : 1;
    }
  EXPECT_GE(num_cut, 8);
}

TEST(ContinuousThreads, WhatACallbackThrowsEndsAll) {
  const Instance instance = hard_instance();
  SolveOptions options;
  options.threads = 3;
  options.progress_interval_s = 0;
  options.on_progress = [](const Progress&) { throw std::runtime_error("enough"); };
  EXPECT_THROW(static_cast<void>(solve(instance, options)), std::runtime_error);
}

TEST(ContinuousThreads, AreFrom1To64) {
  const Instance instance = crowd(3, 3);
  for (const std::size_t threads : {std::size_t{0}, kMaxThreads + 1}) {
    SolveOptions options;
    options.threads = threads;
    EXPECT_EQ(solve(instance, options).error().code, ErrorCode::out_of_range);
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
