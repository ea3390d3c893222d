// SPDX-License-Identifier: MIT
#include "quadrille/fleet/nav_graph.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "quadrille/fleet/solver.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

constexpr const char* kBuilding =
    "building_name: b\n"
    "levels:\n"
    "  L1:\n"
    "    vertices:\n"
    "    - [0, 0, {name: dock}]\n"
    "    - [4, 0, {name: \"\"}]\n"
    "    - [4, -3, {name: desk}]\n"
    "    lanes:\n"
    "    - [0, 1, {speed_limit: 0.5}]\n"
    "    - [1, 0, {}]\n"
    "    - [1, 2, {}]\n"
    "  L2:\n"
    "    vertices: [[0, 0, {name: roof}], [1, 0, {}]]\n"
    "    lanes: [[0, 1, {}]]\n";

std::filesystem::path file_of(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "nav_graph_test.yaml";
  std::ofstream(file) << text;
  return file;
}

TEST(NavGraph, BecomesPartOfARoadmapWithNamesAndLimits) {
  RoadmapBuilder roads;
  const VertexId own = roads.vertex(-2_m, 0_m, "yard");
  const auto added = add_nav_graph(roads, file_of(kBuilding), {.level = "L1", .speed = 1_mps});
  ASSERT_TRUE(added.has_value()) << added.error().to_string();
  ASSERT_EQ(added->vertices.size(), 3u);
  roads.road(own, added->vertices[0]);
  const auto roadmap = roads.build();
  ASSERT_TRUE(roadmap.has_value()) << roadmap.error().to_string();
  EXPECT_EQ(roadmap->num_lanes(), 5u);
  ASSERT_EQ(roadmap->find("desk"), added->vertices[2]);
  EXPECT_EQ(roadmap->position(*roadmap->find("desk")), (Point{4_m, -3_m}));
  EXPECT_EQ(roadmap->name(own), "yard");
  Fleet fleet(*roadmap);
  const Robot amr =
      fleet.robot({.body = Disc(0.3_m), .speed = 1_mps}).from(own).to(*roadmap->find("desk"));
  const auto plan = solve(fleet, {});
  ASSERT_TRUE(plan.has_value()) << plan.error().to_string();
  // Two metres, four at half a metre per second, and three.
  EXPECT_EQ((*plan->plan)[amr].cost(), 2_s + 8_s + 3_s);
}

TEST(NavGraph, SaysWhatIsWrong) {
  RoadmapBuilder roads;
  const auto several = add_nav_graph(roads, file_of(kBuilding));
  ASSERT_FALSE(several.has_value());
  EXPECT_NE(several.error().to_string().find("'L1', 'L2'"), std::string::npos)
      << several.error().to_string();
  const auto none = add_nav_graph(roads, "there/is/none.yaml");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, ErrorCode::io);
  EXPECT_FALSE(
      add_nav_graph(roads, file_of(kBuilding), {.level = "L1", .speed = -1_mps}).has_value());
  EXPECT_EQ(roads.num_vertices(), 0u);
}

TEST(NavGraph, LanesMayTakeATimeOfTheirOwn) {
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(0_m, 0_m), b = roads.vertex(1_m, 0_m);
  roads.lane(a, b, {.duration = 2.5_s});
  const auto roadmap = roads.build();
  ASSERT_TRUE(roadmap.has_value());
  EXPECT_EQ(roadmap->in_units()->edges().front().duration, continuous::Ticks(250));
  EXPECT_FALSE(RoadmapBuilder(roads).lane(a, b).build().has_value());
  EXPECT_TRUE(RoadmapBuilder(roads).lane(a, b, {.duration = 2.5_s}).build().has_value());
  for (const Seconds time : {0_s, -1_s, 1e30_s})
    EXPECT_FALSE(RoadmapBuilder(roads).lane(b, a, {.duration = time}).build().has_value());
}

}  // namespace
}  // namespace quadrille::fleet
