// SPDX-License-Identifier: MIT
// Robots that are not round and turn, looked at as rectangles at any moment of their plans.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "quadrille/fleet/pose_builder.hpp"
#include "quadrille/fleet/solver.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;
using quadrille::support::Random;

Polygon rectangle(Metres length, Metres width) {
  const Metres x = length / 2, y = width / 2;
  return Polygon({{-x, -y}, {x, -y}, {x, y}, {-x, y}});
}

struct Spot {
  double x, y;
};
using Corners = std::array<Spot, 4>;

/// Whether the rectangles overlap by more than rounding: no side of either separates them.
bool overlap(const Corners& a, const Corners& b) {
  constexpr double kRounding = 1e-6;
  for (const Corners* sides : {&a, &b})
    for (std::size_t k = 0; k < 2; ++k) {
      const Spot &p = (*sides)[k], &q = (*sides)[k + 1];
      const double nx = q.y - p.y, ny = p.x - q.x, size = std::hypot(nx, ny);
      const auto extent = [&](const Corners& corners) {
        std::pair<double, double> most{1e300, -1e300};
        for (const Spot& s : corners) {
          const double along = (s.x * nx + s.y * ny) / size;
          most = {std::min(most.first, along), std::max(most.second, along)};
        }
        return most;
      };
      const auto [low_a, high_a] = extent(a);
      const auto [low_b, high_b] = extent(b);
      if (high_a <= low_b + kRounding || high_b <= low_a + kRounding) return false;
    }
  return true;
}

/// The robot at a moment: between two stops it goes straight and turns evenly, by the shorter way.
Corners at(const PoseRoadmap& poses, const TimedPath& path, double length, double width,
           double time) {
  const auto& stops = path.stops();
  std::size_t k = 0;
  while (k + 1 < stops.size() && stops[k + 1].arrive.value() <= time) ++k;
  const auto place = [&](std::size_t s) { return poses.roadmap().position(stops[s].vertex); };
  const auto heading = [&](std::size_t s) { return poses.heading(stops[s].vertex).value(); };
  Spot centre{place(k).x.value(), place(k).y.value()};
  double facing = heading(k);
  if (k + 1 < stops.size() && time > stops[k].depart.value()) {
    const double share =
        (time - stops[k].depart.value()) / (stops[k + 1].arrive.value() - stops[k].depart.value());
    centre.x += share * (place(k + 1).x.value() - centre.x);
    centre.y += share * (place(k + 1).y.value() - centre.y);
    double turn = std::remainder(heading(k + 1) - facing, 2 * std::numbers::pi);
    if (std::abs(std::abs(turn) - std::numbers::pi) < 1e-9) turn = std::numbers::pi;
    facing += share * turn;
  }
  const double c = std::cos(facing), s = std::sin(facing);
  const auto corner = [&](double x, double y) {
    return Spot{centre.x + x * c - y * s, centre.y + x * s + y * c};
  };
  const double x = length / 2, y = width / 2;
  return {corner(-x, -y), corner(x, -y), corner(x, y), corner(-x, y)};
}

/// Random places and roads with room for a few robots.
RoadmapBuilder draw_places(Random& random) {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  const std::size_t columns = random.between(2, 4), rows = random.between(2, 3);
  const double step = 1.2 + 0.1 * static_cast<double>(random.below(10));
  // Where rows are not straight there are many headings.
  const std::size_t crooked = random.percent(25) ? 4 : 1;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      roads.vertex(
          Metres(step * static_cast<double>(c) + 0.1 * static_cast<double>(random.below(crooked))),
          Metres(step * static_cast<double>(r) + 0.1 * static_cast<double>(random.below(crooked))));
  const auto id = [&](std::size_t c, std::size_t r) { return VertexId(r * columns + c); };
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      if (c + 1 < columns && random.percent(85)) roads.road(id(c, r), id(c + 1, r));
      if (r + 1 < rows && random.percent(85)) roads.road(id(c, r), id(c, r + 1));
      if (c + 1 < columns && r + 1 < rows && random.percent(25))
        roads.road(id(c, r), id(c + 1, r + 1));
    }
  return roads;
}

TEST(TurningBodies, NeverOverlapAtAnyMoment) {
  const std::size_t count = support::scaled(80);
  std::size_t num_plans = 0, num_turns = 0;
  for (std::size_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(seed);
    Random random(8'000'000 + seed);
    const RoadmapBuilder places = draw_places(random);
    const Roadmap roads = places.build().value();
    PoseBuilder builder(roads, degrees(90) / 2_s);
    if (random.percent(20)) builder.car(degrees(100));
    const auto poses = builder.build().value();
    Fleet fleet(poses.roadmap());
    std::vector<std::pair<double, double>> sizes;
    const std::size_t robots = random.between(2, 3);
    std::vector<std::size_t> goals;
    for (std::size_t v = 0; v < roads.num_vertices(); ++v) goals.push_back(v);
    random.shuffle(goals);
    for (std::size_t i = 0; i < robots; ++i) {
      sizes.emplace_back(0.5 + 0.1 * static_cast<double>(random.below(6)),
                         0.2 + 0.1 * static_cast<double>(random.below(4)));
      const auto& facing = poses.any_heading(VertexId(random.below(roads.num_vertices())));
      fleet
          .robot(
              {.body = rectangle(Metres(sizes[i].first), Metres(sizes[i].second)), .speed = 1_mps})
          .from(facing[random.below(facing.size())])
          .to_any(poses.any_heading(VertexId(goals[i])));
    }
    SolveOptions options;
    options.limits.conflicts = 500;
    options.limits.cpu = 1_s;  // what has no plan by then is left out
    const auto outcome = solve(fleet, options);
    if (!outcome || !outcome->plan) continue;
    ++num_plans;
    const TimedPlan& plan = *outcome->plan;
    double end = 0;
    for (const AgentId robot : fleet.robot_ids()) {
      end = std::max(end, plan[robot].stops().back().arrive.value());
      num_turns += plan[robot].stops().size() - 1;
    }
    constexpr double kStep = 0.02;
    for (double time = 0; time <= end + kStep; time += kStep) {
      std::vector<Corners> now;
      for (std::size_t i = 0; i < robots; ++i)
        now.push_back(at(poses, plan[AgentId(i)], sizes[i].first, sizes[i].second, time));
      for (std::size_t i = 0; i < robots; ++i)
        for (std::size_t j = i + 1; j < robots; ++j)
          ASSERT_FALSE(overlap(now[i], now[j])) << "robots " << i << ", " << j << " at " << time;
    }
  }
  RecordProperty("plans", static_cast<int>(num_plans));
  if (count < 50) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(3 * num_plans, count);
  EXPECT_GE(num_turns, 3 * num_plans);
}

