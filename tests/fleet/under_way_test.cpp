// SPDX-License-Identifier: MIT
//
// Planning again while robots are in the middle of moves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "fleet/support.hpp"
#include "quadrille/fleet/solver.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;
using testing::HasSubstr;

/// A road of five metres, and a robot that takes five seconds for it.
struct Corridor {
  Corridor() : fleet(roads()) {
    robot = fleet.robot({.name = "amr", .body = Disc(0.3_m), .speed = 1_mps}).from(a).to(b).id();
  }
  static Roadmap roads() {
    RoadmapBuilder roads({.length = 1_mm, .time = 10_ms});
    const VertexId from = roads.vertex(0_m, 0_m, "a"), to = roads.vertex(5_m, 0_m, "b");
    roads.road(from, to);
    return roads.build().value();
  }
  [[nodiscard]] TimedPlan plan() const { return solve(fleet).value().plan.value(); }
  VertexId a{0}, b{1};
  Fleet fleet;
  AgentId robot;
};

/// As users write it by hand: the path's own vertices, wherever they are.
void put(Robot robot, const TimedPath& path, Seconds time) {
  const auto next = std::find_if(path.stops().begin(), path.stops().end() - 1,
                                 [&](const Stop& stop) { return stop.depart >= time; });
  if (next->arrive <= time) {
    robot.from(next->vertex);
    return;
  }
  const Stop& last = *(next - 1);
  robot.from_edge(last.vertex, next->vertex, (time - last.depart) / (next->arrive - last.depart));
}

// One clock for the fleet, its plans and those that are made again: costs count from the beginning.
TEST(UnderWay, PlansAgainOnOneClock) {
  Corridor c;
  c.fleet.begins_at(100_s);
  EXPECT_EQ(c.fleet.begin(), 100_s);
  const TimedPlan first = c.plan();
  EXPECT_EQ(first[c.robot].stops().front().arrive, 100_s);
  EXPECT_EQ(first[c.robot].stops().back().arrive, 105_s);
  EXPECT_EQ(first[c.robot].cost(), 5_s);
  EXPECT_EQ(first[c.robot].samples(1_Hz).back().time, 105_s);
  c.fleet[c.robot].from(first[c.robot], 102_s);
  c.fleet.begins_at(102_s);
  const TimedPlan second = c.plan();
  EXPECT_EQ(second[c.robot].stops().front().arrive, 102_s);
  EXPECT_EQ(second[c.robot].stops().back().arrive, 105_s);
  EXPECT_EQ(second[c.robot].cost(), 3_s);
  // What is asked is on the same clock.
  c.fleet[c.robot].deadline(104_s);
  EXPECT_THAT(c.fleet.instance().error().message, HasSubstr("cannot arrive before 105"));
  c.fleet.begins_at(-1_s);
  EXPECT_EQ(c.fleet.instance().error().code, ErrorCode::out_of_range);
}

TEST(UnderWay, PlansAgainTwiceWithinOneMoveByHand) {
  Corridor c;
  put(c.fleet[c.robot], c.plan()[c.robot], 1_s);
  const TimedPlan second = c.plan();
  EXPECT_EQ(second[c.robot].cost(), 4_s);
  put(c.fleet[c.robot], second[c.robot], 0_s);
  EXPECT_EQ(c.plan()[c.robot].cost(), 4_s);
  put(c.fleet[c.robot], second[c.robot], 1_s);
  const TimedPlan third = c.plan();
  EXPECT_EQ(third[c.robot].cost(), 3_s);
  EXPECT_EQ(third[c.robot].stops().front().place, (Point{2_m, 0_m}));
  EXPECT_EQ(c.fleet.place_name(third[c.robot].stops().front().vertex), "the lane from a to b");
  put(c.fleet[c.robot], third[c.robot], 3_s);
  EXPECT_EQ(c.fleet.start(c.robot), c.b);
  EXPECT_EQ(c.fleet.under_way(c.robot), std::nullopt);
}

