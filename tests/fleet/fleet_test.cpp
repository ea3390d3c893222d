// SPDX-License-Identifier: MIT
#include "quadrille/fleet/fleet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fleet/support.hpp"
#include "quadrille/fleet/solver.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

const VertexId kA(0), kB(1), kC(2), kD(3);

TEST(Fleet, BecomesAnInstanceInWholeUnits) {
  Fleet fleet(test::line(3, {.length = 1_mm, .time = 50_ms}));
  const Robot amr7 =
      fleet.robot({.name = "amr7", .body = Disc(0.35_m), .speed = 0.8_mps}).from(kA).to(kB);
  const AgentId other =
      fleet
          .robot({.name = {},
                  .body = Polygon({{-0.2_m, -0.1_m}, {0.2_m, -0.1_m}, {0.2006_m, 0.1_m}}),
                  .speed = 1_mps})
          .from(kC)
          .to(kC);
  EXPECT_EQ(fleet.name(amr7), "amr7");
  EXPECT_EQ(fleet.name(other), "robot 1");
  EXPECT_EQ(fleet.find("amr7"), amr7.id());
  EXPECT_EQ(fleet.find("robot 1"), other);
  EXPECT_EQ(fleet.find("x"), std::nullopt);
  const continuous::Instance made = fleet.instance().value();
  EXPECT_EQ(made.agent(amr7),
            (continuous::Agent{kA, kB, continuous::Disc{350}, 40 * continuous::kUnitSpeed}));
  EXPECT_EQ(made.duration(made.class_of(amr7), continuous::EdgeId(0)), continuous::Ticks{25});
  const auto corners = std::get<continuous::ConvexPolygon>(made.agent(other).body).vertices();
  // Both of the last two, so that the given corner between them is inside.
  EXPECT_EQ(corners,
            (std::vector<continuous::Point>{{-200, -100}, {200, -100}, {201, 100}, {200, 100}}));
}

TEST(Fleet, DiscsAreRoundedUp) {
  Fleet fleet(test::line(2));
  const auto radius = [&](Metres wanted) {
    Fleet one = fleet;
    one.robot({.name = {}, .body = Disc(wanted), .speed = 1_mps}).from(kA).to(kB);
    return std::get<continuous::Disc>(one.instance().value().agent(AgentId(0)).body).radius;
  };
  EXPECT_EQ(radius(0.35_m), continuous::Length{350});
  EXPECT_EQ(radius(0.3500001_m), continuous::Length{351});
  EXPECT_EQ(radius(0.3499999_m), continuous::Length{350});
  EXPECT_EQ(radius(1e-9 * 1_m), continuous::Length{1});
  // Whole millimetres stay what they are, whatever their last bit.
  for (int mm = 1; mm <= 1000; ++mm)
    for (const double value : {mm / 1000.0, mm * 0.001, std::nextafter(mm / 1000.0, 9.0)})
      ASSERT_EQ(radius(Metres(value)), continuous::Length(std::int64_t{mm})) << mm;
}

TEST(Fleet, PolygonsDoNotFly) {
  RoadmapBuilder roads;
  const VertexId low = roads.vertex(0_m, 0_m), high = roads.vertex(0_m, 0_m, 5_m);
  const Fleet fleet(roads.road(low, high).build().value());
  const Polygon square({{-0.2_m, -0.2_m}, {0.2_m, -0.2_m}, {0.2_m, 0.2_m}, {-0.2_m, 0.2_m}});
  Fleet wrong = fleet;
  wrong.robot({.name = "cart", .body = square, .speed = 1_mps}).from(low).to(high);
  EXPECT_EQ(wrong.instance().error().message,
            "'cart' is a polygon, but there are places with a height: in space bodies are spheres");
  Fleet good = fleet;
  good.robot({.name = "drone", .body = Disc(0.2_m), .speed = 1_mps}).from(low).to(high);
  EXPECT_TRUE(good.instance().has_value());
  good.obstacle({.name = "crane", .body = square, .path = {{{9_m, 9_m, 9_m}, 0_s, 1_s}}});
  EXPECT_EQ(good.instance().error().message,
            "'crane' is a polygon, but there are places with a height: in space bodies are "
            "spheres");
  // In the middle of a climb.
  Fleet later = fleet;
  later.robot({.name = "drone", .body = Disc(0.2_m), .speed = 1_mps})
      .from_edge(low, high, 0.4)
      .to(high);
  EXPECT_EQ(later.instance().value().roadmap().position(VertexId(2)),
            (continuous::Point{0, 0, 2000}));
}

TEST(Fleet, TasksMayChange) {
  Fleet fleet(test::line(4));
  const AgentId robot = fleet.robot({.name = "r", .body = Disc(0.1_m), .speed = 1_mps}).from(kA);
  EXPECT_EQ(fleet.start(robot), kA);
  EXPECT_EQ(fleet.goal(robot), std::nullopt);
  fleet[robot].from(kB).to(kD);
  EXPECT_EQ(fleet.start(robot), kB);
  EXPECT_EQ(fleet.goal(robot), kD);
  Fleet copy = fleet;
  copy[robot].to(kC);
  EXPECT_EQ(fleet.goal(robot), kD);
}

