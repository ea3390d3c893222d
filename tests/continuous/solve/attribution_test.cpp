// SPDX-License-Identifier: MIT
// What lower bounds are made of: each raise against plans of the agents that it names.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "continuous/routes/order_search.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/solver.hpp"
#include "support/attribution_check.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

using support::num_partial_raises;
using support::scaled;

Instance restricted(const Instance& instance, const std::vector<AgentId>& agents) {
  std::vector<Agent> kept;
  for (const AgentId i : agents) kept.push_back(instance.agent(i));
  return Instance::make(instance.shared_roadmap(), std::move(kept), instance.resolution(), {},
                        instance.obstacles())
      .value();
}

/// Two oracles: the joint search over places and times, without clauses, and orders of routes.
std::optional<Cost> least(const Instance& instance, Objective objective) {
  SolveOptions options;
  options.objective = objective;
  options.route_work = 0;
  options.limits.conflicts = 0;  // what the joint search does not settle is left alone
  const SolveOutcome outcome = solve(instance, options).value();
  if (outcome.status == Status::optimal) return outcome.cost;
  return search_orders(instance, objective, 3).best;
}

struct Count {
  int raises = 0, partial = 0, bystanders = 0, covers = 0, sites = 0;
};

std::string check(const Instance& instance, const SolveOptions& options, Count& count) {
  const SolveOutcome outcome = solve(instance, options).value();
  if (outcome.internal_error) return outcome.internal_error->message;
  if (outcome.status == Status::infeasible)
    return outcome.attribution ? "an attribution of nothing" : "";
  if (!outcome.attribution) return "no attribution";
  const Attribution& attribution = *outcome.attribution;
  count.raises += static_cast<int>(attribution.raises.size());
  count.partial += num_partial_raises(attribution);
  count.sites += static_cast<int>(attribution.sites.size());
  for (const Raise& raise : attribution.raises) {
    count.bystanders += !raise.bystanders.empty();
    count.covers += raise.kind == RaiseKind::cover;
  }
  for (const AgentId i : instance.agent_ids())
    if (outcome.plan && attribution.agents[i].cost != cost(outcome.plan->paths[i]))
      return "an agent's cost is not that in the plan";
  return support::find_fault(attribution, outcome.lower_bound, [&](const auto& agents) {
    return least(restricted(instance, agents), options.objective);
  });
}

class AttributionRandom : public testing::TestWithParam<Objective> {};

TEST_P(AttributionRandom, EachClaimHoldsForItsAgentsAlone) {
  Count count;
  const auto cases = static_cast<std::uint32_t>(scaled(150));
  for (std::uint32_t seed = 0; seed < cases; ++seed) {
    RandomOptions random;
    random.num_agents = 2 + seed % 3;
    random.num_vertices = 5 + seed / 2 % 4;
    random.edge_percent = 30 + static_cast<int>(seed / 8 % 3) * 15;
    // Who has a deadline counts wherever others are said to cost more: without that, claims about
    // some of these are wrong.
    if (seed % 5 == 4) random.deadline_percent = 100;
    const Instance instance = random_instance(3'000'000 + seed, random);
    SolveOptions options;
    options.objective = GetParam();
    options.explain = true;
    options.system = seed % 5 == 0 ? System::smt_cbs : System::dpll;
    options.limits.conflicts = seed % 7 == 0 ? 20 : 500;
    options.limits.cpu_s = 0.3;
    options.joint_work = seed % 11 == 0 ? SolveOptions().joint_work : 0;
    options.route_work = seed % 13 == 0 ? 1000 : 0;
    options.debug.audit = seed % 6 == 0;
    const std::string fault = check(instance, options, count);
    ASSERT_EQ(fault, "") << "seed " << seed << ": " << describe(instance);
  }
  RecordProperty("raises", count.raises);
  RecordProperty("partial", count.partial);
  RecordProperty("bystanders", count.bystanders);
  RecordProperty("covers", count.covers);
  RecordProperty("sites", count.sites);
  if (cases < 150) return;  // scaled down: too few to count on chance
  EXPECT_GT(count.partial, 10);
  EXPECT_GT(count.sites, 100);
}

INSTANTIATE_TEST_SUITE_P(All, AttributionRandom,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& param) {
                           return param.param == Objective::makespan ? "Makespan" : "SumOfCosts";
                         });

// The search is the same with and without.
TEST(Attribution, ChangesNoSearch) {
  for (std::uint32_t seed = 0; seed < scaled(15); ++seed) {
    RandomOptions random;
    random.num_agents = 4;
    random.num_vertices = 12;
    random.size = 80;
    const Instance instance = random_instance(seed, random);
    for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
      SolveOptions options;
      options.objective = objective;
      options.limits.conflicts = 500;
      options.joint_work = options.route_work = 0;
      const SolveOutcome plain = solve(instance, options).value();
      options.explain = true;
      const SolveOutcome explained = solve(instance, options).value();
      EXPECT_EQ(plain.status, explained.status) << seed;
      EXPECT_EQ(plain.lower_bound, explained.lower_bound) << seed;
      EXPECT_EQ(plain.plan, explained.plan) << seed;
      EXPECT_EQ(plain.statistics.conflicts, explained.statistics.conflicts) << seed;
      EXPECT_EQ(plain.statistics.clauses, explained.statistics.clauses) << seed;
      EXPECT_FALSE(plain.attribution);
    }
  }
}

TEST(Attribution, IsRefusedWithThreads) {
  SolveOptions options;
  options.explain = true;
  options.threads = 2;
  EXPECT_EQ(solve(random_instance(1, {}), options).error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace quadrille::continuous::test
