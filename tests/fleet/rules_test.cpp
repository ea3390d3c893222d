// SPDX-License-Identifier: MIT
//
// What fleets need: reserved lanes, releases, deadlines, robots that leave, moving obstacles, and
// plans to begin with. That the layer below keeps the rules is tested there; here, that they
// arrive.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fleet/support.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/fleet/solver.hpp"
#include "quadrille/fleet/verify.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

const VertexId kA(0), kB(1), kC(2), kD(3);

RobotSpec disc(std::string name) {
  return {.name = std::move(name), .body = Disc(0.2_m), .speed = 1_mps};
}

SolveOptions within_5_s() {
  SolveOptions options;
  options.limits.wall = 5_s;
  return options;
}

TEST(FleetRules, LanesForSomeAreNotTakenByOthers) {
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(0_m, 0_m), b = roads.vertex(1_m, 0_m);
  const VertexId around = roads.vertex(0.5_m, 1.2_m);
  const Group small = roads.group(), wide = roads.group();
  roads.road(a, b, {.only = {small}}).road(a, around).road(around, b);
  const Roadmap built = roads.build().value();
  EXPECT_EQ(built.num_groups(), 2U);
  const auto cost = [&](std::optional<Group> group) {
    Fleet fleet(built);
    RobotSpec spec = disc("p");
    spec.group = group;
    fleet.robot(spec).from(a).to(b);
    return solve(fleet).value().cost.value();
  };
  EXPECT_EQ(cost(small), 1_s);
  EXPECT_EQ(cost(wide), 2.6_s);
  EXPECT_EQ(cost(std::nullopt), 2.6_s);
}

TEST(FleetRules, GroupsHaveToExistAndLanesToBeClear) {
  RoadmapBuilder roads;
  roads.vertex(0_m, 0_m, "a");
  roads.vertex(1_m, 0_m, "b");
  const Group small = roads.group();
  RoadmapBuilder other = roads, twice = roads;
  const Group unknown = other.group();
  EXPECT_EQ(roads.lane(kA, kB, {.only = {unknown}}).build().error().message,
            "a lane from 'a' to 'b': it is for a group that this builder has not made");
  twice.lane(kA, kB, {.only = {small}}).lane(kA, kB, {.only = {small}});
  EXPECT_EQ(twice.build().value().num_lanes(), 1U);
  EXPECT_EQ(twice.lane(kA, kB).build().error().message,
            "a lane from 'a' to 'b': it is given twice, to different groups");
  EXPECT_EQ(twice.close(kA, kB).lane(kA, kB).build().value().num_lanes(), 1U);
  Fleet fleet(twice.build().value());
  RobotSpec spec = disc("p");
  spec.group = unknown;
  fleet.robot(spec).from(kA).to(kB);
  EXPECT_EQ(fleet.instance().error().message, "'p' is of a group that the roadmap does not have");
  for (int i = 0; i < 62; ++i) static_cast<void>(twice.group());
  EXPECT_TRUE(twice.build().has_value());
  static_cast<void>(twice.group());
  EXPECT_EQ(twice.build().error().code, ErrorCode::out_of_range);
}

