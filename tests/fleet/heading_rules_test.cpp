// SPDX-License-Identifier: MIT
// Headings that lanes demand, in which robots stand, and ways in which they may turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "quadrille/fleet/pose_builder.hpp"
#include "quadrille/fleet/solver.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;
using quadrille::support::Random;

/// An L: from a along x to b, from there along y to c; each 2 m.
Roadmap corner() {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(2_m, 0_m, "b");
  roads.road(a, b).road(b, roads.vertex(2_m, 2_m, "c"));
  return roads.build().value();
}
const VertexId kA(0), kB(1), kC(2);

std::optional<Seconds> cost(const PoseRoadmap& poses, VertexId start, VertexId place,
                            std::optional<Group> group = {}) {
  Fleet fleet(poses.roadmap());
  fleet.robot({.body = Disc(0.3_m), .speed = 1_mps, .group = group})
      .from(start)
      .to_any(poses.any_heading(place));
  return solve(fleet).value().cost;
}

TEST(HeadingRules, LanesDemandHeadings) {
  const auto back = PoseBuilder(corner(), 90_degps).lane_heading(kA, kB, 180_deg).build().value();
  EXPECT_EQ(cost(back, back.facing(kA, 180_deg), kB), 2_s);
  EXPECT_EQ(cost(back, back.facing(kA, 180_deg), kC), 5_s);
  const auto any = PoseBuilder(corner(), 90_degps)
                       .lane_heading(kA, kB, 180_deg)
                       .lane_heading(kA, kB, 0_deg)
                       .build()
                       .value();
  EXPECT_EQ(cost(any, any.facing(kA, 180_deg), kB), 2_s);
  EXPECT_EQ(cost(any, any.facing(kA, 0_deg), kB), 2_s);
}

TEST(HeadingRules, RobotsStandInOneHeading) {
  const auto poses = PoseBuilder(corner(), 90_degps).stand(kB, 180_deg).build().value();
  ASSERT_EQ(poses.any_heading(kB).size(), 1U);
  EXPECT_EQ(poses.heading(poses.any_heading(kB).front()), 180_deg);
  EXPECT_EQ(cost(poses, poses.facing(kA, 0_deg), kB), 4_s);
  EXPECT_EQ(cost(poses, poses.facing(kA, 0_deg), kC), 7_s);
  // Who begins there turns to it, too.
  EXPECT_EQ(cost(poses, poses.facing(kB, 90_deg), kC), 4_s);
}

TEST(HeadingRules, TurnsGoOneWay) {
  const auto time = [](Turns turns, std::optional<RadiansPerSecond> most = {}) {
    const auto poses = PoseBuilder(corner(), 90_degps).turns(kB, turns, most).build().value();
    return cost(poses, poses.facing(kA, 0_deg), kC);
  };
  EXPECT_EQ(time(Turns::both), 5_s);
  EXPECT_EQ(time(Turns::counter_clockwise), 5_s);
  EXPECT_EQ(time(Turns::clockwise), 7_s);
  EXPECT_EQ(time(Turns::none), std::nullopt);
  EXPECT_EQ(time(Turns::both, 30_degps), 7_s);
  EXPECT_EQ(time(Turns::both, 300_degps), 5_s);
}

TEST(HeadingRules, PolygonsSweepTheWayThatTheyTurn) {
  // Another one stands beside b, where a half turn on that side would hit it.
  const auto solved = [](Turns turns, Metres side) {
    RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
    const VertexId b = roads.vertex(2_m, 0_m, "b"), n = roads.vertex(2_m, side, "n");
    const VertexId a = roads.vertex(0_m, 0_m, "a"), z = roads.vertex(9_m, side, "z");
    roads.road(a, b).road(n, z);
    const auto poses = PoseBuilder(roads.build().value(), 90_degps).turns(b, turns).build().value();
    Fleet fleet(poses.roadmap());
    // Its left half is all there is of it when it faces along x: it sweeps a half disc.
    fleet
        .robot({.name = "r",
                .body = Polygon({{0_m, 0_m}, {1_m, 0_m}, {1_m, 0.1_m}, {0_m, 0.1_m}}),
                .speed = 1_mps})
        .from(poses.facing(b, 0_deg))
        .to(poses.facing(b, 180_deg));
    fleet.robot({.name = "n", .body = Disc(0.3_m), .speed = 1_mps})
        .from(poses.facing(n, 0_deg))
        .to(poses.facing(n, 0_deg));
    const auto outcome = solve(fleet);
    EXPECT_TRUE(outcome.has_value()) << outcome.error().message;
    return outcome ? outcome->cost : std::nullopt;
  };
  EXPECT_GT(solved(Turns::counter_clockwise, 1.1_m), 2_s);  // the other one gives way
  EXPECT_EQ(solved(Turns::clockwise, 1.1_m), 2_s);
  EXPECT_EQ(solved(Turns::counter_clockwise, -1.1_m), 2_s);
  EXPECT_GT(solved(Turns::clockwise, -1.1_m), 2_s);
}

