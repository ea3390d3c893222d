// SPDX-License-Identifier: MIT
//
// Instances whose least costs follow from a few lines of arithmetic.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "continuous/support/least_cost.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/solver.hpp"

namespace quadrille::continuous::test {
namespace {

class KnownValue : public testing::TestWithParam<System> {
 protected:
  Cost least(std::shared_ptr<const Roadmap> map, std::vector<Agent> agents,
             Objective objective = Objective::sum_of_costs) {
    return least_cost(Instance::make(std::move(map), std::move(agents)).value(), GetParam(),
                      objective);
  }
};

TEST_P(KnownValue, PassingAtTouchingDistanceIsFreeAndOneUnitLessIsNot) {
  // Agent 1 stands beside the road of agent 0, whose detour is twice 13000 long.
  for (const Length distance : {Length{600}, Length{599}}) {
    const auto map = roadmap({{0, 0}, {10'000, 0}, {5'000, distance}, {5'000, -12'000}},
                             {{0, 1}, {0, 3}, {3, 1}});
    const Cost cost = least(map, {agent(0, 1, 400), agent(2, 2, 200)});
    EXPECT_EQ(cost, distance == 600 ? 10'000 : 26'000);
  }
}

TEST_P(KnownValue, AMoveMayEndInTouch) {
  // Agent 0 arrives at touching distance from where agent 1 stands for ever.
  EXPECT_EQ(least(roadmap({{0, 0}, {5'000, 0}, {5'600, 0}}, {{0, 1}, {1, 2}}),
                  {agent(0, 1, 300), agent(2, 2, 300)}),
            5'000);
}

TEST_P(KnownValue, FollowingAroundACorner) {
  // Agent 0 sets off to the right from the corner, agent 1 comes up to it from 1000 below. If agent
  // 1 starts w later, the square of their distance is t^2 + (1000 + w - t)^2: least is (1000 + w) /
  // sqrt(2), which is 707.1 for w = 0, 707.8 for 1 and 708.5 for 2.
  const auto map =
      roadmap({{0, 0}, {2'000, 0}, {0, -1'000}, {1'000, 0}}, {}, {{0, 3}, {3, 1}, {2, 0}});
  EXPECT_EQ(least(map, {agent(0, 1, 400), agent(2, 3, 307)}), 2'000 + 1'000 + 1'000 + 0);
  // It stops 1000 behind the goal of the other.
  EXPECT_EQ(least(map, {agent(0, 1, 400), agent(2, 3, 308)}), 2'000 + 1'000 + 1'000 + 2);
}

TEST_P(KnownValue, ASlowLeaderHoldsUpAFasterFollower) {
  // One way, 1000 apart; the leader needs two ticks per length unit. On the last edge, from 1000 to
  // 3000, the follower, who enters it at s, is at its end at s + 2000; the leader is there at 4000
  // and goes on to 4000, where it arrives at 6000. They are 600 apart when the follower arrives if
  // s + 2000 >= 5200.
  const auto map =
      roadmap({{0, 0}, {1'000, 0}, {3'000, 0}, {4'000, 0}}, {}, {{0, 1}, {1, 2}, {2, 3}});
  EXPECT_EQ(least(map, {agent(1, 3, 300, kUnitSpeed * 2 / 4), agent(0, 2, 300)}), 6'000 + 5'200);
}

TEST_P(KnownValue, OneOfTwoWaitsInASiding) {
  // Agent 1 reaches the junction (1000, 0) at 1000 and the siding at 1800. Agent 0, starting at w,
  // is nearest at w / sqrt(2), so w >= 849. It is at the junction at 1849; agent 1, leaving the
  // siding at d, comes as near as (d + 800 - 1849) / sqrt(2), so d >= 1898. In the other order
  // everything is the same.
  const auto map =
      roadmap({{0, 0}, {1'000, 0}, {2'000, 0}, {1'000, 800}}, {{0, 1}, {1, 2}, {1, 3}});
  EXPECT_EQ(least(map, {agent(0, 2, 300), agent(2, 0, 300)}), (849 + 2'000) + (1'898 + 1'800));
  EXPECT_EQ(least(map, {agent(0, 2, 300), agent(2, 0, 300)}, Objective::makespan), 3'698);
}

TEST_P(KnownValue, CrossingInTheMiddleOfTwoEdges) {
  // At right angles and equal speeds the distance is at least offset / sqrt(2).
  const auto map = roadmap({{-1'000, 0}, {1'000, 0}, {0, -1'000}, {0, 1'000}}, {{0, 1}, {2, 3}});
  EXPECT_EQ(least(map, {agent(0, 1, 50), agent(2, 3, 50)}), 4'000 + 142);  // 141.42
  EXPECT_EQ(least(map, {agent(0, 1, 35), agent(2, 3, 35)}), 4'000 + 99);   // 98.99
  // One is twice as fast: it is there at 500 and the other at 1000, and they never meet. The speeds
  // (1, 0) and (0, 2): the distance is 1000 * 1 * 2 / 2 / sqrt(5) = 447.2.
  EXPECT_EQ(least(map, {agent(0, 1, 223), agent(2, 3, 224, 2 * kUnitSpeed)}), 2'000 + 1'000);
  EXPECT_GT(least(map, {agent(0, 1, 224), agent(2, 3, 224, 2 * kUnitSpeed)}), 2'000 + 1'000);
}

TEST_P(KnownValue, ASidingThatIsNotDeepEnoughMakesItInfeasible) {
  // Agents of radius 400 and more than 400 cannot pass each other at a distance of 800.
  for (const Length radius : {Length{400}, Length{401}}) {
    const auto map =
        roadmap({{0, 0}, {1'000, 0}, {2'000, 0}, {1'000, 800}}, {{0, 1}, {1, 2}, {1, 3}});
    const Instance instance = Instance::make(map, {agent(0, 2, radius), agent(2, 0, 400)}).value();
    SolveOptions options;
    options.system = GetParam();
    options.limits.cpu_s = 20;
    for (const bool is_joint_first : {true, false}) {
      if (!is_joint_first) options.route_work = options.joint_work = 0;
      const SolveOutcome outcome = solve(instance, options).value();
      EXPECT_EQ(outcome.status, radius == 400 ? Status::optimal : Status::infeasible);
      EXPECT_EQ(outcome.explanation.empty(), radius == 400) << outcome.explanation;
      using Agents = std::vector<AgentId>;
      using Vertices = std::vector<VertexId>;
      EXPECT_EQ(outcome.blocked, radius == 400 ? Agents{} : Agents({AgentId(0), AgentId(1)}));
      EXPECT_EQ(outcome.bottleneck,
                radius == 400 ? Vertices{} : Vertices({VertexId(0), VertexId(1), VertexId(2)}));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Systems, KnownValue, testing::Values(System::dpll, System::smt_cbs),
                         [](const auto& param) {
                           return std::string(param.param == System::dpll ? "Dpll" : "SmtCbs");
                         });

}  // namespace
}  // namespace quadrille::continuous::test
