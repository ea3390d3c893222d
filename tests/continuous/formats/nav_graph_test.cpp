// SPDX-License-Identifier: MIT
#include "quadrille/continuous/nav_graph.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace quadrille::continuous::test {
namespace {

constexpr Resolution kMillimetres{1e-3};

Result<MapFile> read(const std::string& text) {
  std::istringstream in(text);
  return read_nav_graph(in, "nav.yaml", {kMillimetres, kUnitSpeed});
}

TEST(NavGraph, HasVerticesNamesAndLanes) {
  const auto graph = read(
      "building_name: b\n"
      "levels:\n"
      "  L1:\n"
      "    vertices:\n"
      "    - [10.5, -5.5, {name: c1, is_charger: true, is_parking_spot: true}]\n"
      "    - [12.0, -5.5, {name: \"\"}]\n"
      "    - [12, -2.5, {is_passthrough_point: true}]\n"
      "    lanes:\n"
      "    - [0, 1, {speed_limit: 0.5, mutex: \"\", orientation_constraint: forward}]\n"
      "    - [1, 0, {}]\n"
      "    - [1, 2, {speed_limit: 2.0}]\n"
      "    - [2, 1, {speed_limit: 0, door_name: d1}]\n"
      "  L2: {vertices: [], lanes: []}\n");
  ASSERT_TRUE(graph.has_value()) << graph.error().to_string();
  EXPECT_EQ(std::get<Roadmap>(graph->map).positions(),
            (std::vector<Point>{{10'500, -5'500}, {12'000, -5'500}, {12'000, -2'500}}));
  EXPECT_EQ(graph->names.places,
            (std::vector<std::pair<std::string, VertexId>>{{"c1", VertexId(0)}}));
  const VertexId a(0), b(1), c(2);
  std::vector<Edge> lanes{{a, b, {}}, {b, a, {}}, {b, c, {}}, {c, b, {}}};
  lanes[0].speed_limit = kUnitSpeed / 2;
  lanes[2].speed_limit = 2 * kUnitSpeed;
  EXPECT_EQ(std::get<Roadmap>(graph->map).edges(), lanes);
  EXPECT_EQ(std::get<Roadmap>(graph->map).no_waiting(), std::vector{c});
  EXPECT_EQ(graph->num_zero_length_edges, 0u);
}

TEST(NavGraph, LanesOfLengthZeroTakeATick) {
  const auto graph = read("levels: {L1: {vertices: [[0, 0], [0, 0]], lanes: [[0, 1]]}}\n");
  ASSERT_TRUE(graph.has_value()) << graph.error().to_string();
  EXPECT_EQ(std::get<Roadmap>(graph->map).edges().front().duration, Ticks(1));
  EXPECT_EQ(graph->num_zero_length_edges, 1u);
}

TEST(NavGraph, SaysWhatIsWrongAndWhere) {
  const auto refuses = [](const std::string& text, const std::string& why) {
    const auto graph = read(text);
    ASSERT_FALSE(graph.has_value()) << why;
    EXPECT_EQ(graph.error().to_string(), why);
  };
  refuses("levels: [1\n", "nav.yaml:2: not valid YAML: end of sequence flow not found");
  refuses("a: 1\n",
          "nav.yaml:1: a nav graph of Open-RMF has the key 'levels', which is missing here");
  refuses("levels: {L1: {}}\n",
          "nav.yaml:1: /levels/L1: a level has the key 'vertices', which is missing here");
  refuses("levels: {L1: {vertices: []}}\n", "nav.yaml:1: /levels: there are no vertices");
  refuses("levels:\n  L1: {vertices: [[0, 0]]}\n  L2: {vertices: [[0, 0]]}\n",
          "nav.yaml:2: /levels: there are several levels with vertices, --level says which is "
          "meant: 'L1', 'L2'");
  refuses("levels:\n  L1:\n    vertices: [[0, 0], [1, x]]\n",
          "nav.yaml:3: /levels/L1/vertices/1/1: expected a number, found 'x'");
  refuses("levels:\n  L1:\n    vertices: [[0]]\n",
          "nav.yaml:3: /levels/L1/vertices/0: expected [x, y, {properties}]");
  refuses(
      "levels:\n  L1:\n    vertices: [[0, 1e300]]\n",
      "nav.yaml:3: /levels/L1/vertices/0: the coordinate 1e+300 is too large: at a resolution of "
      "0.001 there is room up to 1099511627; with --resolution 1" +
          std::string(288, '0') + " there is enough");
  const std::string two = "levels:\n  L1:\n    vertices: [[0, 0], [1, 0]]\n    lanes:\n    - ";
  refuses(two + "[0, 2]\n", "nav.yaml:5: /levels/L1/lanes/0/1: there is no vertex 2 among 2");
  refuses(two + "[0, -1]\n",
          "nav.yaml:5: /levels/L1/lanes/0/1: -1 is not between 0 and 9223372036854775807");
  refuses(two + "[1, 1]\n", "nav.yaml:5: /levels/L1/lanes/0: the lane is a loop");
  refuses(two + "[0, 1, {mutex: m1}]\n",
          "nav.yaml:5: /levels/L1/lanes/0/2/mutex: mutex groups are not supported");
  refuses(two + "[0, 1, {speed_limit: fast}]\n",
          "nav.yaml:5: /levels/L1/lanes/0/2/speed_limit: expected a number, found 'fast'");
  refuses("levels: {L1: {vertices: [[0, 0, {is_passthrough_point: 1}]], lanes: []}}\n",
          "nav.yaml:1: /levels/L1/vertices/0/2/is_passthrough_point: expected true or false");
  refuses(two + "[0, 1, {speed_limit: -1}]\n",
          "nav.yaml:5: /levels/L1/lanes/0/2/speed_limit: the speed is not supported");
  refuses(two + "[0, 1, {speed_limit: nan}]\n",
          "nav.yaml:5: /levels/L1/lanes/0/2/speed_limit: expected a number, found 'nan'");
  refuses(two + "[0, 1, {speed_limit: 1, speed_limit: 2}]\n",
          "nav.yaml:5: /levels/L1/lanes/0/2/speed_limit: the key is there twice");
  refuses("levels:\n  L1: &a {vertices: [[0, 0]]}\n", "nav.yaml:2: anchors are not accepted");
}

}  // namespace
}  // namespace quadrille::continuous::test
