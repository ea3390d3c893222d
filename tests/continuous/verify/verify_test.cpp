// SPDX-License-Identifier: MIT
#include "quadrille/continuous/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuous/support/roads.hpp"
#include "quadrille/continuous/solver.hpp"

namespace quadrille::continuous {
namespace {

using Kind = Violation::Kind;

/// Two agents of the given radii on two crossing roads: 0 -> 1 along x and 2 -> 3 along y.
Instance crossing(Length radius_a, Length radius_b) {
  auto roadmap = Roadmap::make(
      {{-100, 0}, {100, 0}, {0, -100}, {0, 100}},
      {{VertexId(0), VertexId(1), std::nullopt}, {VertexId(2), VertexId(3), std::nullopt}});
  return Instance::make(std::make_shared<const Roadmap>(std::move(roadmap).value()),
                        {{VertexId(0), VertexId(1), Disc{radius_a}, kUnitSpeed},
                         {VertexId(2), VertexId(3), Disc{radius_b}, kUnitSpeed}})
      .value();
}

Plan crossing_plan(Ticks first, Ticks second) {
  const auto path = [](std::size_t from, std::size_t to, Ticks depart) {
    return Path{{VertexId(from), 0, depart}, {VertexId(to), depart + 200, depart + 200}};
  };
  Plan plan;
  plan.paths.push_back(path(0, 1, first));
  plan.paths.push_back(path(2, 3, second));
  return plan;
}

std::vector<Kind> kinds(const VerifyReport& report) {
  std::vector<Kind> all;
  for (const Violation& v : report.violations) all.push_back(v.kind);
  return all;
}

TEST(ContinuousVerify, ReportsCostsAndClearance) {
  const auto report = verify(crossing(10, 10), crossing_plan(0, 100));
  EXPECT_TRUE(report.valid());
  EXPECT_EQ(report.sum_of_costs, 500);
  EXPECT_EQ(report.makespan, 300);
  ASSERT_EQ(report.clearances.size(), 1u);
  // One is 100 ahead when the other crosses; nearest at 100 / sqrt(2).
  EXPECT_NEAR(report.clearances[0].gap, 100 / std::sqrt(2) - 20, 1e-9);
  EXPECT_NEAR(report.clearances[0].tick, 150, 1e-9);
}

TEST(ContinuousVerify, TouchingIsAllowedAndOneUnitLessIsNot) {
  // A follower 100 ticks behind on the same road keeps 100 units away.
  auto roadmap = Roadmap::make({{0, 0}, {1000, 0}, {2000, 0}, {3000, 0}},
                               {{VertexId(0), VertexId(1), std::nullopt},
                                {VertexId(1), VertexId(2), std::nullopt},
                                {VertexId(2), VertexId(3), std::nullopt}});
  const auto shared = std::make_shared<const Roadmap>(std::move(roadmap).value());
  for (const Length radius : {Length{500}, Length{501}}) {
    const auto instance =
        Instance::make(shared, {{VertexId(0), VertexId(2), Disc{500}, kUnitSpeed},
                                {VertexId(1), VertexId(3), Disc{radius}, kUnitSpeed}});
    if (radius == 501) {  // the starts overlap already
      EXPECT_FALSE(instance);
      continue;
    }
    Plan plan;
    plan.paths.push_back(
        {{VertexId(0), 0, 0}, {VertexId(1), 1000, 1000}, {VertexId(2), 2000, 2000}});
    plan.paths.push_back(
        {{VertexId(1), 0, 0}, {VertexId(2), 1000, 1000}, {VertexId(3), 2000, 2000}});
    const auto report = verify(*instance, plan);
    EXPECT_TRUE(report.valid());
    EXPECT_EQ(report.clearances[0].gap, 0);
    plan.paths[AgentId(1)] = {
        {VertexId(1), 0, 1}, {VertexId(2), 1001, 1001}, {VertexId(3), 2001, 2001}};
    EXPECT_EQ(kinds(verify(*instance, plan)), std::vector<Kind>{Kind::collision});
  }
}

TEST(ContinuousVerify, PassingInTouchIsAllowedInTheMiddleOfAMoveToo) {
  // The second agent stands 600 beside the middle of a long oblique road: along (3, 4), off (4,
  // -3).
  auto roadmap = Roadmap::make({{0, 0}, {6000, 8000}, {3000 + 480, 4000 - 360}},
                               {{VertexId(0), VertexId(1), std::nullopt}});
  const auto shared = std::make_shared<const Roadmap>(std::move(roadmap).value());
  for (const Length radius : {Length{300}, Length{301}}) {
    const auto instance =
        Instance::make(shared, {{VertexId(0), VertexId(1), Disc{radius}, kUnitSpeed},
                                {VertexId(2), VertexId(2), Disc{300}, kUnitSpeed}})
            .value();
    Plan plan;
    plan.paths.push_back({{VertexId(0), 0, 0}, {VertexId(1), 10000, 10000}});
    plan.paths.push_back({{VertexId(2), 0, 0}});
    const auto report = verify(instance, plan);
    EXPECT_EQ(report.valid(), radius == 300);
    EXPECT_NEAR(report.clearances[0].gap, 300 - static_cast<double>(radius.value()), 1e-9);
    EXPECT_NEAR(report.clearances[0].tick, 5000, 1e-6);
    if (report.valid()) continue;
    EXPECT_EQ(report.violations[0].message,
              "agents 0 and 1 collide between times 0.004965 and 0.005035: nearest at about 0.005, "
              "while agent "
              "0 moves from vertex 0 to vertex 1 and agent 1 stands at vertex 2, at most 1.5e-06 "
              "too close");
  }
}

TEST(ContinuousVerify, CrossingIsDecidedExactly) {
  // At right angles with equal speeds the distance is offset / sqrt(2): reach 99 needs 141 ticks
  // (99 * sqrt(2) = 140.007...).
  const Instance instance = crossing(49, 50);
  EXPECT_TRUE(verify(instance, crossing_plan(0, 141)).valid());
  const auto report = verify(instance, crossing_plan(0, 140));
  ASSERT_EQ(kinds(report), std::vector<Kind>{Kind::collision});
  EXPECT_EQ(report.violations[0].agent, AgentId(0));
  EXPECT_EQ(report.violations[0].other, AgentId(1));
  // They overlap for less than two ticks, around 170.
  EXPECT_EQ(report.violations[0].tick, Ticks{169});
}

TEST(ContinuousVerify, GoalStaysLastForEver) {
  auto roadmap = Roadmap::make({{0, 0}, {100, 0}, {200, 0}, {100, 100}},
                               {{VertexId(0), VertexId(1), std::nullopt},
                                {VertexId(1), VertexId(2), std::nullopt},
                                {VertexId(3), VertexId(1), std::nullopt}});
  const auto instance = Instance::make(std::make_shared<const Roadmap>(std::move(roadmap).value()),
                                       {{VertexId(0), VertexId(2), Disc{10}, kUnitSpeed},
                                        {VertexId(3), VertexId(1), Disc{10}, kUnitSpeed}})
                            .value();
  Plan plan;
  plan.paths.push_back(
      {{VertexId(0), 0, 5000}, {VertexId(1), 5100, 5100}, {VertexId(2), 5200, 5200}});
  plan.paths.push_back({{VertexId(3), 0, 0}, {VertexId(1), 100, 100}});
  EXPECT_EQ(kinds(verify(instance, plan)), std::vector<Kind>{Kind::collision});
  plan.paths[AgentId(1)] = {{VertexId(3), 0, 6000}, {VertexId(1), 6100, 6100}};
  EXPECT_TRUE(verify(instance, plan).valid());
}

TEST(ContinuousVerify, NamesEachBrokenRule) {
  const Instance instance = crossing(10, 10);
  const auto with_first_path = [&](Path path) {
    Plan plan = crossing_plan(0, 500);
    plan.paths[AgentId(0)] = std::move(path);
    return kinds(verify(instance, plan));
  };
  const auto v = [](std::size_t id) { return VertexId(id); };
  using Kinds = std::vector<Kind>;
  EXPECT_EQ(with_first_path({}), Kinds{Kind::empty_path});
  EXPECT_EQ(with_first_path({{v(0), 0, 0}, {v(9), 200, 200}}), Kinds{Kind::bad_vertex});
  EXPECT_EQ(with_first_path({{v(0), 1, 1}, {v(1), 201, 201}}), Kinds{Kind::bad_time});
  EXPECT_EQ(with_first_path({{v(0), 0, -1}, {v(1), 199, 199}}), Kinds{Kind::bad_time});
  EXPECT_EQ(with_first_path({{v(0), 0, 0}, {v(1), 200, 201}}), Kinds{Kind::bad_time});
  EXPECT_EQ(with_first_path({{v(0), 0, 0}, {v(1), 199, 199}}), Kinds{Kind::duration});
  EXPECT_EQ(with_first_path({{v(0), 0, 0}, {v(3), 200, 200}}),
            (Kinds{Kind::wrong_goal, Kind::not_adjacent}));
  EXPECT_EQ(with_first_path({{v(1), 0, 0}}), Kinds{Kind::wrong_start});
  EXPECT_EQ(with_first_path({{v(0), 0, 0}}), Kinds{Kind::wrong_goal});
  Plan short_plan;
  EXPECT_EQ(kinds(verify(instance, short_plan)), Kinds{Kind::path_count});
}

TEST(ContinuousVerify, EdgesThatAreNotOpenAreRefused) {
  const Groups only_two{GroupId(2)};
  for (const bool has_way_for_all : {false, true}) {
    std::vector<Edge> edges{{VertexId(0), VertexId(1), Ticks{100}, only_two},
                            {VertexId(0), VertexId(2), std::nullopt},
                            {VertexId(2), VertexId(1), std::nullopt}};
    if (has_way_for_all) edges.push_back({VertexId(0), VertexId(1), Ticks{130}});
    const auto roadmap = std::make_shared<const Roadmap>(
        Roadmap::make({{0, 0}, {100, 0}, {50, 50}}, std::move(edges)).value());
    for (const std::size_t group : {0U, 2U}) {
      Agent agent{VertexId(0), VertexId(1), Disc{10}, kUnitSpeed};
      agent.group = GroupId(group);
      const Instance instance = Instance::make(roadmap, {agent}).value();
      Plan plan;
      plan.paths.push_back({{VertexId(0), 0, 0}, {VertexId(1), 100, 100}});
      std::vector<Kind> expected;
      if (group == 0) expected = {has_way_for_all ? Kind::duration : Kind::closed_edge};
      EXPECT_EQ(kinds(verify(instance, plan)), expected);
      plan.paths[AgentId(0)][1] = {VertexId(1), 130, 130};
      EXPECT_EQ(verify(instance, plan).valid(), has_way_for_all) << group;
    }
  }
}

TEST(ContinuousVerify, NobodySetsOutBeforeItsRelease) {
  Instance instance = crossing(10, 10);
  std::vector<Agent> agents = instance.agents().items();
  agents[0].release = 300;
  instance = Instance::make(instance.shared_roadmap(), agents).value();
  EXPECT_EQ(kinds(verify(instance, crossing_plan(299, 0))), std::vector<Kind>{Kind::too_early});
  const auto report = verify(instance, crossing_plan(300, 0));
  EXPECT_TRUE(report.valid());
  EXPECT_EQ(report.sum_of_costs, 700);  // from tick 0 on
}

TEST(ContinuousVerify, ArrivalsAfterTheDeadlineAreRefused) {
  Instance instance = crossing(10, 10);
  std::vector<Agent> agents = instance.agents().items();
  agents[1].deadline = Ticks{700};
  instance = Instance::make(instance.shared_roadmap(), agents).value();
  EXPECT_TRUE(verify(instance, crossing_plan(900, 500)).valid());
  EXPECT_EQ(kinds(verify(instance, crossing_plan(900, 501))), std::vector<Kind>{Kind::too_late});
}

TEST(ContinuousVerify, WhoLeavesIsInNobodysWayAfterwards) {
  // Both go to vertex 1, the second one from the other side, and need 200 ticks.
  const auto roadmap = test::roadmap({{0, 0}, {200, 0}, {400, 0}}, {{0, 1}, {2, 1}});
  std::vector<Agent> agents{test::agent(0, 1, 10), test::agent(2, 1, 10)};
  EXPECT_EQ(Instance::make(roadmap, agents).error().code, ErrorCode::no_plan);
  agents[0].leaves = true;
  const Instance instance = Instance::make(roadmap, agents).value();
  const auto both = [](Ticks first, Ticks second) {
    Plan plan;
    plan.paths.push_back({{VertexId(0), 0, first}, {VertexId(1), first + 200, first + 200}});
    plan.paths.push_back({{VertexId(2), 0, second}, {VertexId(1), second + 200, second + 200}});
    return plan;
  };
  // The first one has to be gone when the other one is 20 away.
  EXPECT_TRUE(verify(instance, both(0, 20)).valid());
  EXPECT_EQ(kinds(verify(instance, both(0, 19))), std::vector<Kind>{Kind::collision});
  EXPECT_EQ(kinds(verify(instance, both(300, 0))), std::vector<Kind>{Kind::collision});
  // Who leaves where it starts is nowhere for no time at all.
  agents[0] = test::agent(0, 0, 10);
  agents[0].leaves = true;
  const Instance gone = Instance::make(roadmap, agents).value();
  Plan empty = both(0, 0);
  empty.paths[AgentId(0)] = {{VertexId(0), 0, 0}};
  EXPECT_TRUE(verify(gone, empty).valid());
  EXPECT_TRUE(verify(gone, empty).clearances.empty());
}

TEST(ContinuousVerify, WhoLeavesWhenAnObstacleAppearsThereHasHitIt) {
  const auto roadmap = test::roadmap({{0, 0}, {200, 0}}, {{0, 1}});
  Agent agent = test::agent(0, 1, 10);
  agent.leaves = true;
  const auto instance = [&](Ticks appears, Length beside) {
    const MovingObstacle obstacle{Disc{10}, {{{200, beside}, appears, 900}}, true};
    return Instance::make(roadmap, {agent}, kDefaultResolution, {}, {obstacle}).value();
  };
  Plan plan;
  plan.paths.push_back({{VertexId(0), 0, 0}, {VertexId(1), 200, 200}});
  EXPECT_EQ(kinds(verify(instance(199, 0), plan)), std::vector<Kind>{Kind::obstacle});
  EXPECT_EQ(kinds(verify(instance(200, 0), plan)), std::vector<Kind>{Kind::obstacle});
  EXPECT_EQ(kinds(verify(instance(200, 19), plan)), std::vector<Kind>{Kind::obstacle});
  EXPECT_TRUE(verify(instance(200, 20), plan).valid());
  EXPECT_TRUE(verify(instance(201, 0), plan).valid());
  // The solver agrees.
  EXPECT_EQ(*solve(instance(200, 20), {})->cost, 200);
  EXPECT_EQ(*solve(instance(201, 0), {})->cost, 200);
  EXPECT_GT(*solve(instance(200, 19), {})->cost, 900);
}

TEST(ContinuousVerify, ObstaclesAreHitExactly) {
  // One that crosses the first agent's road at right angles, as fast, where it is at tick 100, and
  // one that comes from nowhere later and stays there.
  const Instance agents = crossing(10, 10);
  const auto with = [&](MovingObstacle obstacle) {
    return Instance::make(agents.shared_roadmap(), agents.agents().items(), kDefaultResolution, {},
                          {std::move(obstacle)})
        .value();
  };
  const auto kinds_of = [](const Instance& instance, Ticks first) {
    return kinds(verify(instance, crossing_plan(first, 2000)));
  };
  using Kinds = std::vector<Kind>;
  // Reach 20 needs 29 ticks: 20 * sqrt(2) = 28.3.
  const Instance crossed = with({Disc{10}, {{{0, -80}, 1020, 1020}, {{0, 80}, 1180, 1180}}, true});
  EXPECT_EQ(kinds_of(crossed, 1000), Kinds{Kind::obstacle});
  EXPECT_EQ(kinds_of(crossed, 1028), Kinds{Kind::obstacle});
  EXPECT_EQ(kinds_of(crossed, 1029), Kinds{});
  EXPECT_EQ(kinds_of(crossed, 972), Kinds{Kind::obstacle});
  EXPECT_EQ(kinds_of(crossed, 971), Kinds{});
  // The agent passes it at 80 after the begin of its move, until 120.
  const Instance stood = with({Disc{10}, {{{0, 0}, 1000, 1100}}, true});
  EXPECT_EQ(kinds_of(stood, 880), Kinds{});
  EXPECT_EQ(kinds_of(stood, 881), Kinds{Kind::obstacle});
  EXPECT_EQ(kinds_of(stood, 1019), Kinds{Kind::obstacle});
  EXPECT_EQ(kinds_of(stood, 1020), Kinds{});
  const Instance blocked = with({Disc{10}, {{{0, 0}, 1000, 1100}}, false});
  EXPECT_EQ(kinds_of(blocked, 880).size(), 1u);  // the other agent, which comes later
  EXPECT_EQ(kinds_of(blocked, 1020), (Kinds{Kind::obstacle, Kind::obstacle}));
  // At the goal, for ever.
  const Instance at_goal = with({Disc{10}, {{{100, 0}, 9000, 9000}}, false});
  EXPECT_EQ(kinds_of(at_goal, 0), Kinds{Kind::obstacle});
  const Instance gone = with({Disc{10}, {{{100, 0}, 0, 50}}, true});
  EXPECT_EQ(kinds_of(gone, 0), Kinds{});
}

TEST(Verify, SumsOfCostsThatDoNotFitAreRefused) {
  constexpr Ticks kLate = kMaxTick;
  for (const std::size_t num_agents : {7U, 8U, 9U}) {
    std::vector<Point> points;
    std::vector<Agent> agents;
    test::Roads roads;
    Plan plan;
    for (std::size_t i = 0; i < num_agents; ++i) {
      const Length y(100 * static_cast<std::int64_t>(i));
      points.push_back({0, y});
      points.push_back({100, y});
      roads.emplace_back(2 * i, 2 * i + 1);
      agents.push_back(test::agent(2 * i, 2 * i + 1, 10));
      plan.paths.push_back(
          {{VertexId(2 * i), 0, kLate - 100}, {VertexId(2 * i + 1), kLate, kLate}});
    }
    const Instance instance = Instance::make(test::roadmap(points, roads), agents).value();
    const VerifyReport report = verify(instance, plan);
    EXPECT_EQ(report.makespan, as_cost(kLate));
    // 2^63 is one more than the largest sum.
    EXPECT_EQ(report.valid(), num_agents < 8) << num_agents;
    EXPECT_GT(report.sum_of_costs, 0);
  }
}

}  // namespace
}  // namespace quadrille::continuous
