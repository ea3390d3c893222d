// SPDX-License-Identifier: MIT
//
// Roadmaps as other programs write them: the right roadmap, and the right reason.
#include <gtest/gtest.h>

#include <sstream>

#include "continuous/support/random_instance.hpp"
#include "formats/samples.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/continuous/roadmap_xml.hpp"

namespace quadrille::continuous::test {
namespace {

using formats::kGml;
using formats::kLif;
using formats::kNavGraph;
using formats::kNetworkx;
using formats::kRouteGraph;
using formats::kYed;

MapFileOptions options() { return {Resolution{1e-3}, kUnitSpeed}; }

Result<MapFile> read(const std::string& text, const MapFileOptions& with = options()) {
  std::istringstream in(text);
  return read_map_file(in, "f", with);
}

const Roadmap& roadmap_of(const MapFile& map) { return std::get<Roadmap>(map.map); }

/// "0-1 1-2:2000", in the order of the file.
std::string edges_of(const MapFile& map) {
  std::string text;
  for (const Edge& edge : roadmap_of(map).edges()) {
    text += (text.empty() ? "" : " ") + std::to_string(edge.from.index()) + "-" +
            std::to_string(edge.to.index());
    if (edge.duration) text += ":" + std::to_string(edge.duration->value());
    if (edge.speed_limit) text += "@" + std::to_string(edge.speed_limit->value() / 1000);
  }
  return text;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void refuses(const std::string& text, const std::string& why,
             const MapFileOptions& with = options()) {
  const auto map = read(text, with);
  ASSERT_FALSE(map.has_value()) << why;
  EXPECT_EQ(map.error().to_string().substr(0, why.size()), why);
}

TEST(MapFiles, LayoutsOfLif) {
  const auto map = read(kLif);
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  EXPECT_EQ(roadmap_of(*map).positions(),
            (std::vector<Point>{{0, 0}, {2'000, 0}, {2'000, -1'500}}));
  // Thousandths of a metre per second.
  EXPECT_EQ(edges_of(*map), "0-1@500 1-0@3000 1-2 2-1");
  EXPECT_TRUE(map->names.are_ids);
  EXPECT_EQ(map->names.find("B", 3).value(), VertexId(1));
  EXPECT_EQ(map->names.find("dock", 3).value(), VertexId(2));
  // No id is a number, so that these are free for the vertices.
  EXPECT_EQ(map->names.find("1", 3).value(), VertexId(1));
  EXPECT_EQ(map->names.find("3", 3).error().message, "there is no vertex '3'");
  EXPECT_EQ(map->names.find("", 3).error().message, "there is no vertex ''");
  EXPECT_EQ(map->notes, (std::vector<std::string>{"'trajectory' of an edge is not used (1 time)"}));
}

TEST(MapFiles, OfSeveralLayoutsAndTypesOneIsAskedFor) {
  const std::string two = changed(kLif, "]}]}]}\n",
                                  "]}]}, {\"layoutId\": \"up\", \"layoutLevelId\": \"2\", "
                                  "\"nodes\": [], \"edges\": []}]}\n");
  refuses(two,
          "f:2: /layouts: there are several layouts, --level says which is meant: 'hall', 'up'");
  MapFileOptions with = options();
  with.level = "hall";
  EXPECT_EQ(edges_of(read(two, with).value()), "0-1@500 1-0@3000 1-2 2-1");
  with.level = "2";
  EXPECT_EQ(roadmap_of(read(two, with).value()).num_vertices(), 0u);
  with.level = "cellar";
  refuses(two, "f:2: /layouts: no layout is called 'cellar': 'hall', 'up'", with);

  const std::string types =
      changed(kLif, "{\"vehicleTypeId\": \"cart\", \"maxSpeed\": 0.5}",
              "{\"vehicleTypeId\": \"cart\", \"maxSpeed\": 0.5}, {\"vehicleTypeId\": \"lift\"}");
  refuses(types, "f:2: /layouts/0: there are several types of vehicles, --vehicle-type says which");
  with.level = "";
  with.vehicle_type = "cart";
  EXPECT_EQ(edges_of(read(types, with).value()), "0-1@500 1-0@3000 1-2 2-1");
  // It may go nowhere: nodes have to name it, too.
  with.vehicle_type = "lift";
  EXPECT_EQ(edges_of(read(types, with).value()), "");
  with.vehicle_type = "crane";
  refuses(types, "f:2: /layouts/0: no type of vehicles is called 'crane', only 'cart', 'lift'",
          with);
}

TEST(MapFiles, LifSaysWhatIsWrong) {
  refuses(changed(kLif, "1.0.0", "2.0.0"),
          "f:1: /metaInformation/lifVersion: version '2.0.0' of LIF, not 1.0");
  refuses(changed(kLif, "\"endNodeId\": \"B\"", "\"endNodeId\": \"X\""),
          "f:6: /layouts/0/edges/0: the target 'X' of an edge is no node");
  refuses(changed(kLif, "\"nodeId\": \"B\"", "\"nodeId\": \"A\""),
          "f:4: /layouts/0/nodes/1: another node has the id 'A'");
  refuses(changed(kLif, "\"x\": 2", "\"x\": \"2\""),
          "f:4: /layouts/0/nodes/1/nodePosition/x: expected a number, found a string");
  refuses(changed(kLif, "\"interactionNodeIds\": [\"C\"]", "\"interactionNodeIds\": [\"D\"]"),
          "f:10: /layouts/0/stations/0/interactionNodeIds/0: there is no node 'D'");
  refuses(changed(kLif, "[{\"vehicleTypeId\": \"cart\", \"maxSpeed\": 0.5}]", "[]"),
          "f:6: /layouts/0/edges/0/vehicleTypeEdgeProperties: this must not be empty in a LIF");
  refuses(changed(kLif, "\"maxSpeed\": 0.5", "\"maxSpeed\": -1"),
          "f:6: /layouts/0/edges/0: the speed is not supported");
}

TEST(MapFiles, GraphsOfNav2) {
  const auto map = read(kRouteGraph);
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  EXPECT_EQ(roadmap_of(*map).positions(), (std::vector<Point>{{0, 0}, {1'000, 0}, {1'000, 2'500}}));
  EXPECT_EQ(edges_of(*map), "0-1@500 1-0 1-2");
  // Ids from 1 on are no numbers of vertices.
  EXPECT_TRUE(map->names.are_ids);
  EXPECT_EQ(map->names.find("3", 3).value(), VertexId(2));
  EXPECT_FALSE(map->names.find("0", 3).has_value());
  EXPECT_EQ(map->notes, (std::vector<std::string>{"'cost' of an edge is not used (1 time)",
                                                  "'operations' of a node is not used (1 time)"}));
  refuses(changed(kRouteGraph, "\"startid\": 2", "\"startid\": 7"),
          "f:6: /features/4: the source '7' of an edge is no node");
  refuses(changed(kRouteGraph, "\"frame\": \"map\"", "\"frame\": \"odom\""),
          "f:4: /features/2/properties/frame: the frame 'map', and another node is in 'odom'");
  refuses(changed(kRouteGraph, "[1.0, 2.5]", "[1.0]"),
          "f:4: /features/2/geometry/coordinates: expected two coordinates");
  refuses(changed(kRouteGraph, "FeatureCollection", "Feature"), "f:1: /type: expected 'FeatureC");
}

TEST(MapFiles, GraphmlOfNetworkx) {
  const auto map = read(kNetworkx);
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  EXPECT_EQ(roadmap_of(*map).positions(), (std::vector<Point>{{0, 0}, {1'000, 0}, {1'000, 500}}));
  EXPECT_EQ(edges_of(*map), "1-0 0-1 1-2 2-1");
  EXPECT_TRUE(map->names.are_ids);
  EXPECT_EQ(map->names.find("(0, 1)", 3).value(), VertexId(1));
  refuses(changed(kNetworkx, "<data key=\"d0\">1.0</data>", "<data key=\"d0\">one</data>"),
          "f:7: node '(0, 1)': x is 'one', not a finite number");
  refuses(changed(kNetworkx, "target=\"west\"", "target=\"east\""),
          "f:9: the target 'east' of an edge is no node");
  refuses(changed(kNetworkx, "attr.name=\"y\"", "attr.name=\"b\""),
          "f:2: nodes have no places: there is no <key for=\"node\"> with the attr.name coords");
  refuses(changed(kNetworkx, "edgedefault=\"undirected\"", "edgedefault=\"\""),
          "f:5: edgedefault has to be \"directed\" or \"undirected\"");
}

TEST(MapFiles, GraphmlInSpace) {
  std::string text = formats::kOmplInSpace;
  const auto map = read(text);
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  EXPECT_EQ(roadmap_of(*map).positions(), (std::vector<Point>{{0, 0, 1'000}, {3'000, 0, -1'500}}));
  ASSERT_EQ(map->notes.size(), 1u);
  EXPECT_NE(map->notes[0].find("read as a height"), std::string::npos);
  refuses(changed(text, "3,0,-1.5", "3,0,-1.5,1"),
          "f:5: node 'n1' has the coordinates '3,0,-1.5,1', not two or three finite numbers");
}

TEST(MapFiles, GraphmlOfYed) {
  const auto map = read(kYed);
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  // The middle of a picture.
  EXPECT_EQ(roadmap_of(*map).positions(),
            (std::vector<Point>{{25'000, 35'000}, {120'000, 10'000}}));
  EXPECT_EQ(edges_of(*map), "0-1");
  EXPECT_FALSE(map->names.are_ids);
  EXPECT_EQ(map->names.find("lift", 2).value(), VertexId(1));
  EXPECT_EQ(map->names.find("0", 2).value(), VertexId(0));
  EXPECT_EQ(map->names.find("n1", 2).value(), VertexId(1));
  refuses(changed(kYed, "width=\"40.0\" ", ""), "f:6: node 'n0' has no picture with <y:Geometry");
}

TEST(MapFiles, NodesInAnyOrderHaveTheirNumbers) {
  const char* const nodes[] = {"<node id=\"n0\"><data key=\"c\">0,0</data></node>",
                               "<node id=\"n2\"><data key=\"c\">2,0</data></node>",
                               "<node id=\"n1\"><data key=\"c\">1,0</data></node>"};
  const std::string text =
      std::string("<graphml><key id=\"c\" for=\"node\" attr.name=\"coords\"/>") +
      "<graph edgedefault=\"directed\">" + nodes[0] + nodes[1] + nodes[2] +
      "<edge source=\"n1\" target=\"n2\"/></graph></graphml>";
  const auto map = read(text).value();
  EXPECT_EQ(roadmap_of(map).positions(), (std::vector<Point>{{0, 0}, {1'000, 0}, {2'000, 0}}));
  EXPECT_EQ(edges_of(map), "1-2");
  EXPECT_FALSE(map.names.are_ids);
  // Not if there is a gap, or a letter is missing.
  for (const char* const id : {"n3", "1", "n01"}) {
    const auto other = read(changed(changed(text, "id=\"n1\"", std::string("id=\"") + id + "\""),
                                    "source=\"n1\"", std::string("source=\"") + id + "\""))
                           .value();
    EXPECT_TRUE(other.names.are_ids) << id;
    EXPECT_EQ(edges_of(other), "2-1") << id;
  }
}

TEST(MapFiles, Gml) {
  const auto map = read(kGml);
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  EXPECT_EQ(roadmap_of(*map).positions(), (std::vector<Point>{{0, 0}, {1'000, -500}, {2'000, 0}}));
  EXPECT_EQ(edges_of(*map), "0-1 1-0 1-2 2-1");
  EXPECT_EQ(map->names.find("west", 3).value(), VertexId(0));
  EXPECT_EQ(edges_of(read(changed(kGml, "directed 0", "directed 1")).value()), "0-1 1-2");
  refuses(changed(kGml, "x 0.0", "x \"0\""), "f:3: /graph/node/x: expected a number, found a str");
  refuses(changed(kGml, "x 0.0", "x zero"),
          "f:3: not valid GML: expected a number, a text or a list, found 'zero'");
  refuses(changed(kGml, "x 0.0 y 0.0", "x 0.0"), "f:3: /graph/node: the node has no place");
  refuses(changed(kGml, "target 2", "target 5"),
          "f:7: /graph/edge: the target '5' of an edge is no node");
  refuses(kGml + "]", "f:9: not valid GML: ']' without '['");
  refuses(kGml.substr(0, kGml.size() - 2), "f:8: not valid GML: the file ends before a ']'");
}

TEST(MapFiles, LevelsAndLanesBothWaysOfNavGraphs) {
  refuses(kNavGraph,
          "f:4: /levels: there are several levels with vertices, --level says which is meant: "
          "'L1', 'L2'");
  MapFileOptions with = options();
  with.level = "L1";
  const auto map = read(kNavGraph, with);
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  EXPECT_EQ(edges_of(*map), "0-1@500 1-0@500 1-2");
  EXPECT_EQ(map->names.find("lift", 3).value(), VertexId(2));
  with.level = "L2";
  EXPECT_EQ(roadmap_of(read(kNavGraph, with).value()).num_vertices(), 2u);
  with.level = "L3";
  refuses(kNavGraph, "f:4: /levels: no level with vertices is called 'L3', only 'L1', 'L2'", with);
  with.level = "L1";
  refuses(changed(kNavGraph, "is_bidirectional: true", "is_bidirectional: maybe"),
          "f:9: /levels/L1/lanes/0/2/is_bidirectional: expected true or false", with);
}

TEST(MapFiles, TasksNamePlaces) {
  MapFileOptions with = options();
  with.level = "L1";
  const MapFile map = read(kNavGraph, with).value();
  const auto agents = [&](const std::string& start, const std::string& goal) {
    std::istringstream in("<root>\n<agent start_id=\"" + start + "\" goal_id=\"" + goal +
                          "\"/>\n</root>\n");
    const auto task = read_task_xml(in, "t").value();
    return agents_of(task, 1, roadmap_of(map), 100, kUnitSpeed, map.names);
  };
  for (const auto& [start, goal] :
       {std::pair("dock", "lift"), std::pair("0", "lift"), std::pair("dock", "2")}) {
    const auto found = agents(start, goal);
    ASSERT_TRUE(found.has_value()) << found.error().to_string();
    EXPECT_EQ(found->front().start, VertexId(0));
    EXPECT_EQ(found->front().goals, Goals(VertexId(2)));
  }
  EXPECT_EQ(agents("dock", "roof").error().to_string(),
            "t:2: the goal of agent 0: there is no vertex 'roof'");
  EXPECT_EQ(agents("7", "dock").error().to_string(),
            "t:2: the start of agent 0: there is no vertex '7'");
}

TEST(MapFiles, OfUtmCoordinatesSayWhatHelps) {
  const std::string text = changed(kRouteGraph, "[1.0, 2.5]", "[567890.5, 5934567.25]");
  MapFileOptions fine = options();
  fine.resolution = Resolution{1e-6};
  refuses(text,
          "f:4: /features/2/geometry/coordinates: the coordinate 5934567.25 is too large: at a "
          "resolution of 1e-06 there is room up to 1099511; with --resolution 0.00001 there is "
          "enough",
          fine);
  fine.resolution = Resolution{1e-5};
  EXPECT_TRUE(read(text, fine).has_value());
}

TEST(MapFiles, OfOtherKindsAreCalledByTheirNames) {
  refuses("coordinate_system: reference_image\nlevels:\n  L1:\n    vertices: []\n",
          "f:1: this is a building of Open-RMF's traffic editor, in pixels: 'building_map_gen");
  refuses("{\"quadrille\": \"instance\", \"roadmap\": {}}",
          "f:1: this is a roadmap with agents in our own JSON: it belongs to --instance");
  refuses("1 2 3\n", "f:1: neither XML, which begins with '<', nor anything else that is known");
  refuses("", "f:1: the file is empty");
}

/// The same roadmap in each format is the same roadmap.
TEST(MapFiles, RandomRoadmapsAreTheSameInAllFormats) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    Draw draw(seed);
    const auto count = static_cast<std::size_t>(draw.number(2, 9));
    std::vector<Point> places;
    for (std::size_t v = 0; v < count; ++v) {
      const Length x = draw.length(-9'999, 9'999);
      places.push_back({x, draw.length(-9'999, 9'999)});
    }
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b)
        if (a != b && draw.chance(30)) edges.emplace_back(a, b);
    const std::string texts[] = {formats::graphml_of(places, edges), formats::gml_of(places, edges),
                                 formats::route_graph_of(places, edges),
                                 formats::lif_of(places, edges),
                                 formats::nav_graph_of(places, edges)};
    std::vector<Edge> expected;
    for (const auto& [a, b] : edges) {
      expected.push_back({VertexId(a), VertexId(b), std::nullopt});
      if (places[a] == places[b]) expected.back().duration = Ticks(1);
    }
    for (const std::string& text : texts) {
      const auto map = read(text);
      ASSERT_TRUE(map.has_value()) << map.error().to_string() << "\n" << text;
      EXPECT_EQ(roadmap_of(*map).positions(), places) << text;
      EXPECT_EQ(roadmap_of(*map).edges(), expected) << text;
    }
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