/// Two robots that go opposite ways along two aisles, so far apart.
Result<SolveOutcome> solve_aisles(Metres apart, const Body& body) {
  RoadmapBuilder builder({.length = 1_mm, .time = 100_ms});
  const VertexId a = builder.vertex(0_m, 0_m), b = builder.vertex(6_m, 0_m);
  const VertexId c = builder.vertex(0_m, apart), d = builder.vertex(6_m, apart);
  builder.road(a, b).road(c, d);
  const auto poses = PoseBuilder(builder.build().value(), 90_degps).build().value();
  Fleet fleet(poses.roadmap());
  const RobotSpec spec{.body = body, .speed = 1_mps};
  fleet.robot(spec).from(poses.facing(a, 0_deg)).to(poses.facing(b, 0_deg));
  fleet.robot(spec).from(poses.facing(d, 180_deg)).to(poses.facing(c, 180_deg));
  return solve(fleet);
}

TEST(TurningBodies, PassWhereTheirDiscsDoNot) {
  // 1.2 m x 0.8 m: the disc around it has a radius of 0.722 m.
  const Body forklift = rectangle(1.2_m, 0.8_m), disc = Disc(0.722_m);
  EXPECT_EQ(solve_aisles(0.8_m, forklift)->cost, 12_s);
  EXPECT_EQ(solve_aisles(0.79_m, forklift)->status, Status::infeasible);
  EXPECT_EQ(solve_aisles(1.4_m, disc)->status, Status::infeasible);
  EXPECT_EQ(solve_aisles(1.45_m, disc)->cost, 12_s);
}

// An obstacle does not turn: it has to contain the robot with every heading.
TEST(TurningBodies, AreDiscsToOtherFleets) {
  RoadmapBuilder builder({.length = 1_mm, .time = 100_ms});
  const VertexId a = builder.vertex(0_m, 0_m), b = builder.vertex(0_m, 6_m);
  builder.road(a, b);
  const auto poses = PoseBuilder(builder.build().value(), 90_degps).build().value();
  Fleet fleet(poses.roadmap());
  fleet.robot({.body = rectangle(1.2_m, 0.9_m), .speed = 1_mps})
      .from(poses.facing(a, 90_deg))
      .to(poses.facing(b, 90_deg));
  const auto outcome = solve(fleet).value();
  const auto obstacle = as_obstacle(fleet, *outcome.plan, AgentId(0));
  ASSERT_TRUE(std::holds_alternative<Disc>(obstacle->body));
  EXPECT_NEAR(std::get<Disc>(obstacle->body).radius.value(), 0.75, 1e-9);
}

TEST(TurningBodies, FaceAlongXAsTheyAreGiven) {
  // Up and down the rectangle is as long as it was wide.
  RoadmapBuilder builder({.length = 1_mm, .time = 100_ms});
  const VertexId a = builder.vertex(0_m, 0_m), b = builder.vertex(0_m, 6_m);
  const VertexId c = builder.vertex(0.8_m, 0_m), d = builder.vertex(0.8_m, 6_m);
  builder.road(a, b).road(c, d);
  const auto poses = PoseBuilder(builder.build().value(), 90_degps).build().value();
  Fleet fleet(poses.roadmap());
  const Body forklift = rectangle(1.2_m, 0.8_m);
  fleet.robot({.body = forklift, .speed = 1_mps})
      .from(poses.facing(a, 90_deg))
      .to(poses.facing(b, 90_deg));
  fleet.robot({.body = forklift, .speed = 1_mps})
      .from(poses.facing(d, 270_deg))
      .to(poses.facing(c, 270_deg));
  EXPECT_EQ(solve(fleet)->cost, 12_s);
  // The other one has left when it turns round, half a turn of two seconds.
  fleet[AgentId(0)].to(poses.facing(b, 270_deg));
  EXPECT_EQ(solve(fleet)->cost, 14_s);
  // Beside one that stays there is no room for that.
  fleet[AgentId(1)].to(poses.facing(d, 270_deg));
  EXPECT_EQ(solve(fleet)->status, Status::infeasible);
}

}  // namespace
}  // namespace quadrille::fleet
