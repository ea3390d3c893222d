// SPDX-License-Identifier: MIT
// The same question gets the same kind of answer in both domains.
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/roads.hpp"
#include "faults/instances.hpp"
#include "quadrille/continuous/free_cost.hpp"

namespace quadrille::support {
namespace {

struct Grids {
  using Instance = discrete::Instance;
  using Options = discrete::SolveOptions;
  using Outcome = discrete::SolveOutcome;

  static Instance hard() { return grid(12, 60, 1); }
  static Instance easy() { return grid(4, 3, 2); }
  /// Two on a line that have to change places.
  static Instance stuck() {
    auto graph = std::make_shared<const discrete::Graph>(
        discrete::Graph::grid(3, 1, std::vector<bool>(3, true)));
    return Instance::make(graph, {{VertexId(0), VertexId(2)}, {VertexId(2), VertexId(0)}}).value();
  }
  static Cost free_cost(const Instance& instance, AgentId i) {
    const discrete::Agent& task = instance.agents()[i];
    return discrete::distances_from(instance.graph(), task.goal())[task.start];
  }
};

struct Roadmaps {
  using Instance = continuous::Instance;
  using Options = continuous::SolveOptions;
  using Outcome = continuous::SolveOutcome;

  static Instance hard() { return discs(60, 20, 4); }
  static Instance easy() { return discs(12, 3, 2); }
  static Instance stuck() {
    using continuous::test::agent;
    return Instance::make(
               continuous::test::roadmap({{0, 0}, {1000, 0}, {2000, 0}}, {{0, 1}, {1, 2}}),
               {agent(0, 2, 100), agent(2, 0, 100)})
        .value();
  }
  static Cost free_cost(const Instance& instance, AgentId i) {
    return continuous::as_cost(continuous::free_cost(instance, i).value());
  }
};

template <class Domain>
class BothDomains : public testing::Test {
 protected:
  using Options = typename Domain::Options;

