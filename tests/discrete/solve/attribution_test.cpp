// SPDX-License-Identifier: MIT
// What lower bounds are made of: each raise against the joint search of the agents it names.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "support/attribution_check.hpp"
#include "support/environment.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::num_partial_raises;
using quadrille::support::scaled;

Instance restricted(const Instance& instance, const std::vector<AgentId>& agents) {
  std::vector<Agent> kept;
  for (const AgentId i : agents) kept.push_back(instance.agents()[i]);
  return Instance::make(instance.shared_graph(), std::move(kept)).value();
}

struct Count {
  int raises = 0, partial = 0, bystanders = 0, sites = 0;
};

/// Empty if all is well.
std::string check(const Instance& instance, const TunedOptions& options, Count& count) {
  const SolveOutcome outcome = solve(instance, options).value();
  if (outcome.internal_error) return outcome.internal_error->message;
  if (outcome.status == Status::infeasible)
    return outcome.attribution ? "an attribution of nothing" : "";
  if (!outcome.attribution) return "no attribution";
  const Attribution& attribution = *outcome.attribution;
  count.raises += static_cast<int>(attribution.raises.size());
  count.partial += num_partial_raises(attribution);
  count.sites += static_cast<int>(attribution.sites.size());
  for (const Raise& raise : attribution.raises) count.bystanders += !raise.bystanders.empty();
  for (const AgentId i : instance.agent_ids())
    if (outcome.plan && attribution.agents[i].cost != arrival(outcome.plan->paths[i]))
      return "an agent's cost is not that in the plan";
  const auto least = [&](const std::vector<AgentId>& agents) {
    const JointAnswer answer = joint_search(restricted(instance, agents), options.objective);
    return answer.status == Status::optimal ? std::optional(answer.cost) : std::nullopt;
  };
  return quadrille::support::find_fault(attribution, outcome.lower_bound, least);
}

TunedOptions random_options(Random& random, Objective objective) {
  TunedOptions options;
  options.objective = objective;
  options.explain = true;
  options.seed = static_cast<std::uint32_t>(random.below(1000));
  options.first_plan = random.percent(30);
  options.debug.audit = random.percent(20);
  if (random.percent(20)) options.cost_search = CostSearch::iterative;
  if (random.percent(50)) options.first_turn = 1 + static_cast<std::int64_t>(random.below(20));
  if (random.percent(50)) options.open = random.percent(50);
  if (random.percent(15))
    options.limits.conflicts = static_cast<std::int64_t>(random.between(1, 30));
  return options;
}

class AttributionRandom : public testing::TestWithParam<Objective> {};

TEST_P(AttributionRandom, EachClaimHoldsForItsAgentsAlone) {
  Count count;
  const auto cases = static_cast<std::uint64_t>(scaled(700));
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    Random random(seed);
    GridShape shape{2, 4, 30, 2, 4};
    if (seed % 4 == 0) shape = {1, 3, 20, 4, 4};
    Instance instance = random_grid(random, shape);
    if (random.percent(30)) instance = with_more_goals(random, instance);
    const std::string fault = check(instance, random_options(random, GetParam()), count);
    ASSERT_EQ(fault, "") << "seed " << seed;
  }
  RecordProperty("raises", count.raises);
  RecordProperty("partial", count.partial);
  RecordProperty("bystanders", count.bystanders);
  RecordProperty("sites", count.sites);
  if (cases < 700) return;  // scaled down: too few to count on chance
  EXPECT_GT(count.partial, 40);
  EXPECT_GT(count.sites, 500);
}

INSTANTIATE_TEST_SUITE_P(All, AttributionRandom,
                         testing::Values(Objective::sum_of_costs, Objective::makespan),
                         [](const auto& param) {
                           return param.param == Objective::makespan ? "Makespan" : "SumOfCosts";
                         });

// Two pairs that do not know each other: each has its own raise.
TEST(Attribution, PairsApartHaveRaisesApart) {
  // Two corridors with a bay each, and a wall between them.
  const std::vector<bool> passable{1, 1, 1, 1, 1,  //
                                   0, 0, 1, 0, 0,  //
                                   0, 0, 0, 0, 0,  //
                                   0, 0, 1, 0, 0,  //
                                   1, 1, 1, 1, 1};
  const Graph graph = Graph::grid(5, 5, passable);
  const auto at = [&](int x, int y) { return *graph.layout()->vertex_at({x, y}); };
  const Instance instance =
      Instance::make(
          graph,
          {{at(0, 0), at(4, 0)}, {at(4, 0), at(0, 0)}, {at(0, 4), at(4, 4)}, {at(4, 4), at(0, 4)}})
          .value();
  SolveOptions options;
  options.explain = true;
  const SolveOutcome outcome = solve(instance, options).value();
  ASSERT_EQ(outcome.status, Status::optimal);
  ASSERT_TRUE(outcome.attribution);
  std::map<std::vector<AgentId>, Cost> raised;
  for (const Raise& raise : outcome.attribution->raises) {
    EXPECT_EQ(raise.kind, RaiseKind::core);
    EXPECT_TRUE(raise.bystanders.empty());
    raised[raise.agents] += raise.amount;
  }
  const std::map<std::vector<AgentId>, Cost> expected{{{AgentId(0), AgentId(1)}, 3},
                                                      {{AgentId(2), AgentId(3)}, 3}};
  EXPECT_EQ(raised, expected);
  for (const CollisionSite& site : outcome.attribution->sites)
    EXPECT_EQ(site.first.index() / 2, site.second.index() / 2);
}

TEST(Attribution, IsRefusedWhereItWouldBeWrong) {
  const Instance instance = Instance::make(Graph::grid(2, 1, {1, 1}), {}).value();
  SolveOptions options;
  options.explain = true;
  options.threads = 2;
  EXPECT_EQ(solve(instance, options).error().code, ErrorCode::out_of_range);
  options.threads = 1;
  options.system = System::smt_cbs;
  EXPECT_EQ(solve(instance, options).error().code, ErrorCode::out_of_range);
}

TEST(Attribution, IsAbsentUnlessAskedFor) {
  const Graph graph = Graph::grid(2, 1, {1, 1});
  const Instance instance = Instance::make(graph, {{VertexId(0), VertexId(1)}}).value();
  EXPECT_FALSE(solve(instance, SolveOptions()).value().attribution);
}

// The search is the same with and without.
TEST(Attribution, ChangesNoSearch) {
  for (std::uint64_t seed = 0; seed < scaled(60); ++seed) {
    Random random(seed);
    const Instance instance = random_grid(random, {4, 6, 20, 5, 9});
    for (const Objective objective : {Objective::sum_of_costs, Objective::makespan}) {
      SolveOptions options;
      options.objective = objective;
      options.limits.conflicts = 2000;
      const SolveOutcome plain = solve(instance, options).value();
      options.explain = true;
      const SolveOutcome explained = solve(instance, options).value();
      EXPECT_EQ(plain.status, explained.status) << seed;
      EXPECT_EQ(plain.lower_bound, explained.lower_bound) << seed;
      EXPECT_EQ(plain.plan, explained.plan) << seed;
      EXPECT_EQ(plain.statistics.conflicts, explained.statistics.conflicts) << seed;
      EXPECT_EQ(plain.statistics.clauses, explained.statistics.clauses) << seed;
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
