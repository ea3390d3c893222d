// SPDX-License-Identifier: MIT
#include "quadrille/fleet/samples.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "fleet/support.hpp"
#include "quadrille/text/document.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

/// Two robots that stay and go, the second one with a name that needs care.
TimedPlan plan_of_two() {
  Fleet fleet(test::line(4, {.length = 1_mm, .time = 50_ms}));
  const RobotSpec spec{.name = "p", .body = Disc(0.2_m), .speed = 2_mps};
  fleet.robot(spec).from(VertexId(0)).to(VertexId(0));
  fleet.robot({.name = "the \"slow\", one", .body = Disc(0.2_m), .speed = 1_mps})
      .from(VertexId(2))
      .to(VertexId(3));
  return TimedPlan::make(fleet, {{continuous::Path{{VertexId(0), 0, 0}},
                                  continuous::Path{{VertexId(2), 0, 2}, {VertexId(3), 22, 22}}}})
      .value();
}

TEST(FleetSamples, Csv) {
  std::ostringstream out;
  ASSERT_EQ(write_samples_csv(out, "out", plan_of_two(), 2_Hz), std::nullopt);
  EXPECT_EQ(out.str(),
            "robot,time_s,x_m,y_m,vx_mps,vy_mps\n"
            "p,0,0,0,0,0\n"
            "\"the \"\"slow\"\", one\",0,2,0,0,0\n"
            "\"the \"\"slow\"\", one\",0.5,2.4,0,1,0\n"
            "\"the \"\"slow\"\", one\",1,2.9,0,1,0\n"
            "\"the \"\"slow\"\", one\",1.5,3,0,0,0\n");
}

TEST(FleetSamples, Heights) {
  RoadmapBuilder roads({.length = 1_mm, .time = 50_ms});
  const VertexId low = roads.vertex(0_m, 0_m, 1_m), high = roads.vertex(0_m, 3_m, 5_m);
  Fleet fleet(roads.road(low, high).build().value());
  fleet.robot({.name = "p", .body = Disc(0.2_m), .speed = 1.25_mps}).from(low).to(high);
  const TimedPlan plan =
      TimedPlan::make(fleet, {{continuous::Path{{low, 0, 0}, {high, 80, 80}}}}).value();
  EXPECT_EQ(plan[AgentId(0)].at(1_s), (Point{0_m, 0.75_m, 2_m}));
  EXPECT_EQ(plan[AgentId(0)].velocity(1_s), (Velocity{0_mps, 0.75_mps, 1_mps}));
  std::ostringstream csv, json;
  ASSERT_EQ(write_samples_csv(csv, "out", plan, 1_Hz), std::nullopt);
  EXPECT_EQ(csv.str(),
            "robot,time_s,x_m,y_m,z_m,vx_mps,vy_mps,vz_mps\n"
            "p,0,0,0,1,0,0.75,1\n"
            "p,1,0,0.75,2,0,0.75,1\n"
            "p,2,0,1.5,3,0,0.75,1\n"
            "p,3,0,2.25,4,0,0.75,1\n"
            "p,4,0,3,5,0,0,0\n");
  ASSERT_EQ(write_samples_json(json, "out", plan, 1_Hz), std::nullopt);
  EXPECT_NE(json.str().find("[1, 0, 0.75, 2, 0, 0.75, 1]"), std::string::npos);
}

TEST(FleetSamples, JsonHoldsTheSameNumbers) {
  const TimedPlan plan = plan_of_two();
  std::ostringstream out;
  ASSERT_EQ(write_samples_json(out, "out", plan, 20_Hz), std::nullopt);
  const auto document = text::parse_json(out.str(), "out").value();
  text::Checker check(document);
  std::optional<text::Document::Node> kind, version, rate, robots;
  ASSERT_TRUE(check.members(
      text::Document::kRoot,
      {{"quadrille", &kind}, {"version", &version}, {"rate_hz", &rate}, {"robots", &robots}}));
  EXPECT_EQ(document.text(*kind), "samples");
  EXPECT_EQ(document.number(*rate), 20);
  auto robot = document.first(*robots);
  for (const AgentId i : plan.robot_ids()) {
    std::optional<text::Document::Node> name, samples;
    ASSERT_TRUE(check.members(robot, {{"name", &name}, {"samples", &samples}}));
    EXPECT_EQ(document.text(*name), plan[i].name());
    std::vector<Sample> read;
    for (auto s = document.first(*samples); s < document.next(*samples); s = document.next(s)) {
      std::vector<double> n;
      for (auto x = document.first(s); x < document.next(s); x = document.next(x))
        n.push_back(document.number(x));
      ASSERT_EQ(n.size(), 5u);
      read.push_back({Seconds(n[0]),
                      {Metres(n[1]), Metres(n[2])},
                      {MetresPerSecond(n[3]), MetresPerSecond(n[4])}});
    }
    EXPECT_EQ(read, plan[i].samples(20_Hz));
    robot = document.next(robot);
  }
  EXPECT_EQ(robot, document.next(*robots));
}

TEST(FleetSamples, AFullDiskIsReported) {
  std::ofstream full("/dev/full");
  if (!full.is_open()) GTEST_SKIP() << "there is no /dev/full";
  const auto error = write_samples_csv(full, "out", plan_of_two(), 20_Hz);
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::io);
}

}  // namespace
}  // namespace quadrille::fleet
