// SPDX-License-Identifier: MIT
// Robots that turn, in metres, seconds and degrees.
#include "quadrille/fleet/pose_builder.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fleet/support.hpp"
#include "quadrille/fleet/solver.hpp"
#include "support/environment.hpp"
#include "support/pose_search.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;
using quadrille::support::Random;
using quadrille::support::TurningTask;

/// An L: from a along x to b, from there along y to c; each 2 m.
RoadmapBuilder corner() {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(2_m, 0_m, "b");
  const VertexId c = roads.vertex(2_m, 2_m, "c");
  roads.road(a, b).road(b, c);
  return roads;
}
const VertexId kA(0), kB(1), kC(2);

std::vector<std::string> headings(const PoseRoadmap& poses, VertexId place) {
  std::vector<std::string> texts;
  for (const VertexId pose : poses.any_heading(place)) {
    EXPECT_EQ(poses.place(pose), place);
    texts.push_back(to_string(poses.heading(pose)));
  }
  return texts;
}

/// What one robot takes from one pose to any heading at a place; nullopt if it cannot get there.
std::optional<Seconds> cost(const PoseRoadmap& poses, VertexId start, VertexId place,
                            std::optional<Group> group = {}) {
  Fleet fleet(poses.roadmap());
  fleet.robot({.body = Disc(0.3_m), .speed = 1_mps, .group = group})
      .from(start)
      .to_any(poses.any_heading(place));
  return solve(fleet).value().cost;
}

TEST(PoseBuilder, HasTheHeadingsOfItsLanes) {
  const auto poses = PoseBuilder(corner().build().value(), 90_degps)
                         .heading(kA, degrees(-22.5))
                         .heading(kA, degrees(360))
                         .build()
                         .value();
  EXPECT_EQ(poses.num_places(), 3U);
  EXPECT_EQ(headings(poses, kA), (std::vector<std::string>{"0 deg", "180 deg", "337.5 deg"}));
  EXPECT_EQ(headings(poses, kB),
            (std::vector<std::string>{"0 deg", "90 deg", "180 deg", "270 deg"}));
  EXPECT_EQ(headings(poses, kC), (std::vector<std::string>{"90 deg", "270 deg"}));
  EXPECT_EQ(poses.heading(poses.facing(kB, 100_deg)), 90_deg);
  EXPECT_EQ(poses.heading(poses.facing(kB, degrees(-50))), 270_deg);
  EXPECT_EQ(poses.heading(poses.facing(kB, 359_deg)), 0_deg);
  const Roadmap& roadmap = poses.roadmap();
  EXPECT_EQ(roadmap.num_vertices(), 9U);
  EXPECT_EQ(roadmap.name(poses.facing(kB, 90_deg)), "b facing 90 deg");
  EXPECT_EQ(roadmap.find("a facing 337.5 deg"), poses.facing(kA, degrees(-20)));
  for (const VertexId v : roadmap.vertex_ids())
    EXPECT_EQ(roadmap.position(v), corner().build().value().position(poses.place(v)));
}

TEST(PoseBuilder, TurnsTakeAngleByRateRoundedUp) {
  PoseBuilder builder(corner().build().value(), 40_degps);
  const auto poses = builder.build().value();
  // 2 s, then 90 degrees in 2.25 s, which are 23 steps of a tenth, and 2 s.
  EXPECT_EQ(cost(poses, poses.facing(kA, 0_deg), kC), 6.3_s);
  EXPECT_EQ(cost(poses, poses.facing(kA, 0_deg), kB), 2_s);
  // Half a turn first: 4.5 s.
  EXPECT_EQ(cost(poses, poses.facing(kA, 180_deg), kB), 6.5_s);
  // Exact quotients are not rounded up.
  const auto fast = PoseBuilder(corner().build().value(), 90_degps).build().value();
  EXPECT_EQ(cost(fast, fast.facing(kA, 0_deg), kC), 5_s);
}

