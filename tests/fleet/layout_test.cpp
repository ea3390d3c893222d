// SPDX-License-Identifier: MIT
#include "quadrille/fleet/layout.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "quadrille/fleet/pose_builder.hpp"
#include "quadrille/fleet/solver.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

/// An L from A by B to C, 2 m each, for carts that back into B, where they turn as `at_b` says; the
/// station is at C, where they stand facing along x.
std::string layout(const std::string& at_b = "BOTH") {
  const std::string cart = R"("vehicleTypeId": "cart")";
  const auto node = [&](const char* id, const char* place, const std::string& more) {
    return std::string(R"({"nodeId": ")") + id + R"(", "nodePosition": {)" + place +
           R"(}, "vehicleTypeNodeProperties": [{)" + cart + more + "}]}";
  };
  const auto edge = [&](const char* from, const char* to, const std::string& more) {
    return std::string(R"({"edgeId": ")") + from + to + R"(", "startNodeId": ")" + from +
           R"(", "endNodeId": ")" + to + R"(", "vehicleTypeEdgeProperties": [{)" + cart + more +
           "}]}";
  };
  return R"({"metaInformation": {"lifVersion": "1.0.0"}, "layouts": [{"layoutId": "hall",)"
         "\n\"nodes\": [" +
         node("A", R"("x": 0, "y": 0)", "") + ", " + node("B", R"("x": 2, "y": 0)", "") + ", " +
         node("C", R"("x": 2, "y": 2)", R"(, "theta": 0)") + "],\n\"edges\": [" +
         edge("A", "B", R"(, "vehicleOrientation": 180, "maxSpeed": 0.5)") + ",\n" +
         edge("B", "C",
              R"(, "vehicleOrientation": 90, "orientationType": "GLOBAL", )"
              R"("rotationAtStartNodeAllowed": ")" +
                  at_b + R"(", "maxRotationSpeed": 7)") +
         "],\n" + R"("stations": [{"stationId": "dock", "interactionNodeIds": ["C"]}]}]})";
}

std::filesystem::path file_of(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "layout_test.json";
  std::ofstream(file) << text;
  return file;
}

/// What a cart takes from A, where it faces along x, to the station.
std::optional<Seconds> cost(const std::string& text, std::vector<std::string>* notes = nullptr) {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  const VertexId own = roads.vertex(-5_m, 0_m, "yard");
  const auto added = add_layout(roads, file_of(text)).value();
  EXPECT_EQ(added.vertices, (std::vector{VertexId(1), VertexId(2), VertexId(3)}));
  EXPECT_NE(own, added.vertices[0]);
  if (notes != nullptr) *notes = added.notes;
  const auto roadmap = roads.build().value();
  EXPECT_EQ(roadmap.name(added.vertices[1]), "B");
  EXPECT_EQ(added.stations, (std::vector{std::pair(std::string("dock"), VertexId(3))}));
  const auto poses = PoseBuilder(roadmap, 90_degps)
                         .rules(added.headings)
                         .heading(VertexId(1), 0_deg)
                         .build()
                         .value();
  Fleet fleet(poses.roadmap());
  fleet.robot({.body = Disc(0.3_m), .speed = 1_mps})
      .from(poses.facing(VertexId(1), 0_deg))
      .to_any(poses.any_heading(added.stations.front().second));
  const auto outcome = solve(fleet).value();
  if (outcome.plan) {
    const auto& last = (*outcome.plan)[AgentId(0)].stops().back();
    EXPECT_EQ(poses.heading(last.vertex), 0_deg);
  }
  return outcome.cost;
}

TEST(Layout, SaysHowRobotsFaceAndTurn) {
  std::vector<std::string> notes;
  // Half a turn, 2 m at half a metre per second, a quarter turn to the right, 2 m, and another one.
  EXPECT_EQ(cost(layout(), &notes), 2_s + 4_s + 1_s + 2_s + 1_s);
  EXPECT_TRUE(notes.empty()) << notes.front();
  EXPECT_EQ(cost(layout("CW"), &notes), 10_s);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "robots turn only as all edges allow that begin or end there at 'B'");
  EXPECT_EQ(cost(layout("CCW")), 2_s + 4_s + 3_s + 2_s + 1_s);
  EXPECT_EQ(cost(layout("NONE")), std::nullopt);
}

TEST(Layout, SaysWhatIsWrong) {
  RoadmapBuilder roads;
  const auto message = [&](const std::string& text) {
    return add_layout(roads, file_of(text)).error().to_string();
  };
  const auto is = [](const std::string& text, const std::string& end) {
    return text.ends_with("layout_test.json" + end);
  };
  EXPECT_TRUE(is(message(layout("LEFT")),
                 ":4: /layouts/0/edges/1/vehicleTypeEdgeProperties/0/rotationAtStartNodeAllowed: "
                 "expected NONE, CCW, CW or BOTH, found 'LEFT'"))
      << message(layout("LEFT"));
  EXPECT_EQ(add_layout(roads, file_of("{}")).error().code, ErrorCode::syntax);
  EXPECT_EQ(add_layout(roads, "no such file").error().code, ErrorCode::io);
  EXPECT_EQ(add_layout(roads, file_of(layout()), {.layout = "attic"}).error().code,
            ErrorCode::invalid_instance);
  EXPECT_EQ(roads.num_vertices(), 0U);
}

}  // namespace
}  // namespace quadrille::fleet