TEST(FleetRules, KindsGoAsFastAsTheyMay) {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(2_m, 0_m, "b");
  const Group slow = roads.group(), fast = roads.group();
  const RoadmapBuilder empty = roads;
  const auto cost = [&](const LaneSpec& spec, std::optional<Group> group) {
    RoadmapBuilder builder = empty;
    Fleet fleet(builder.lane(a, b, spec).build().value());
    RobotSpec robot = disc("p");
    robot.group = group;
    fleet.robot(robot).from(a).to(b);
    return solve(fleet).value().cost.value();
  };
  EXPECT_EQ(cost({.speed_limit = 0.5_mps}, std::nullopt), 4_s);
  EXPECT_EQ(cost({.speed_limit = 3_mps}, std::nullopt), 2_s);
  EXPECT_EQ(cost({.duration = 3.14_s}, slow), 3.2_s);
  const LaneSpec own{.speed_limit = 0.5_mps,
                     .kinds = {{.group = slow, .speed_limit = 0.25_mps}, {.group = fast}}};
  EXPECT_EQ(cost(own, std::nullopt), 4_s);
  EXPECT_EQ(cost(own, slow), 8_s);
  EXPECT_EQ(cost(own, fast), 2_s);
  const auto refuses = [&](const LaneSpec& spec, const std::string& why) {
    RoadmapBuilder builder = empty;
    EXPECT_EQ(builder.lane(a, b, spec).build().error().message, "a lane from 'a' to 'b': " + why);
  };
  refuses({.speed_limit = 1_mps, .duration = 1_s}, "it has a duration and a speed limit");
  refuses({.speed_limit = 0_mps},
          "a speed limit of 0 m/s is not supported at a resolution of 0.001 m and 0.1 s");
  refuses({.duration = -1_s},
          "a duration of -1 s is not supported at a resolution of 0.001 m and "
          "0.1 s");
  const std::string twice =
      "it has a limit or a duration for a group that may not use it, or two for one group";
  refuses({.only = {fast}, .kinds = {{.group = slow}}}, twice);
  refuses({.kinds = {{.group = slow}, {.group = slow}}}, twice);
  RoadmapBuilder builder = empty;
  builder.lane(a, b, own).lane(a, b, own);
  EXPECT_EQ(builder.build().value().num_lanes(), 3U);
  EXPECT_EQ(builder.lane(a, b, {.speed_limit = 0.5_mps}).build().error().message,
            "a lane from 'a' to 'b': it is given twice, in different ways");
}

TEST(FleetRules, NobodyWaitsWhereNobodyMay) {
  // 'p' comes to a crossing, and 'q' does, from another side, when it may set out at all.
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(0_m, 0_m, "a"), x = roads.vertex(1_m, 0_m, "x");
  const VertexId b = roads.vertex(2_m, 0_m, "b"), c = roads.vertex(1_m, -1_m, "c");
  roads.road(a, x).road(x, b).road(c, x);
  const RoadmapBuilder empty = roads;
  Fleet fleet(roads.no_waiting(x).build().value());
  const Robot p = fleet.robot(disc("p")).from(a).to(b);
  const SolveOutcome outcome = solve(fleet).value();
  EXPECT_EQ(outcome.cost, 2_s);
  continuous::Plan plan = outcome.plan->in_units();
  continuous::Path& path = plan.paths[p];
  ASSERT_EQ(path.size(), 3U);
  path[1].depart += 5;
  path[2].arrive += 5;
  path[2].depart += 5;
  const VerifyReport report = verify(fleet, plan).value();
  ASSERT_EQ(report.violations.size(), 1U);
  EXPECT_EQ(report.violations[0].message, "'p' waits where nobody may, from 1 s on");
  p.to(x);
  EXPECT_EQ(fleet.instance().error().message, "'p' would stay at x, where nobody may wait");
  p.from(x).to(b);
  EXPECT_EQ(fleet.instance().error().message, "'p' starts at x, where nobody may wait");
  RoadmapBuilder twice = empty, unknown = empty;
  EXPECT_EQ(twice.no_waiting(x).no_waiting(x).build().error().message,
            "nobody may wait at 'x': that is told twice");
  EXPECT_EQ(unknown.no_waiting(VertexId(4)).build().error().message,
            "nobody may wait at vertex 4: there are only 4 vertices");
}