TEST(PoseBuilder, GroupsTurnInTheirWays) {
  RoadmapBuilder roads = corner();
  const Group slow = roads.group(), car = roads.group(), guest = roads.group();
  const VertexId d = roads.vertex(4_m, 0.5_m, "d");  // 14.04 degrees to the left of b
  roads.road(kB, d, {.only = {slow, car}});
  const auto poses = PoseBuilder(roads.build().value(), 90_degps)
                         .turn_rate(slow, 45_degps)
                         .car(car, 20_deg)
                         .build()
                         .value();
  const VertexId start = poses.facing(kA, 0_deg);
  EXPECT_EQ(cost(poses, start, kC), 5_s);
  EXPECT_EQ(cost(poses, start, kC, guest), 5_s);
  EXPECT_EQ(cost(poses, start, kC, slow), 6_s);
  EXPECT_FALSE(cost(poses, start, kC, car));
  EXPECT_FALSE(cost(poses, start, d));  // the lane is for others
  const Seconds way(2.1);               // sqrt(4.25) m, to the nearest step
  EXPECT_EQ(cost(poses, start, d, car), 2_s + way);
  EXPECT_EQ(cost(poses, start, d, slow), 2_s + 0.4_s + way);  // 0.312 s, rounded up
  // It arrives facing the way that it came, and the car does not get back.
  EXPECT_EQ(headings(poses, d), (std::vector<std::string>{"14.036243 deg", "194.036243 deg"}));
  EXPECT_FALSE(cost(poses, poses.facing(d, 14_deg), kA, car));
  EXPECT_EQ(cost(poses, poses.facing(d, 194_deg), kA, car), way + 2_s);
}

TEST(PoseBuilder, AllRobotsCanBeCars) {
  const auto poses = PoseBuilder(corner().build().value(), 90_degps).car(89_deg).build().value();
  EXPECT_FALSE(cost(poses, poses.facing(kA, 0_deg), kC));
  const auto wide = PoseBuilder(corner().build().value(), 90_degps).car(90_deg).build().value();
  EXPECT_EQ(cost(wide, wide.facing(kA, 0_deg), kC), 4_s);
  EXPECT_FALSE(cost(wide, wide.facing(kA, 180_deg), kC));
}

// Rounded places are not exactly in a line: a robot goes on without a turn.
TEST(PoseBuilder, LessThanADegreeIsStraight) {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  const VertexId a = roads.vertex(0_m, 0_m), b = roads.vertex(2_m, 0.03_m);
  const VertexId c = roads.vertex(4_m, 0_m), d = roads.vertex(6_m, 0.1_m);
  roads.road(a, b).road(b, c).road(c, d);
  const auto poses = PoseBuilder(roads.build().value(), 10_degps).build().value();
  const VertexId start = poses.facing(a, 0_deg);
  EXPECT_GT(*cost(poses, start, c), 4_s);  // 1.7 degrees from lane to lane
  const auto less = PoseBuilder(roads.build().value(), 10_degps).heading(a, 0_deg).build().value();
  EXPECT_EQ(cost(less, less.facing(a, 0_deg), b), 2_s);  // 0.86 degrees
}

TEST(PoseBuilder, Errors) {
  const auto places = corner().build().value();
  const auto code = [](const PoseBuilder& builder) { return builder.build().error().code; };
  for (const RadiansPerSecond rate : {0_degps, -(1_degps), degrees(1e-12) / 1_s})
    EXPECT_EQ(code(PoseBuilder(places, rate)), ErrorCode::out_of_range);
  EXPECT_EQ(code(PoseBuilder(places, 1_degps).car(181_deg)), ErrorCode::out_of_range);
  EXPECT_EQ(code(PoseBuilder(places, 1_degps).car(-(1_deg))), ErrorCode::out_of_range);
  EXPECT_EQ(code(PoseBuilder(places, 1_degps).turn_rate(Group(1), 1_degps)),
            ErrorCode::invalid_instance);
  EXPECT_EQ(code(PoseBuilder(places, 1_degps).heading(VertexId(3), 0_deg)),
            ErrorCode::invalid_instance);
  EXPECT_EQ(code(PoseBuilder(places, 1_degps)
                     .heading(kA, Radians(std::numeric_limits<double>::infinity()))),
            ErrorCode::out_of_range);
  RoadmapBuilder lift = corner();
  lift.road(kA, lift.vertex(0_m, 0_m, 3_m, "upstairs"));
  EXPECT_EQ(PoseBuilder(lift.build().value(), 1_degps).build().error().message,
            "the lane from a to upstairs goes straight up or down, and has no heading");
}

