// SPDX-License-Identifier: MIT
//
// Instances without a plan for reasons that depend on what bystanders can do.
#include "feasibility/feasibility.hpp"

#include <gtest/gtest.h>

#include "continuous/support/roads.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous::test {
namespace {

using Blocked = std::vector<AgentId>;

/// Checked with the unit as given and a million times as fine.
void expect(std::vector<Point> points, const Roads& roads, const Roads& one_way,
            std::vector<Agent> agents, const Blocked& blocked) {
  for (const std::int64_t scale : {1, 1'000'000}) {
    std::vector<Point> scaled = points;
    for (Point& p : scaled) p = {scale * p.x, scale * p.y};
    std::vector<Agent> scaled_agents = agents;
    for (Agent& a : scaled_agents) std::get<Disc>(a.body).radius *= scale;
    const auto instance = Instance::make(roadmap(scaled, roads, one_way), scaled_agents).value();
    LimitMonitor limits({});
    Scene scene(instance, limits);
    const Feasibility feasibility = check_feasibility(scene);
    EXPECT_EQ(feasibility.blocked, blocked);
    ASSERT_EQ(feasibility.plan.has_value(), blocked.empty());
    if (feasibility.plan) {
      EXPECT_TRUE(verify(instance, *feasibility.plan).valid());
    }
    for (const System system : {System::dpll, System::smt_cbs}) {
      SolveOptions options;
      options.system = system;
      options.limits.cpu_s = 20;
      EXPECT_EQ(solve(instance, options).value().status,
                blocked.empty() ? Status::optimal : Status::infeasible);
    }
  }
}

TEST(Feasibility, ABystanderWithoutEdgesInTheMiddleOfTheRoad) {
  expect({{0, 0}, {20, 0}, {10, 1}}, {{0, 1}}, {}, {agent(0, 1, 2), agent(2, 2, 2)},
         {AgentId(0), AgentId(1)});
}

TEST(Feasibility, ABystanderAtASufficientDistance) {
  expect({{0, 0}, {20, 0}, {10, 4}}, {{0, 1}}, {}, {agent(0, 1, 2), agent(2, 2, 2)}, {});
  expect({{0, 0}, {20, 0}, {10, 3}}, {{0, 1}}, {}, {agent(0, 1, 2), agent(2, 2, 2)},
         {AgentId(0), AgentId(1)});
}

TEST(Feasibility, ABystanderWhoCanStepAside) {
  expect({{0, 0}, {20, 0}, {10, 1}, {10, 8}}, {{0, 1}, {2, 3}}, {},
         {agent(0, 1, 2), agent(2, 2, 2)}, {});
}

TEST(Feasibility, ABystanderWhoCouldNotComeBack) {
  expect({{0, 0}, {20, 0}, {10, 1}, {10, 8}}, {{0, 1}}, {{2, 3}}, {agent(0, 1, 2), agent(2, 2, 2)},
         {AgentId(0), AgentId(1)});
}

TEST(Feasibility, ABystanderWhoseWayOutIsTaken) {
  // Without the third the second one steps aside.
  expect({{0, 0}, {20, 0}, {10, 1}, {10, 8}}, {{0, 1}, {2, 3}}, {},
         {agent(0, 1, 2), agent(2, 2, 2), agent(3, 3, 2)}, {AgentId(0), AgentId(1), AgentId(2)});
}

TEST(Feasibility, AFullRingTurns) {
  // Each move needs the next place to become free meanwhile.
  const std::vector<Point> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  expect(square, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {},
         {agent(0, 1, 3), agent(1, 2, 3), agent(2, 3, 3), agent(3, 0, 3)}, {});
  // Discs that go around a corner after each other come as near as 10 / sqrt(2).
  expect(square, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {},
         {agent(0, 1, 4), agent(1, 2, 4), agent(2, 3, 4), agent(3, 0, 4)},
         {AgentId(0), AgentId(1), AgentId(2), AgentId(3)});
}

TEST(Feasibility, OneWhoHasToLeaveWhileAnotherOneComes) {
  // Both have to be on their ways at once: neither place becomes free before the other one's agent
  // is gone.
  expect({{0, 0}, {10, 0}, {10, 10}}, {}, {{0, 1}, {1, 2}, {2, 0}},
         {agent(0, 1, 1), agent(1, 2, 1), agent(2, 0, 1)}, {});
}

}  // namespace
}  // namespace quadrille::continuous::test