TEST(HeadingRules, Errors) {
  const auto message = [](const PoseBuilder& builder) { return builder.build().error().message; };
  const PoseBuilder builder(corner(), 90_degps);
  EXPECT_EQ(message(PoseBuilder(builder).lane_heading(kA, kC, 0_deg)),
            "there is a heading on a lane that the roadmap does not have");
  EXPECT_EQ(message(PoseBuilder(builder).lane_heading(kA, VertexId(9), 0_deg)),
            "there is a heading on a lane that the roadmap does not have");
  EXPECT_EQ(message(PoseBuilder(builder).stand(kB, 0_deg).stand(kB, 90_deg)),
            "robots stand in two headings at b: 0 deg and 90 deg");
  EXPECT_EQ(message(PoseBuilder(builder).lane_heading(
                kA, kB, Radians(std::numeric_limits<double>::infinity()))),
            "a heading from a to b is no finite angle");
  EXPECT_EQ(message(PoseBuilder(builder).turns(VertexId(9), Turns::none)),
            "there are turns at a place that the roadmap does not have");
  EXPECT_EQ(message(PoseBuilder(builder).turns(kB, Turns::both, 0_degps)),
            "the turns at b are not supported");
}

/// Places two metres apart and lanes in eight directions; all angles are multiples of 45 degrees.
struct Case {
  std::size_t width = 0, height = 0;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<int>> lanes;  // headings of a lane
  std::map<std::size_t, int> stands;
  std::map<std::size_t, std::tuple<bool, bool, int>> turns;  // left, right, ticks of 45 degrees
  bool is_car = false;
  std::size_t start = 0, goal = 0;
  int heading = 0;
};

int direction(const Case& c, std::size_t from, std::size_t to) {
  const int dx = static_cast<int>(to % c.width) - static_cast<int>(from % c.width);
  const int dy = static_cast<int>(to / c.width) - static_cast<int>(from / c.width);
  constexpr std::array<std::array<int, 3>, 3> kOf{{{5, 6, 7}, {4, 0, 0}, {3, 2, 1}}};
  return kOf[static_cast<std::size_t>(dy + 1)][static_cast<std::size_t>(dx + 1)];
}

Case random_case(Random& random) {
  Case c;
  c.width = random.between(2, 3);
  c.height = random.between(1, 3);
  const std::size_t n = c.width * c.height;
  for (std::size_t from = 0; from < n; ++from)
    for (std::size_t to = 0; to < n; ++to) {
      const auto far = [&](std::size_t a, std::size_t b) {
        return std::max(a, b) - std::min(a, b) > 1;
      };
      if (from == to || far(from % c.width, to % c.width) || far(from / c.width, to / c.width) ||
          random.percent(40))
        continue;
      std::vector<int>& headings = c.lanes[{from, to}];
      for (std::size_t k = random.percent(60) ? 0 : random.between(1, 2); k > 0; --k)
        headings.push_back(random.percent(50) ? (direction(c, from, to) + 4) % 8
                                              : static_cast<int>(random.below(8)));
    }
  for (std::size_t v = 0; v < n; ++v) {
    if (random.percent(25)) c.stands[v] = static_cast<int>(random.below(8));
    if (random.percent(50))
      c.turns[v] = {random.percent(60), random.percent(60), random.percent(30) ? 20 : 10};
  }
  c.is_car = random.percent(30);
  c.start = random.below(n);
  c.goal = random.below(n);
  c.heading = static_cast<int>(random.below(8));
  return c;
}

