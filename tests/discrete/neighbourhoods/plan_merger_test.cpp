// SPDX-License-Identifier: MIT
//
// The better parts of two plans.
#include "neighbourhoods/plan_merger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "discrete/primal/primal_support.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "support/environment.hpp"
#include "support/joint_search.hpp"

namespace quadrille::discrete::primal_test {
namespace {

using quadrille::support::scaled;
using support::instance_text;
using support::replay;

std::optional<Plan> plan_of(const Instance& instance, std::uint32_t seed, int steps,
                            Objective objective) {
  LimitMonitor limits{Limits{}};
  PrimalSearch search(instance, distances_of(instance), seed);
  search.advance(2'000'000, limits);
  if (search.state() != PrimalSearch::State::found) return std::nullopt;
  PlanImprover improver(instance, distances_of(instance), objective, search.plan(), seed);
  for (int step = 0; step < steps; ++step) improver.step(limits);
  return improver.plan();
}

/// The cheapest plan that takes the path of each agent from one of two plans.
Cost cheapest_mixture(const Instance& instance, const Plan& a, const Plan& b, Objective objective) {
  Cost cheapest = std::min(a.cost(objective), b.cost(objective));
  for (std::uint32_t choice = 0; choice < (1U << instance.num_agents()); ++choice) {
    Plan mixture = a;
    for (const AgentId i : instance.agent_ids())
      if ((choice >> i.index()) % 2 == 1) mixture.paths[i] = b.paths[i];
    if (mixture.cost(objective) < cheapest && replay(instance, mixture).empty())
      cheapest = mixture.cost(objective);
  }
  return cheapest;
}

TEST(PlanMerger, MakesAValidPlanThatIsNoDearerThanEither) {
  support::Random random(11);
  std::size_t num_merged = 0, num_cheaper = 0, num_cheapest = 0;
  for (std::size_t round = 0; round < scaled(1500); ++round) {
    const Instance instance = support::random_grid(random, {6, 9, 15, 4, 10});
    const auto objective = round % 3 == 0 ? Objective::makespan : Objective::sum_of_costs;
    const auto a = plan_of(instance, 1, 0, objective), b = plan_of(instance, 2, 0, objective);
    if (!a || !b || *a == *b) continue;
    SCOPED_TRACE(instance_text(instance));
    PlanMerger merger(instance);
    const Cost least = std::min(a->cost(objective), b->cost(objective));
    for (const auto& [one, other] : {std::pair(&*a, &*b), std::pair(&*b, &*a)}) {
      const Plan merged = merger.merge(*one, *other, objective);
      ASSERT_EQ(replay(instance, merged), "");
      ASSERT_LE(merged.cost(objective), least);
      for (const AgentId i : instance.agent_ids())
        ASSERT_TRUE(merged.paths[i] == one->paths[i] || merged.paths[i] == other->paths[i]);
      ASSERT_EQ(merger.merge(merged, merged, objective), merged);
      ++num_merged;
      if (merged.cost(objective) < least) ++num_cheaper;
      if (merged.cost(objective) == cheapest_mixture(instance, *one, *other, objective))
        ++num_cheapest;
    }
  }
  EXPECT_GE(num_merged, scaled(1200));
  EXPECT_GE(num_cheaper, scaled(40));
  // All but where two plans can be mixed within a part.
  EXPECT_GE(num_cheapest, num_merged * 9 / 10);
}

// Two corridors, in each of which one of two plans waits for nothing.
TEST(PlanMerger, TakesEachPartFromThePlanInWhichItIsCheaper) {
  const Instance instance = Instance::make(Graph::grid(5, 2, std::vector<bool>(10, true)),
                                           {{VertexId(0), VertexId(4)}, {VertexId(5), VertexId(9)}})
                                .value();
  const auto along = [](std::size_t first, bool waits) {
    Path path;
    if (waits) path.push_back(VertexId(first));
    for (std::size_t v = first; v < first + 5; ++v) path.push_back(VertexId(v));
    return path;
  };
  Plan a, b;
  a.paths.push_back(along(0, true));
  a.paths.push_back(along(5, false));
  b.paths.push_back(along(0, false));
  b.paths.push_back(along(5, true));
  PlanMerger merger(instance);
  EXPECT_EQ(merger.merge(a, b, Objective::sum_of_costs).cost(Objective::sum_of_costs), 8);
  EXPECT_EQ(merger.merge(a, b, Objective::makespan).cost(Objective::makespan), 4);
  // As dear in both: the first one's.
  b.paths[AgentId(0)] = a.paths[AgentId(0)];
  b.paths[AgentId(1)] = {VertexId(5), VertexId(6), VertexId(7), VertexId(8), VertexId(9)};
  EXPECT_EQ(merger.merge(a, b, Objective::sum_of_costs), a);
}

}  // namespace
}  // namespace quadrille::discrete::primal_test
