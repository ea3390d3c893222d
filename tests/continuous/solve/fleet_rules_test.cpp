// SPDX-License-Identifier: MIT
//
// Groups, releases, deadlines, and agents that leave: answers derived by hand, and random instances
// with all of these against the oracle, with all searches.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "continuous/support/least_cost.hpp"
#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

class FleetRules : public testing::TestWithParam<Asked> {
 protected:
  [[nodiscard]] Objective objective() const { return std::get<0>(GetParam()); }
  [[nodiscard]] System system() const { return std::get<1>(GetParam()); }
  [[nodiscard]] bool is_sum() const { return objective() == Objective::sum_of_costs; }
  [[nodiscard]] Cost least(const std::shared_ptr<const Roadmap>& map,
                           std::vector<Agent> agents) const {
    return least_cost(Instance::make(map, std::move(agents)).value(), system(), objective());
  }
  [[nodiscard]] SolveOutcome answer(const Instance& instance) const {
    SolveOptions options;
    options.system = system();
    options.objective = objective();
    options.debug.audit = true;
    options.limits.cpu_s = 20;
    return solve(instance, options).value();
  }
};

TEST_P(FleetRules, ClosedRoadsAreNotTaken) {
  // The short way is for group 1.
  std::vector<Edge> edges{{VertexId(0), VertexId(1), std::nullopt, {GroupId(1)}},
                          {VertexId(0), VertexId(2), std::nullopt},
                          {VertexId(2), VertexId(1), std::nullopt}};
  const auto map = std::make_shared<const Roadmap>(
      Roadmap::make({{0, 0}, {1000, 0}, {500, 1200}}, std::move(edges)).value());
  std::vector<Agent> agents{agent(0, 1, 100)};
  EXPECT_EQ(least(map, agents), 2600);
  agents[0].group = GroupId(1);
  EXPECT_EQ(least(map, agents), 1000);
}

TEST_P(FleetRules, WhoIsNotReleasedIsInTheWay) {
  // Agent 1 stands at vertex 1 until tick 5000, where agent 0 has to pass. Then it goes aside: half
  // a diameter's way later the other one may be there, at right angles later.
  const auto map = roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 1000}}, {{0, 1}, {1, 2}, {1, 3}});
  std::vector<Agent> agents{agent(0, 2, 100), agent(1, 3, 100)};
  // At right angles discs of reach 200 are apart if one is 200 * sqrt(2) = 282.8 behind.
  EXPECT_EQ(least(map, agents), is_sum() ? 3000 : 2000);
  agents[1].release = 5000;
  // Agent 0 is at vertex 1 when agent 1 is 283 away: at 5283, and at its goal 1000 later.
  EXPECT_EQ(least(map, agents), is_sum() ? 6000 + 6283 : 6283);
}

TEST_P(FleetRules, WhoStaysNeedNoRelease) {
  const auto map = roadmap({{0, 0}, {1000, 0}, {2000, 0}}, {{0, 1}, {1, 2}});
  std::vector<Agent> agents{agent(0, 1, 100), agent(2, 2, 100)};
  agents[0].release = 77;
  agents[1].release = 5000;
  EXPECT_EQ(least(map, agents), 1077);
}

TEST_P(FleetRules, DeadlinesDecideWhoGoesFirst) {
  // Both need vertex 1 on their way; alone each takes 2000.
  const auto map = roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 1000}, {1000, -1000}},
                           {{0, 1}, {1, 2}, {3, 1}, {1, 4}});
  std::vector<Agent> agents{agent(0, 2, 100), agent(3, 4, 100)};
  EXPECT_EQ(least(map, agents), is_sum() ? 4283 : 2283);
  for (const std::size_t first : {0U, 1U}) {
    std::vector<Agent> hurried = agents;
    hurried[first].deadline = Ticks{2282};
    const Instance instance = Instance::make(map, hurried).value();
    const SolveOutcome outcome = answer(instance);
    ASSERT_EQ(outcome.status, Status::optimal);
    EXPECT_EQ(*outcome.cost, is_sum() ? 4283 : 2283);
    EXPECT_LE(cost(outcome.plan->paths[AgentId(first)]), 2282);
  }
  agents[0].deadline = agents[1].deadline = Ticks{2282};
  const SolveOutcome outcome = answer(Instance::make(map, agents).value());
  EXPECT_EQ(outcome.status, Status::infeasible) << outcome.explanation;
  agents[1].deadline = Ticks{2283};
  EXPECT_EQ(least(map, agents), is_sum() ? 4283 : 2283);
  // Alone it is too late.
  agents[0].deadline = Ticks{1999};
  EXPECT_EQ(Instance::make(map, agents).error().code, ErrorCode::no_plan);
}