TEST(PoseBuilder, RobotsBeginInTheMiddleOfATurn) {
  const auto poses = PoseBuilder(corner().build().value(), 90_degps).build().value();
  Fleet fleet(poses.roadmap());
  const Robot robot = fleet.robot({.body = Disc(0.3_m), .speed = 1_mps})
                          .from(poses.facing(kA, 0_deg))
                          .to_any(poses.any_heading(kC));
  const auto plan = solve(fleet).value().plan.value();
  const auto& path = plan[robot];
  ASSERT_EQ(path.stops().size(), 4U);  // a, b, b, c
  EXPECT_EQ(path.at(2.5_s), (Point{2_m, 0_m}));
  EXPECT_EQ(path.velocity(2.5_s).x, 0_mps);
  robot.from(path, 2.3_s);
  fleet.begins_at(2.3_s);
  ASSERT_TRUE(fleet.under_way(robot));
  const auto rest = solve(fleet).value();
  EXPECT_EQ(rest.cost, 2.7_s);  // 0.7 s of the turn, and the lane
  const auto again = rest.plan.value();
  EXPECT_NEAR(again[robot].under_way()->fraction, 0.3, 1e-9);
  // The finished plan is an obstacle for others, who wait for its end.
  EXPECT_EQ(as_obstacle(fleet, again, robot)->path.size(), 3U);
  // A turn that is none.
  robot.from_edge(poses.facing(kA, 0_deg), poses.facing(kA, 0_deg), 0.5);
  EXPECT_EQ(fleet.instance().error().code, ErrorCode::out_of_range);
}

/// The robots of a task, one metre per second and cell, and a quarter turn per second.
Fleet as_fleet(const TurningTask& task) {
  RoadmapBuilder roads({.length = 10_mm, .time = 1_s});
  for (std::size_t cell = 0; cell < task.passable.size(); ++cell)
    roads.vertex(Metres(static_cast<double>(cell % task.width)),
                 Metres(-static_cast<double>(cell / task.width)));
  for (std::size_t cell = 0; cell < task.passable.size(); ++cell) {
    const auto join = [&](std::size_t other) {
      if (task.passable[cell] && task.passable[other]) roads.road(VertexId(cell), VertexId(other));
    };
    if ((cell + 1) % task.width != 0) join(cell + 1);
    if (cell + task.width < task.passable.size()) join(cell + task.width);
  }
  const auto facing = [](std::size_t heading) {
    return degrees(-90 * static_cast<double>(heading));
  };
  PoseBuilder builder(roads.build().value(), degrees(90.0 / task.turn) / 1_s);
  for (const auto& robot : task.robots)
    builder.heading(VertexId(robot.start), facing(robot.heading));
  const auto poses = builder.build().value();
  Fleet fleet(poses.roadmap());
  for (const auto& robot : task.robots)
    fleet.robot({.body = Disc(0.35_m), .speed = 1_mps})
        .from(poses.facing(VertexId(robot.start), facing(robot.heading)))
        .to_any(poses.any_heading(VertexId(robot.goal)));
  return fleet;
}

TEST(PoseBuilderRandom, CostsWhatTheJointSearchSays) {
  const std::size_t count = support::scaled(300);
  std::size_t num_optimal = 0, num_infeasible = 0;
  for (std::size_t seed = 0; seed < count; ++seed) {
    Random random(7'000'000 + seed);
    TurningTask task;
    task.width = random.between(2, 4);
    task.height = random.between(1, 3);
    task.turn = random.percent(70) ? 1 : 2;
    std::vector<std::size_t> starts;
    for (std::size_t cell = 0; cell < task.width * task.height; ++cell) {
      task.passable.push_back(!random.percent(15));
      if (task.passable.back()) starts.push_back(cell);
    }
    std::vector<std::size_t> goals = starts;
    random.shuffle(starts);
    random.shuffle(goals);
    const std::size_t most = std::min(starts.size(), random.between(1, task.turn == 1 ? 3 : 2));
    for (std::size_t i = 0; i < most; ++i)
      task.robots.push_back({starts[i], random.below(4), goals[i]});
    const Objective objective = seed % 2 == 0 ? Objective::sum_of_costs : Objective::makespan;
    const auto answer = search_poses(task, objective);
    ASSERT_NE(answer.status, Status::unknown);
    SolveOptions options;
    options.objective = objective;
    const SolveOutcome outcome = solve(as_fleet(task), options).value();
    SCOPED_TRACE(seed);
    ASSERT_EQ(outcome.status, answer.status);
    if (answer.status == Status::infeasible) {
      ++num_infeasible;
      continue;
    }
    ++num_optimal;
    ASSERT_EQ(outcome.cost, Seconds(static_cast<double>(answer.cost)));
  }
  RecordProperty("infeasible", static_cast<int>(num_infeasible));
  if (count < 100) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(2 * num_optimal, count);
  EXPECT_GE(50 * num_infeasible, count);
}

}  // namespace
}  // namespace quadrille::fleet