TEST(UnderWay, APathKnowsWhereToGoOn) {
  Corridor c;
  const TimedPlan first = c.plan();
  EXPECT_EQ(first[c.robot].under_way(), std::nullopt);
  c.fleet[c.robot].from(first[c.robot], 1.237_s);  // 123.7 steps of 500
  const TimedPlan second = c.plan();
  EXPECT_EQ(second[c.robot].cost(), 3.77_s);
  EXPECT_EQ(second[c.robot].under_way(), (UnderWay{c.a, c.b, 0.246}));
  // As often as one likes of the same plan.
  for (const Seconds time : {2_s, 1_s, 3.77_s, 0_s, -1_s, 1_s}) {
    c.fleet[c.robot].from(second[c.robot], time);
    EXPECT_EQ(c.plan()[c.robot].cost(), 3.77_s - std::max(time, 0_s)) << time.value();
  }
  const TimedPlan third = c.plan();
  EXPECT_EQ(third[c.robot].under_way(), (UnderWay{c.a, c.b, 0.446}));
  c.fleet[c.robot].from(third[c.robot], 100_s);
  EXPECT_EQ(c.fleet.start(c.robot), c.b);
  c.fleet[c.robot].from(first[c.robot], -1_s);
  EXPECT_EQ(c.fleet.start(c.robot), c.a);
}

TEST(UnderWay, PartsOfAMoveAddUpToWholeSteps) {
  support::Random random(11);
  for (std::uint32_t run = 0; run < support::scaled(200); ++run) {
    Corridor c, by_hand;
    TimedPlan plan = c.plan();
    int steps = 0;
    for (int left = 500; left > 1;) {
      const int taken = 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(left - 1)));
      const Seconds time = taken * 10_ms;
      c.fleet[c.robot].from(plan[c.robot], time);
      put(by_hand.fleet[c.robot], plan[c.robot], time);
      steps += taken;
      left -= taken;
      plan = c.plan();
      ASSERT_EQ(plan.in_units().paths[c.robot].back().arrive.value(), 500 - steps) << run;
      ASSERT_EQ(by_hand.plan()[c.robot].cost(), plan[c.robot].cost()) << run;
    }
  }
}

TEST(UnderWayDeathTest, OnlyItsOwnPlaceIsOne) {
  Corridor c;
  EXPECT_DEATH(c.fleet[c.robot].from(VertexId(2)), "its own place");
  EXPECT_DEATH(c.fleet[c.robot].from_edge(VertexId(2), c.b, 0.5), "its own place");
  c.fleet[c.robot].from_edge(c.a, c.b, 0.5);
  EXPECT_DEATH(c.fleet[c.robot].from_edge(VertexId(2), c.a, 0.5), "its own place");
  c.fleet[c.robot].from_edge(VertexId(2), c.b, -0.5);
  EXPECT_THAT(c.fleet.instance().error().message, HasSubstr("which is not from 0 to 1"));
}

/// Millimetres as metres: a robot stands at (0, 0), another one is on the lane.
SolveOutcome beside_a_lane(Point from, Point to, double fraction, int radii,
                           MetresPerSecond speed) {
  RoadmapBuilder roads({.length = 1_mm, .time = 10_ms});
  const VertexId o = roads.vertex(0_m, 0_m, "o"), a = roads.vertex(from, "a"),
                 b = roads.vertex(to, "b");
  roads.lane(a, b);
  Fleet fleet(roads.build().value());
  fleet.robot({.name = "stands", .body = Disc(2_mm), .speed = speed}).from(o).to(o);
  fleet.robot({.name = "goes", .body = Disc((radii - 2) * 1_mm), .speed = speed})
      .from_edge(a, b, fraction)
      .to(b);
  return solve(fleet).value();
}

TEST(UnderWay, PlacesInTheMiddleOfMovesAreExact) {
  // (2.4, 4.4) is 5.01 from (0, 0); the nearest whole place, (2, 4), 4.47.
  const auto start = [](int radii) {
    return beside_a_lane({6_mm, 0_m}, {-12_mm, 22_mm}, 0.2, radii, 0.5686_mps);
  };
  EXPECT_EQ(start(4).status, Status::optimal);
  EXPECT_EQ(start(5).status, Status::optimal);
  EXPECT_EQ(start(6).status, Status::infeasible);
  EXPECT_THAT(start(6).explanation, HasSubstr("overlap"));
  // The lane passes (0, 0) at a distance of 5; from (0, 6), as (-0.2, 6.4) would be rounded,
  // at 4.85.
  const auto pass = [](double fraction, int radii) {
    return beside_a_lane({-5_mm, 10_mm}, {11_mm, -2_mm}, fraction, radii, 0.1_mps);
  };
  for (const double fraction : {0.25, 0.3}) {
    EXPECT_EQ(pass(fraction, 4).status, Status::optimal);
    EXPECT_EQ(pass(fraction, 5).status, Status::optimal);
    EXPECT_EQ(pass(fraction, 6).status, Status::infeasible);
  }
}