TEST_P(FleetRules, WhoLeavesMakesRoom) {
  // On a line, one after the other, to the same goal and beyond.
  const auto map = roadmap({{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}}, {{0, 1}, {1, 2}, {2, 3}});
  std::vector<Agent> agents{agent(1, 2, 100), agent(0, 3, 100)};
  const Instance blocked = Instance::make(map, agents).value();
  EXPECT_EQ(answer(blocked).status, Status::infeasible);
  agents[0].leaves = true;
  EXPECT_EQ(least(map, agents), is_sum() ? 4000 : 3000);
  agents[1].goals = VertexId(2);
  EXPECT_EQ(least(map, agents), is_sum() ? 3000 : 2000);
  // Until it has left it is in the way.
  agents[0].release = 5000;
  EXPECT_EQ(least(map, agents), is_sum() ? 6000 + 6200 : 6200);
}

TEST_P(FleetRules, ObstaclesAreAvoided) {
  // A road of two moves that an obstacle crosses in its middle, from above, from tick 500 on.
  const auto map = roadmap({{0, 0}, {1000, 0}, {2000, 0}}, {{0, 1}, {1, 2}});
  const std::vector<Agent> agents{agent(0, 2, 100)};
  const auto least_with = [&](MovingObstacle obstacle) {
    return least_cost(
        Instance::make(map, agents, kDefaultResolution, {}, {std::move(obstacle)}).value(),
        system(), objective());
  };
  MovingObstacle crossing{Disc{100}, {{{1000, 500}, 500, 500}, {{1000, -500}, 1500, 1500}}, true};
  // Both would be at vertex 1 at tick 1000. One is 283 behind the other; the obstacle is not.
  EXPECT_EQ(least_with(crossing), 2283);
  crossing.leaves = false;  // below the road
  EXPECT_EQ(least_with(crossing), 2283);
  // It comes earlier: it is past.
  crossing.path = {{{1000, 500}, 0, 0}, {{1000, -500}, 700, 700}};
  EXPECT_EQ(least_with(crossing), 2000);
  // It stands on the road for a while.
  crossing = {Disc{100}, {{{1000, 0}, 100, 3000}}, true};
  EXPECT_EQ(least_with(crossing), 4200);
  // For ever: then there is no plan.
  crossing.leaves = false;
  const Instance blocked = Instance::make(map, agents, kDefaultResolution, {}, {crossing}).value();
  EXPECT_EQ(answer(blocked).status, Status::infeasible);
  EXPECT_EQ(answer(blocked).explanation,
            "agent 0 cannot get past the moving obstacles, even without other agents");
  EXPECT_EQ(answer(blocked).blocked, std::vector<AgentId>{AgentId(0)});
  // It leaves, but too late for the agent's deadline.
  crossing.leaves = true;
  std::vector<Agent> hurried = agents;
  hurried[0].deadline = Ticks{4199};
  const SolveOutcome late =
      answer(Instance::make(map, hurried, kDefaultResolution, {}, {crossing}).value());
  EXPECT_EQ(late.status, Status::infeasible);
  EXPECT_EQ(late.explanation,
            "agent 0 cannot get past the moving obstacles by its deadline, even without other "
            "agents");
  crossing.path = {{{150, 0}, 0, 50}};
  EXPECT_EQ(Instance::make(map, agents, kDefaultResolution, {}, {crossing}).error().code,
            ErrorCode::no_plan);
}

TEST_P(FleetRules, WhoMustLeaveBeforeAnObstacleMayLeaveAtTheLastTick) {
  // Agent 0 is released when the obstacle behind it, just as fast, is 200 away: it touches, and
  // agent 1, which crosses the road ahead, has to wait for it.
  const auto map = roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 1000}, {1000, -1000}},
                           {{0, 1}, {1, 2}, {3, 1}, {1, 4}});
  const MovingObstacle behind{Disc{100}, {{{-1000, 0}, 0, 0}, {{0, 0}, 1000, 1000}}};
  std::vector<Agent> agents{agent(0, 2, 100), agent(3, 4, 100)};
  agents[0].release = agents[1].release = 800;
  const auto instance = [&] {
    return Instance::make(map, agents, kDefaultResolution, {}, {behind}).value();
  };
  EXPECT_EQ(least_cost(instance(), system(), objective()), is_sum() ? 5883 : 3083);
  agents[0].release = 801;
  EXPECT_EQ(answer(instance()).status, Status::infeasible);
}

