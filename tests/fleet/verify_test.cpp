// SPDX-License-Identifier: MIT
#include "quadrille/fleet/verify.hpp"

#include <gtest/gtest.h>

#include "fleet/support.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

const VertexId kA(0), kB(1), kC(2);

/// Steps are 10 ms; both robots take a second from each vertex to the next.
Fleet fleet_of_two() {
  Fleet fleet(test::line(4));
  fleet.robot({.name = "p", .body = Disc(0.3_m), .speed = 1_mps}).from(kA).to(kB);
  fleet.robot({.name = "q", .body = Disc(0.2_m), .speed = 1_mps}).from(kC).to(kC);
  return fleet;
}

continuous::Plan good_plan() {
  return {{continuous::Path{{kA, 0, 20}, {kB, 120, 120}}, continuous::Path{{kC, 0, 0}}}};
}

std::string first(const continuous::Plan& plan) {
  const auto report = verify(fleet_of_two(), plan).value();
  return report.valid() ? "valid" : report.violations.front().message;
}

TEST(FleetVerify, ClearancesAreInMetresAndSeconds) {
  const auto report = verify(fleet_of_two(), good_plan()).value();
  EXPECT_TRUE(report.valid());
  ASSERT_EQ(report.clearances.size(), 1u);
  EXPECT_NEAR(report.clearances[0].gap.value(), 0.5, 1e-12);
  EXPECT_NEAR(report.clearances[0].time.value(), 1.2, 1e-12);
}

TEST(FleetVerify, ViolationsHaveNamesAndSeconds) {
  const auto with = [](const auto& change) {
    continuous::Plan plan = good_plan();
    change(plan.paths[AgentId(0)]);
    return first(plan);
  };
  EXPECT_EQ(with([](auto&) {}), "valid");
  EXPECT_EQ(with([](auto& path) { path.clear(); }), "'p' has an empty path");
  EXPECT_EQ(with([](auto& path) { path[1].vertex = VertexId(9); }),
            "'p' comes to a vertex that the roadmap does not have, at 1.2 s");
  EXPECT_EQ(with([](auto& path) { path[0].depart = -1; }).substr(0, 32),
            "'p' leaves before it arrives, or");
  EXPECT_EQ(with([](auto& path) { path.erase(path.begin()), path[0].arrive = path[0].depart = 0; }),
            "'p' does not begin at a");
  EXPECT_EQ(with([](auto& path) { path.pop_back(), path[0].depart = 0; }), "'p' does not end at b");
  EXPECT_EQ(with([](auto& path) {
              path = {{kA, 0, 0}, {kC, 200, 200}, {kB, 300, 300}};
            }).substr(0, 28),
            "'p' moves along no lane at 0");
  EXPECT_EQ(with([](auto& path) { path[1].arrive = path[1].depart = 121; }),
            "'p' takes longer or shorter for a lane than it does at its speed, at 0.2 s");
  EXPECT_EQ(with([](auto& path) {
              path = {{kA, 0, 50}, {kB, 150, 150}, {kC, 250, 250}, {kB, 350, 350}};
            }),
            "'p' and 'q' collide at 2 s");
  EXPECT_EQ(first({}), "the plan has not one path for each of the 2 robots");
}

TEST(FleetVerify, NamesNoGoalWhereThereAreSeveral) {
  Fleet fleet(test::line(4));
  fleet.robot({.name = "r", .body = Disc(0.1_m), .speed = 1_mps}).from(kA).to_any({kB, kC});
  continuous::Plan plan;
  plan.paths.push_back({{kA, 0, 0}});
  EXPECT_EQ(verify(fleet, plan).value().violations.front().message,
            "'r' does not end at any of its goals");
}

TEST(FleetVerify, KindsAndTimesAreThoseOfTheLayerBelow) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const Fleet fleet = test::random_fleet(seed, 3);
    const auto instance = fleet.instance();
    if (!instance) continue;
    continuous::Plan plan;  // Everybody jumps to the goal.
    for (const AgentId i : fleet.robot_ids())
      plan.paths.push_back({{*fleet.start(i), 0, 7}, {*fleet.goal(i), 107, 107}});
    const auto report = verify(fleet, plan).value();
    const auto below = continuous::verify(*instance, plan);
    ASSERT_EQ(report.violations.size(), below.violations.size());
    for (std::size_t k = 0; k < below.violations.size(); ++k) {
      EXPECT_EQ(report.violations[k].kind, below.violations[k].kind);
      EXPECT_EQ(report.violations[k].robot, below.violations[k].agent);
      EXPECT_EQ(report.violations[k].other, below.violations[k].other);
      EXPECT_EQ(report.violations[k].time.value(),
                continuous::in_input_units(below.violations[k].tick, instance->resolution()));
    }
  }
}

}  // namespace
}  // namespace quadrille::fleet