TEST(Fleet, RobotsMayChooseWhereTheyEnd) {
  Fleet fleet(test::line(4));
  const RobotSpec spec{.name = "r", .body = Disc(0.1_m), .speed = 1_mps};
  const AgentId r = fleet.robot(spec).from(kA).to_any({kD, kC, kD});
  RobotSpec other = spec;
  other.name = "s";
  const AgentId s = fleet.robot(other).from(kB).to_any({kC, kD});
  EXPECT_EQ(fleet.goals(r), Goals({kC, kD}));
  EXPECT_TRUE(fleet.instance().value().has_goal_sets());
  const SolveOutcome outcome = solve(fleet).value();
  ASSERT_TRUE(outcome.plan);
  EXPECT_EQ((*outcome.plan)[r].stops().back().vertex, kC);
  EXPECT_EQ((*outcome.plan)[s].stops().back().vertex, kD);
  fleet[r].to(kD);
  EXPECT_EQ(fleet.goal(r), kD);
}

/// A fleet of "p" from a to b, with one more robot; the error, "made" for none.
std::string refused(RobotSpec spec, std::optional<VertexId> from, std::optional<VertexId> to,
                    ErrorCode* code = nullptr) {
  RoadmapBuilder roads;
  for (int i = 0; i < 4; ++i) roads.vertex(i * 1_m, 0_m, std::string(1, "abcd"[i]));
  roads.road(kA, kB).road(kB, kC);
  Fleet fleet(roads.build().value());
  fleet.robot({.name = "p", .body = Disc(0.2_m), .speed = 1_mps}).from(kA).to(kB);
  const Robot robot = fleet.robot(std::move(spec));
  if (from) robot.from(*from);
  if (to) robot.to(*to);
  const auto made = fleet.instance();
  if (!made && code != nullptr) *code = made.error().code;
  return made ? "made" : made.error().message;
}

TEST(Fleet, RefusesWhatIsWrong) {
  const RobotSpec good{.name = "q", .body = Disc(0.2_m), .speed = 1_mps};
  EXPECT_EQ(refused(good, kB, kC), "made");
  EXPECT_EQ(refused(good, std::nullopt, kC), "'q' has no start");
  EXPECT_EQ(refused(good, kB, std::nullopt), "'q' has no goal");
  EXPECT_EQ(refused({.name = "q", .speed = 1_mps}, kB, kC),
            "'q' has a radius of 0 m, which is not positive, or too large");
  EXPECT_EQ(refused({.name = "q", .body = Disc(Metres(INFINITY)), .speed = 1_mps}, kB, kC),
            "'q' has a radius of inf m, which is not positive, or too large");
  EXPECT_EQ(refused({.name = "q", .body = Disc(0.1_m)}, kB, kC),
            "'q' has a speed of 0 m/s, which is not supported");
  EXPECT_EQ(refused({.name = "q", .body = Disc(0.1_m), .speed = -1_mps}, kB, kC),
            "'q' has a speed of -1 m/s, which is not supported");
  EXPECT_EQ(refused({.name = "p", .body = Disc(0.1_m), .speed = 1_mps}, kB, kC),
            "two robots are called 'p'");
  const std::string flat = refused(
      {.name = "q", .body = Polygon({{0_m, 0_m}, {1_m, 0_m}, {2_m, 0_m}}), .speed = 1_mps}, kB, kC);
  EXPECT_EQ(flat.substr(0, 67),
            "'q' has a polygon that is not supported at a resolution of 0.001 m:");
  EXPECT_EQ(refused({.name = "q",
                     .body = Polygon({{Metres(NAN), 0_m}, {1_m, 0_m}, {2_m, 1_m}}),
                     .speed = 1_mps},
                    kB, kC),
            "'q' has a polygon with a corner that is too far away");
  EXPECT_EQ(refused({.name = "q", .body = Disc(0.1_m), .speed = 1000_mps}, kB, kC),
            "the lane from a to b takes 'q' less than half a step of 0.01 s, or too long");
}

TEST(Fleet, SaysWhyThereIsNoPlan) {
  const RobotSpec good{.name = "q", .body = Disc(0.2_m), .speed = 1_mps};
  ErrorCode code = ErrorCode::io;
  EXPECT_EQ(refused(good, kA, kC, &code), "the starts of 'p' at a and 'q' at a overlap");
  EXPECT_EQ(code, ErrorCode::no_plan);
  EXPECT_EQ(refused({.name = "q", .body = Disc(0.9_m), .speed = 1_mps}, kD, kC, &code),
            "the goals of 'p' at b and 'q' at c overlap");
  EXPECT_EQ(code, ErrorCode::no_plan);
  EXPECT_EQ(refused(good, kC, kD, &code), "'q' cannot get from c to d");
  EXPECT_EQ(code, ErrorCode::no_plan);
}

}  // namespace
}  // namespace quadrille::fleet