TEST(FleetRules, ReleasesAreRoundedUpAndDeadlinesDown) {
  Fleet fleet(test::line(3, {.length = 1_mm, .time = 100_ms}));
  const Robot robot = fleet.robot(disc("p")).from(kA).to(kC);
  EXPECT_EQ(fleet.instance().value().agent(robot).deadline, std::nullopt);
  robot.release(0.31_s).deadline(2.49_s).leaves();
  const continuous::Agent agent = fleet.instance().value().agent(robot);
  EXPECT_EQ(agent.release, continuous::Ticks{4});
  EXPECT_EQ(agent.deadline, continuous::Ticks{24});
  EXPECT_TRUE(agent.leaves);
  EXPECT_EQ(solve(fleet).value().cost, 2.4_s);
  // What is meant to be a multiple is one.
  robot.release(3 * 0.1_s).deadline(24 * 0.1_s).leaves(false);
  EXPECT_EQ(fleet.instance().value().agent(robot).release, continuous::Ticks{3});
  EXPECT_EQ(fleet.instance().value().agent(robot).deadline, continuous::Ticks{24});
  EXPECT_FALSE(fleet.leaves(robot));
  robot.release(0.41_s);
  EXPECT_EQ(solve(fleet).value().summary(),
            "infeasible: 'p' cannot arrive before 2.5 s, and its deadline is 2.4 s");
  robot.deadline(std::nullopt);
  EXPECT_EQ(solve(fleet).value().cost, 2.5_s);
  robot.release(-1_s);
  EXPECT_EQ(solve(fleet).error().message,
            "'p' is released at -1 s, which is negative, or too late");
  robot.release(0_s).deadline(-1_s);
  EXPECT_EQ(solve(fleet).error().code, ErrorCode::out_of_range);
}

TEST(FleetRules, WhoLeavesMakesRoom) {
  Fleet fleet(test::line(4));
  const Robot first = fleet.robot(disc("p")).from(kB).to(kC);
  const Robot second = fleet.robot(disc("q")).from(kA).to(kD);
  EXPECT_EQ(solve(fleet).value().status, Status::infeasible);
  first.leaves();
  EXPECT_EQ(solve(fleet).value().cost, 4_s);
  second.to(kC);
  EXPECT_EQ(solve(fleet).value().cost, 3_s);
  first.leaves(false);
  EXPECT_EQ(solve(fleet).value().summary(),
            "infeasible: the goals of 'p' at c and 'q' at c overlap");
}

TEST(FleetRules, ObstaclesAreAvoided) {
  Fleet fleet(test::line(3));
  fleet.robot(disc("p")).from(kA).to(kC);
  MovingObstacle cart{"cart", Disc(0.2_m), {{{1_m, 0_m}, 0.1_s, 3_s}}, true};
  fleet.obstacle(cart);
  EXPECT_EQ(solve(fleet).value().cost, 4.4_s);
  fleet.clear_obstacles();
  cart.path[0].place = {0.3_m, 0_m};
  cart.path[0].arrive = 0_s;
  fleet.obstacle(cart);
  EXPECT_EQ(solve(fleet).value().summary(), "infeasible: 'cart' is at the start of 'p' at a");
  cart.leaves = false;
  cart.path = {{{1_m, 0_m}, 0.1_s, 0.1_s}};
  fleet.clear_obstacles();
  fleet.obstacle(cart);
  EXPECT_EQ(solve(fleet).value().status, Status::infeasible);
  cart.path.push_back({{1_m, 1_m}, 0.104_s, 1_s});
  cart.name.clear();
  fleet.obstacle(cart);
  EXPECT_EQ(solve(fleet).error().message,
            "'obstacle 1' has times that do not increase at a resolution of 0.01 s");
  fleet.clear_obstacles();
  fleet.obstacle({"cart", Disc(0.2_m), {}});
  EXPECT_EQ(solve(fleet).error().message, "'cart' has no stops");
  fleet.clear_obstacles();
  fleet.obstacle({"cart", Disc(0.2_m), {{{1_m, 0_m}, 0.104_s, 0.1_s}}, true});
  EXPECT_EQ(solve(fleet).error().message, "'cart' vanishes at the moment at which it appears");
}

