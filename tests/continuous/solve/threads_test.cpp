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
#include "primal/first_plan.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/free_bound.hpp"
#include "quadrille/core/random.hpp"
#include "solve/cost_run.hpp"
#include "solve/portfolio.hpp"
#include "support/environment.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous::test {
namespace {

using solve::Settlement;

Instance crowd(std::uint32_t seed, std::size_t num_agents) {
  RandomOptions random;
  random.num_vertices = 14;
  random.num_agents = num_agents;
  random.size = 100;
  random.edge_percent = 25;
  return random_instance(seed, random);
}

/// What both searches begin with. No plan if the agents have none that is found at once.
struct Start {
  Start(const Instance& instance, const SolveOptions& the_options)
      : options(the_options),
        account(std::make_shared<ResourceAccount>()),
        limits(options.limits, account),
        scene(instance, limits),
        pulse(options, limits, known, true) {
    known.prove(free_bound(instance.agent_ids(), options.objective,
                           [&](AgentId i) { return scene.free_cost(i); }));
    auto plan = find_first_plan(scene);
    if (!plan) return;
    const Cost its_cost = cost(*plan, options.objective);
    known.take(std::make_shared<const Plan>(*std::move(plan)), its_cost);
  }
  Settlement search(const solve::Pace& pace) {
    search_side_by_side(scene, options, account, {limits, known, pulse, alone}, pace, {}, no_proof);
    return settle(known, options.gap_percent);
  }
  Settlement search_beside(Exchange& exchange) {
    solve::run_guarded(known, limits, [&] {
      search_costs(scene, options, {limits, known, pulse, exchange}, {}, no_proof);
    });
    return settle(known, options.gap_percent);
  }

  const SolveOptions& options;
  std::shared_ptr<ResourceAccount> account;
  std::optional<ProofDraft> no_proof;
  LimitMonitor limits;
  Scene scene;
  Knowledge known;
  solve::Pulse<Plan> pulse;
  Exchange alone;
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
      const solve::Pace pace{
          Effort::microseconds(5 + static_cast<std::int64_t>(random.below(1000))),
          static_cast<std::int64_t>(random.below(4))};
      const Settlement settled = start.search(pace);
      ASSERT_FALSE(settled.error) << settled.error->message;
      ASSERT_EQ(settled.status, Status::optimal);
      EXPECT_EQ(start.known.lower(), c.truth.cost);
      EXPECT_EQ(start.known.cost, c.truth.cost);
      ASSERT_TRUE(start.known.plan);
      const VerifyReport replay = verify(c.instance, *start.known.plan);
      ASSERT_TRUE(replay.valid());
      EXPECT_EQ(cost(*start.known.plan, options.objective), c.truth.cost);
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
    std::optional<Knowledge> first;
    std::optional<Status> first_status;
    for (int run = 0; run < 5; ++run) {
      Start start(instance, options);
      const Status status = start.search({Effort::microseconds(250), 2}).status;
      const Knowledge& known = start.known;
      ASSERT_TRUE(known.plan);
      ASSERT_TRUE(verify(instance, *known.plan).valid());
      if (!first) {
        first = known;
        first_status = status;
        continue;
      }
      EXPECT_EQ(status, first_status);
      EXPECT_EQ(known.cost, first->cost);
      EXPECT_EQ(known.lower(), first->lower());
      EXPECT_EQ(*known.plan, *first->plan);
      EXPECT_EQ(known.statistics.conflicts, first->statistics.conflicts);
      EXPECT_EQ(known.statistics.cores, first->statistics.cores);
    }
  }
}

/// Others who know something after some time.
class Prompter final : public Exchange {
 public:
  Prompter(Role role, std::uint64_t silence, Message message)
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
  const std::uint64_t silence_;
  const Message message_;
  std::uint64_t num_calls_ = 0;
  Cost lower_ = 0;
};

// A plan, a bound or cores that come from elsewhere, at any moment, never make the answer worse.
TEST(ContinuousThreads, WhatIsHeardNeverWorsensTheAnswer) {
  Random random(5);
  for (Case& c : cases(support::scaled(40))) {
    SCOPED_TRACE(describe(c.instance));
    for (const Role role : {Role::all, Role::bound, Role::plans, Role::cores}) {
      Message message;
      if (random.below(2) == 0) {
        message.plan = std::make_shared<const Plan>(*c.truth.plan);
        message.cost = *c.truth.cost;
        // No plan is cheaper than this one: so every core holds in those that are.
        const AgentId i(random.below(c.instance.num_agents()));
        if (random.below(2) == 0)
          message.extra.all.push_back(
              {1, {std::make_shared<const LevelCore>(LevelCore{{i, *c.truth.cost * 2}})}});
      }
      if (random.below(2) == 0) message.lower = *c.truth.cost - static_cast<Cost>(random.below(2));
      Prompter prompter(role, random.below(8), message);
      Start start(c.instance, c.options);
      const Settlement settled = start.search_beside(prompter);
      ASSERT_FALSE(settled.error) << settled.error->message;
      EXPECT_LE(prompter.lower(), *c.truth.cost);
      ASSERT_EQ(settled.status, Status::optimal);
      EXPECT_EQ(start.known.cost, c.truth.cost);
      EXPECT_TRUE(verify(c.instance, *start.known.plan).valid());
    }
  }
}

TEST(ContinuousThreads, ABoundAboveAPlanIsAnInternalError) {
  const auto found = cases(5);
  for (const Case& c : found) {
    Message message;
    message.lower = 2 * *c.truth.cost;
    Prompter prompter(Role::bound, 0, message);
    Start start(c.instance, c.options);
    EXPECT_TRUE(start.search_beside(prompter).error);
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