/// What it costs in ticks, by a search over places, headings and whether the robot has stood as it
/// has to; by steps of 45 degrees. Shares nothing with the library.
std::optional<int> shortest(const Case& c) {
  using State = std::tuple<int, std::size_t, int, bool>;  // cost, place, heading, has stood
  std::priority_queue<State, std::vector<State>, std::greater<>> open;
  std::map<std::tuple<std::size_t, int, bool>, int> done;
  const auto push = [&](int cost, std::size_t place, int heading, bool stood) {
    const auto stand = c.stands.find(place);
    open.emplace(cost, place, heading,
                 stood || stand == c.stands.end() || stand->second == heading);
  };
  push(0, c.start, c.heading, false);
  while (!open.empty()) {
    const auto [cost, place, heading, stood] = open.top();
    open.pop();
    if (!done.try_emplace({place, heading, stood}, cost).second) continue;
    const auto stand = c.stands.find(place);
    if (place == c.goal && stood && (stand == c.stands.end() || stand->second == heading))
      return cost;
    const auto told = c.turns.find(place);
    const auto [left, right, time] =
        told == c.turns.end() ? std::tuple(true, true, 10) : told->second;
    if (!c.is_car && left) push(cost + time, place, (heading + 1) % 8, stood);
    if (!c.is_car && right) push(cost + time, place, (heading + 7) % 8, stood);
    for (const auto& [ends, headings] : c.lanes) {
      if (ends.first != place || !stood) continue;
      const int ahead = direction(c, place, ends.second);
      for (const int faced : headings.empty() ? std::vector{ahead} : headings) {
        const int apart = std::min((faced - heading + 8) % 8, (heading - faced + 8) % 8);
        if (apart <= (c.is_car ? 1 : 0))
          push(cost + (ahead % 2 == 0 ? 20 : 28), ends.second, faced, false);
      }
    }
  }
  return std::nullopt;
}

std::optional<Seconds> planned(const Case& c) {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  for (std::size_t v = 0; v < c.width * c.height; ++v)
    roads.vertex(2_m * static_cast<double>(v % c.width), 2_m * static_cast<double>(v / c.width));
  for (const auto& [ends, headings] : c.lanes)
    roads.lane(VertexId(ends.first), VertexId(ends.second));
  PoseBuilder builder(roads.build().value(), 45_degps);
  if (c.is_car) builder.car(50_deg);
  const auto angle = [](int heading) { return degrees(45.0 * heading); };
  for (const auto& [ends, headings] : c.lanes)
    for (const int heading : headings)
      builder.lane_heading(VertexId(ends.first), VertexId(ends.second), angle(heading));
  for (const auto& [place, heading] : c.stands) builder.stand(VertexId(place), angle(heading));
  for (const auto& [place, told] : c.turns) {
    const auto [left, right, time] = told;
    builder.turns(VertexId(place),
                  left    ? right ? Turns::both : Turns::counter_clockwise
                  : right ? Turns::clockwise
                          : Turns::none,
                  degrees(450.0 / time) / 1_s);
  }
  builder.heading(VertexId(c.start), angle(c.heading));
  const auto poses = builder.build().value();
  return cost(poses, poses.facing(VertexId(c.start), angle(c.heading)), VertexId(c.goal));
}

TEST(HeadingRulesRandom, OneRobotCostsWhatTheSearchOverHeadingsSays) {
  const std::size_t count = support::scaled(5000);
  std::size_t num_solved = 0;
  for (std::size_t seed = 0; seed < count; ++seed) {
    Random random(8'000'000 + seed);
    const Case c = random_case(random);
    SCOPED_TRACE(seed);
    const auto ticks = shortest(c);
    const auto found = planned(c);
    ASSERT_EQ(found.has_value(), ticks.has_value());
    if (!ticks) continue;
    num_solved += *ticks > 0 ? 1 : 0;
    ASSERT_EQ(*found, Seconds(*ticks / 10.0));
  }
  if (count < 100) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(4 * num_solved, count);
}

}  // namespace
}  // namespace quadrille::fleet