// Each robot of one fleet, planned one after the other around those before it: together they are a
// plan of all.
TEST(FleetRules, RobotsOfAnotherFleetAreObstacles) {
  int num_solved = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(30); ++seed) {
    SCOPED_TRACE(seed);
    Fleet all = test::random_fleet(seed, 3);
    for (const AgentId i : all.robot_ids()) all[i].leaves(i.index() % 2 == 0);
    continuous::Plan together;
    std::vector<MovingObstacle> known;
    for (const AgentId i : all.robot_ids()) {
      Fleet one(all.roadmap());
      one.robot(all.spec(i)).from(*all.start(i)).to(*all.goal(i)).leaves(all.leaves(i));
      for (const MovingObstacle& obstacle : known) one.obstacle(obstacle);
      const SolveOutcome outcome = solve(one, within_5_s()).value();
      if (!outcome.plan) break;
      together.paths.push_back(outcome.plan->in_units().paths[AgentId(0)]);
      const auto obstacle = as_obstacle(one, *outcome.plan, AgentId(0));
      EXPECT_EQ(obstacle.has_value(), !all.leaves(i) || all.start(i) != all.goal(i));
      if (obstacle) known.push_back(*obstacle);
    }
    if (together.paths.size() < all.num_robots() || !all.instance()) continue;
    ++num_solved;
    const VerifyReport report = verify(all, together).value();
    EXPECT_TRUE(report.valid()) << report.violations.front().message;
  }
  EXPECT_GE(num_solved, static_cast<int>(support::scaled(30)) / 3);
}

TEST(FleetRules, MovesInProgressAreFinished) {
  Fleet fleet(test::line(3, {.length = 1_mm, .time = 10_ms}));
  const Robot robot = fleet.robot(disc("p")).from_edge(kA, kB, 0.3).to(kC);
  EXPECT_EQ(fleet.start(robot), std::nullopt);
  const SolveOutcome outcome = solve(fleet).value();
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_EQ(outcome.cost, 1.7_s);
  const TimedPath& path = (*outcome.plan)[robot];
  EXPECT_EQ(path.at(0_s), (Point{0.3_m, 0_m}));
  EXPECT_EQ(path.stops().size(), 3U);
  EXPECT_EQ(path.stops()[1].arrive, 0.7_s);
  EXPECT_EQ(fleet.place_name(path.stops()[0].vertex), "the lane from a to b");
  EXPECT_EQ(fleet.place_name(kB), "b");
  // It cannot turn, and somebody who stands in its way cannot be waited for.
  robot.to(kA);
  EXPECT_EQ(solve(fleet).value().cost, 1.7_s);
  const Robot other = fleet.robot(disc("q")).from(kB).to(kC).release(5_s);
  EXPECT_EQ(solve(fleet).value().status, Status::infeasible);
  robot.from(kA).to(kB);
  EXPECT_EQ(solve(fleet).value().status, Status::optimal);
  robot.from_edge(kA, kB, 0.9).to(kB);
  EXPECT_EQ(solve(fleet).value().summary(),
            "infeasible: the starts of 'p' at the lane from a to b and 'q' at b overlap");
  // What lies behind is rounded down; what is meant to be whole is; one step is left.
  other.from(kC);
  for (const auto& [fraction, cost] : std::vector<std::pair<double, Seconds>>{
           {0.3049, 0.7_s}, {0.31, 0.69_s}, {0.29, 0.71_s}, {0, 1_s}, {1, 0.01_s}}) {
    Fleet alone(fleet.roadmap());
    alone.robot(disc("p")).from_edge(kA, kB, fraction).to(kB);
    EXPECT_EQ(solve(alone).value().cost, cost) << fraction;
  }
  robot.from_edge(kA, kB, 1.5);
  EXPECT_EQ(solve(fleet).error().message,
            "'p' is under way with 1.5 of its move behind it, which is not from 0 to 1");
  robot.from_edge(kA, kA, 0.5);
  EXPECT_EQ(solve(fleet).error().code, ErrorCode::out_of_range);
  robot.from_edge(kA, kB, 0.5).release(1_s);
  EXPECT_EQ(solve(fleet).error().message, "'p' is under way, and cannot be released later");
}