TEST_P(FleetRules, MovesInProgressAreFinished) {
  // Agent 0 is 300 before vertex 1, and goes on there. Agent 1 wants to pass vertex 1 as early as
  // it can, at tick 300: it comes 283 later, or earlier, which the other one cannot wait for.
  const auto map = std::make_shared<const Roadmap>(
      Roadmap::make({{700, 0}, {1000, 0}, {2000, 0}, {1000, 300}, {1000, -1000}},
                    {{VertexId(0), VertexId(1), Ticks{300}},
                     {VertexId(1), VertexId(2), std::nullopt},
                     {VertexId(3), VertexId(1), std::nullopt},
                     {VertexId(1), VertexId(4), std::nullopt}})
          .value());
  std::vector<Agent> agents{agent(0, 2, 100), agent(3, 4, 100)};
  EXPECT_EQ(least(map, agents), is_sum() ? 2600 + 283 : 1583);
  agents[0].under_way = true;
  EXPECT_EQ(least(map, agents), is_sum() ? 2600 + 283 : 1583);
  // Somebody has to wait until tick 5000 in its way: before vertex 1 it cannot.
  agents[1].start = VertexId(1);
  agents[1].release = 5000;
  EXPECT_EQ(answer(Instance::make(map, agents).value()).status, Status::infeasible);
  agents[0].under_way = false;
  EXPECT_EQ(answer(Instance::make(map, agents).value()).status, Status::optimal);
  // A place of its own, from which it goes on.
  agents = {agent(1, 2, 100)};
  agents[0].under_way = true;
  EXPECT_EQ(Instance::make(map, agents).error().code, ErrorCode::invalid_instance);
  agents[0] = agent(0, 2, 100);
  agents[0].under_way = true;
  agents[0].release = 1;
  EXPECT_EQ(Instance::make(map, agents).error().code, ErrorCode::invalid_instance);
  agents[0].release = 0;
  const Instance instance = Instance::make(map, agents).value();
  const auto kinds = [&](Ticks wait) {
    const Plan plan{
        IdVector<AgentId, Path>(std::vector<Path>{{{VertexId(0), 0, wait},
                                                   {VertexId(1), wait + 300, wait + 400},
                                                   {VertexId(2), wait + 1400, wait + 1400}}})};
    std::vector<Violation::Kind> found;
    for (const Violation& violation : verify(instance, plan).violations)
      found.push_back(violation.kind);
    return found;
  };
  EXPECT_EQ(kinds(0), std::vector<Violation::Kind>{});
  EXPECT_EQ(kinds(1), std::vector<Violation::Kind>{Violation::Kind::waits});
}

TEST_P(FleetRules, AgreeWithTheOracle) {
  const auto count = static_cast<std::uint32_t>(support::scaled(80));
  const std::uint32_t part = 2 * static_cast<std::uint32_t>(!is_sum()) +
                             static_cast<std::uint32_t>(system() == System::smt_cbs);
  const std::uint32_t first = 50'000'000 + part * 1'000'000;
  constexpr std::size_t max_moves = 4;
  Tally tally;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    RandomOptions random;
    random.num_agents = 2 + seed % 2;
    random.num_vertices = 4 + seed / 2 % 4;
    random.edge_percent = 30 + static_cast<int>(seed / 8 % 3) * 15;
    random.groups_percent = 40;
    random.release_percent = 60;
    random.deadline_percent = 60;
    random.leaves_percent = 50;
    random.obstacles_percent = 40;
    random.under_way_percent = seed % 4 < 2 ? 0 : 90;
    const Instance instance = random_instance(seed, random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const OrderSearch oracle = search_orders(instance, objective(), max_moves);
    for (const Plan& plan : oracle.some_plans) ASSERT_TRUE(verify(instance, plan).valid());
    SolveOptions options;
    options.objective = objective();
    options.system = system();
    options.limits.conflicts = 3000;
    options.limits.cpu_s = oracle.best ? 2 : 0.1;
    options.debug.audit = true;
    // Most of them without the joint search, which needs no other one.
    if (seed % 3 != 0) options.joint_work = 0;
    if (seed % 4 == 0) options.route_work = 0;
    check_against(oracle, max_moves, instance, options, tally);
    if (HasFatalFailure()) return;
  }
  record(tally);
  if (count < 80) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(tally.solvable, 15);
  EXPECT_GE(10 * tally.optimal, 8 * tally.solvable);
  EXPECT_GE(tally.infeasible, 3);
}

INSTANTIATE_TEST_SUITE_P(All, FleetRules, all_asked(), name_of);

}  // namespace
}  // namespace quadrille::continuous::test