TEST(UnderWay, AMoveIsToldByWhenItBegan) {
  Corridor c;
  c.fleet[c.robot].from_edge(c.a, c.b).begun(-1.25_s);
  const TimedPlan plan = c.plan();
  EXPECT_EQ(plan[c.robot].cost(), 3.75_s);
  EXPECT_EQ(plan[c.robot].under_way(), (UnderWay{c.a, c.b, 0.25}));
  // On the fleet's clock, and never further than it is.
  c.fleet.begins_at(100_s);
  c.fleet[c.robot].from_edge(c.a, c.b).begun(98.996_s);
  EXPECT_EQ(c.plan()[c.robot].cost(), 4_s);
  c.fleet[c.robot].from_edge(c.a, c.b).begun(100_s);
  EXPECT_EQ(c.plan()[c.robot].cost(), 5_s);
  for (const Seconds wrong : {95_s, 90_s, 100.01_s}) {
    c.fleet[c.robot].from_edge(c.a, c.b).begun(wrong);
    EXPECT_EQ(c.fleet.instance().error().message,
              "'amr' began its move from a to b at " + to_string(wrong) +
                  ", and is not within it at 100 s: it takes 5 s");
  }
}

// Two robots come together at one place, the one on the lane first; it would have to wait.
TEST(UnderWay, WhoStandsWithinItsLaneMayWait) {
  RoadmapBuilder roads({.length = 1_mm, .time = 10_ms});
  const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(5_m, 0_m, "b"),
                 c = roads.vertex(5_m, 5_m, "c"), d = roads.vertex(10_m, 0_m, "d");
  roads.lane(a, b);
  roads.road(b, c);
  roads.road(b, d);
  Fleet fleet(roads.build().value());
  const auto amr = fleet.robot({.name = "amr", .body = Disc(0.5_m), .speed = 1_mps}).to(d);
  const auto agv = fleet.robot({.name = "agv", .body = Disc(0.5_m), .speed = 1_mps});
  amr.from_edge(a, b).begun(-3.5_s);
  agv.from(b).to(c).release(4_s);
  EXPECT_EQ(solve(fleet).value().status, Status::infeasible);
  amr.may_wait();
  const TimedPlan plan = solve(fleet).value().plan.value();
  const TimedPath& path = plan[amr];
  EXPECT_EQ(path.stops().front().place, (Point{3.5_m, 0_m}));
  EXPECT_GT(path.stops().front().depart, 3_s);
  EXPECT_TRUE(path.under_way()->may_wait);
  // It is still there, and on its way later; then it finishes its move.
  fleet[amr].from(path, 1_s);
  EXPECT_EQ(fleet.under_way(amr), (UnderWay{a, b, 0.7, {}, true}));
  fleet[amr].from(path, path.stops().front().depart + 0.5_s);
  EXPECT_NEAR(fleet.under_way(amr)->fraction, 0.8, 1e-12);
  EXPECT_FALSE(fleet.under_way(amr)->may_wait);
}

TEST(UnderWay, RoundedDurationsAreTold) {
  const auto on_lanes = [](Metres length, Seconds tick, MetresPerSecond speed) {
    RoadmapBuilder roads({.length = 1_mm, .time = tick});
    const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(length, 0_m, "b");
    roads.road(a, b);
    Fleet fleet(roads.build().value());
    fleet.robot({.name = "amr", .body = Disc(0.3_m), .speed = speed}).from(a).to(b);
    return solve(fleet).value();
  };
  SolveOutcome outcome = on_lanes(0.1_m, 50_ms, 1.4_mps);
  EXPECT_NEAR(outcome.duration_error, 0.3, 1e-12);
  ASSERT_EQ(outcome.warnings.size(), 1U);
  EXPECT_EQ(outcome.warnings[0],
            "durations are rounded by up to 30 %: the lane from a to b is planned to take 'amr' "
            "0.05 s instead of 0.0714 s; a smaller resolution of time than 0.05 s mends that");
  outcome = on_lanes(0.1_m, 50_ms, 0.77_mps);  // 0.1299 s become 0.15 s
  EXPECT_NEAR(outcome.duration_error, 0.155, 1e-12);
  EXPECT_EQ(outcome.warnings.size(), 1U);
  outcome = on_lanes(0.1_m, 1_ms, 1.4_mps);
  EXPECT_LT(outcome.duration_error, 0.01);
  EXPECT_TRUE(outcome.warnings.empty());
  outcome = on_lanes(5_m, 50_ms, 1.25_mps);
  EXPECT_EQ(outcome.duration_error, 0);
  EXPECT_TRUE(outcome.warnings.empty());
}

}  // namespace
}  // namespace quadrille::fleet