  /// What the agents cost when each is alone.
  static Cost free_bound(const typename Domain::Instance& instance) {
    Cost bound = 0;
    for (const AgentId i : instance.agent_ids()) bound += Domain::free_cost(instance, i);
    return bound;
  }
};
using Domains = testing::Types<Grids, Roadmaps>;
TYPED_TEST_SUITE(BothDomains, Domains);

TYPED_TEST(BothDomains, AGapThatIsReachedNeedsNoExplanation) {
  typename TypeParam::Options options;
  options.gap_percent = 90;
  for (const std::size_t threads : {1U, 2U}) {
    options.threads = threads;
    const auto outcome = solve(TypeParam::hard(), options).value();
    EXPECT_EQ(outcome.status, Status::feasible);
    EXPECT_EQ(outcome.stop, StopReason::gap);
    EXPECT_EQ(outcome.explanation, "");
  }
}

TYPED_TEST(BothDomains, APlanAtALimitNeedsNoExplanation) {
  typename TypeParam::Options options;
  options.limits.conflicts = 1;
  for (const std::size_t threads : {1U, 2U}) {
    options.threads = threads;
    const auto outcome = solve(TypeParam::hard(), options).value();
    EXPECT_EQ(outcome.status, Status::feasible);
    EXPECT_EQ(outcome.stop, StopReason::conflicts);
    EXPECT_EQ(outcome.explanation, "");
    EXPECT_GE(outcome.lower_bound, this->free_bound(TypeParam::hard()));
  }
}

// Nothing was searched, but this much is known of any plan.
TYPED_TEST(BothDomains, TheBoundOfASearchThatHardlyBeganIsTheFreeOne) {
  const auto instance = TypeParam::hard();
  const std::atomic<bool> interrupt = true;
  std::vector<Limits> all(5);
  all[0].conflicts = 0;
  all[1].wall_s = 0;
  all[2].cpu_s = 0;
  all[3].interrupt = &interrupt;
  all[4].looks = 1;
  for (const Limits& limits : all)
    for (const std::size_t threads : {1U, 2U}) {
      typename TypeParam::Options options;
      options.limits = limits;
      options.threads = threads;
      const auto outcome = solve(instance, options).value();
      EXPECT_EQ(outcome.status, Status::unknown) << to_string(outcome.stop);
      EXPECT_NE(outcome.stop, StopReason::none);
      EXPECT_EQ(outcome.explanation,
                "stopped by the limit: " + std::string(to_string(outcome.stop)));
      EXPECT_EQ(outcome.lower_bound, this->free_bound(instance)) << to_string(outcome.stop);
      options.known_lower_bound = outcome.lower_bound + 1;
      const auto claimed = solve(instance, options).value();
      EXPECT_EQ(claimed.lower_bound, options.known_lower_bound);
      EXPECT_TRUE(claimed.rests_on_known_bound);
    }
}

TYPED_TEST(BothDomains, WhereThereIsNoPlanItIsSaidWhoAndWhere) {
  typename TypeParam::Options options;
  options.known_lower_bound = 1'000'000;
  for (const std::size_t threads : {1U, 2U}) {
    options.threads = threads;
    const auto outcome = solve(TypeParam::stuck(), options).value();
    EXPECT_EQ(outcome.status, Status::infeasible);
    EXPECT_EQ(outcome.stop, StopReason::none);
    EXPECT_NE(outcome.explanation, "");
    EXPECT_EQ(outcome.blocked, (std::vector<AgentId>{AgentId(0), AgentId(1)}));
    EXPECT_FALSE(outcome.bottleneck.empty());
    EXPECT_EQ(outcome.lower_bound, 0);
    EXPECT_FALSE(outcome.rests_on_known_bound);
  }
}

// No plan that is known may contradict a claim of the user, or what was proved.
TYPED_TEST(BothDomains, GivenPlansAreHeldAgainstTheClaim) {
  const auto instance = TypeParam::easy();
  typename TypeParam::Options options;
  const auto truth = solve(instance, options).value();
  ASSERT_EQ(truth.status, Status::optimal);
  options.debug.known_plan = truth.plan;
  EXPECT_EQ(solve(instance, options).value().status, Status::optimal);
  options.known_lower_bound = *truth.cost + 1;
  options.limits.conflicts = 0;
  const std::string wrong = "the known lower bound is wrong: it is " +
                            std::to_string(*truth.cost + 1) + ", and a plan costs " +
                            std::to_string(*truth.cost);
  const auto by_known = solve(instance, options);
  ASSERT_FALSE(by_known.has_value());
  EXPECT_EQ(by_known.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(by_known.error().message, wrong);
  options.initial_plan = std::exchange(options.debug.known_plan, std::nullopt);
  const auto by_initial = solve(instance, options);
  ASSERT_FALSE(by_initial.has_value());
  EXPECT_EQ(by_initial.error().message, wrong);
}

TYPED_TEST(BothDomains, OptionsOutsideTheirRangesAreRefusedInTheSameWords) {
  const auto instance = TypeParam::easy();
  const auto error = [&](const auto& change) {
    typename TypeParam::Options options;
    change(options);
    const auto outcome = solve(instance, options);
    if (outcome) return std::string("none");
    EXPECT_EQ(outcome.error().code, ErrorCode::out_of_range);
    return outcome.error().message;
  };
  EXPECT_EQ(error([](auto& o) { o.gap_percent = -1; }), "the gap is not a number of at least 0");
  EXPECT_EQ(error([](auto& o) { o.threads = 0; }), "the number of threads is not from 1 to 64");
  EXPECT_EQ(error([](auto& o) { o.seed = 2'000'000'001; }), "the seed is larger than 2000000000");
  EXPECT_EQ(error([](auto& o) { o.known_lower_bound = -1; }),
            "the known lower bound is negative, or out of range");
  EXPECT_EQ(error([](auto& o) { o.progress_interval_s = -1; }),
            "the progress interval is not a number of at least 0");
  EXPECT_EQ(error([](auto& o) { o.plan_interval_s = -1; }),
            "the plan interval is not a number of at least 0");
  EXPECT_EQ(error([](auto& o) {
              o.explain = true;
              o.threads = 2;
            }),
            "an explanation needs one thread");
}

}  // namespace
}  // namespace quadrille::support