// A plan that is cut off in the middle of its moves goes on: what is left of it is a plan of the
// robots where they are then, so that an optimal one costs no more, but for rounding.
TEST(FleetRules, WhatIsLeftOfAPlanIsAPlanOfRobotsUnderWay) {
  int num_under_way = 0, num_cut = 0, num_kept = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(40); ++seed) {
    SCOPED_TRACE(seed);
    Fleet fleet = test::random_fleet(seed, 3);
    if (!fleet.instance()) continue;
    const SolveOutcome whole = solve(fleet, within_5_s()).value();
    if (whole.status != Status::optimal) continue;
    const TimedPlan before = *whole.plan;
    const double step = fleet.roadmap().resolution().time.value();
    const Seconds now(step * std::round(0.4 * before.makespan().value() / step));
    Seconds left = 0_s;
    for (const AgentId i : before.robot_ids()) {
      const auto& stops = before[i].stops();
      const auto next = std::find_if(stops.begin(), stops.end() - 1,
                                     [&](const Stop& stop) { return stop.depart >= now; });
      left += std::max(0_s, stops.back().arrive - now);
      if (next->arrive <= now) {
        fleet[i].from(next->vertex);
        continue;
      }
      const Stop& last = *(next - 1);
      ++num_under_way;
      fleet[i].from_edge(last.vertex, next->vertex,
                         (now - last.depart) / (next->arrive - last.depart));
    }
    const SolveOutcome rest = solve(fleet, within_5_s()).value();
    ++num_cut;
    if (rest.plan) {
      EXPECT_TRUE(verify(fleet, rest.plan->in_units()).value().valid());
    }
    // Places are rounded: where bodies touch, there may be no room for that, or for a detour only.
    if (rest.status == Status::optimal && rest.cost->value() <= left.value() + 4 * step) ++num_kept;
  }
  EXPECT_GE(num_under_way, num_cut);
  EXPECT_GE(4 * num_kept, 3 * num_cut);
}

TEST(FleetRules, ViolationsAreSaidInWords) {
  Fleet fleet(test::line(3));
  const Robot robot = fleet.robot(disc("p")).from(kA).to(kC);
  const continuous::Plan plan = solve(fleet).value().plan->in_units();
  const auto complaint = [&] { return verify(fleet, plan).value().violations.at(0).message; };
  robot.release(0.5_s);
  EXPECT_EQ(complaint(), "'p' begins a move at 0 s, before its release at 0.5 s");
  robot.release(0_s);
  fleet.obstacle({"cart", Disc(0.2_m), {{{1_m, 0_m}, 0.5_s, 3_s}}, true});
  EXPECT_EQ(complaint(), "'p' and an obstacle collide at 0.6 s");
}

TEST(FleetRules, APlanToBeginWithIsHeldAgainstTheRules) {
  Fleet fleet = test::random_fleet(4, 6);
  ASSERT_TRUE(fleet.instance().has_value());
  SolveOptions options;
  options.gap_percent = 1000;
  const SolveOutcome some = solve(fleet, options).value();
  ASSERT_TRUE(some.plan.has_value());
  options = {};
  options.initial_plan = some.plan;
  options.limits.wall = 0_s;
  const SolveOutcome kept = solve(fleet, options).value();
  ASSERT_TRUE(kept.plan.has_value());
  EXPECT_EQ(kept.plan->in_units(), some.plan->in_units());
  const AgentId robot(0);
  fleet[robot].release(some.plan->makespan() + 1_s);
  const Result<SolveOutcome> refused = solve(fleet, options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_plan);
  EXPECT_EQ(refused.error().message.substr(0, 49),
            "the initial plan is none: 'robot 0' begins a move");
  Fleet coarse(test::line(2, {.length = 1_cm, .time = 1_s}));
  coarse.robot(disc("p")).from(kA).to(kB);
  EXPECT_EQ(solve(coarse, options).error().message, "the initial plan has another resolution");
}

}  // namespace
}  // namespace quadrille::fleet
