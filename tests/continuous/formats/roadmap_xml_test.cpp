// SPDX-License-Identifier: MIT
#include "quadrille/continuous/roadmap_xml.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "continuous/formats/file_support.hpp"

namespace quadrille::continuous {
namespace {

constexpr double kResolution = 1e-6;

auto read_map(std::istream& in) { return read_map_xml(in, "f", kResolution); }
auto read_task(std::istream& in) { return read_task_xml(in, "f"); }

OccupancyGrid cells() {
  return std::get<OccupancyGrid>(read_map_xml(test::data("cells.xml"), kResolution).value().map);
}

TEST(RoadmapXml, ReadsGraphml) {
  const MapFile map = read_map_xml(test::data("roadmap.xml"), kResolution).value();
  const Roadmap& roadmap = std::get<Roadmap>(map.map);
  EXPECT_EQ(roadmap.positions(), (std::vector<Point>{{0, 0}, {1'500'000, -2'000'000}}));
  EXPECT_EQ(roadmap.edges(), (std::vector<Edge>{{VertexId(0), VertexId(1), std::nullopt},
                                                {VertexId(1), VertexId(0), std::nullopt}}));
  EXPECT_EQ(map.num_zero_length_edges, 0u);
}

TEST(RoadmapXml, EdgesOfLengthZeroTakeOneTickAndAreCounted) {
  const test::Fault same{"1.5,-2", "0,0.0000001", ""};
  std::istringstream in(test::with_fault(test::contents(test::data("roadmap.xml")), same));
  const MapFile map = read_map_xml(in, "f", kResolution).value();
  EXPECT_EQ(map.num_zero_length_edges, 2u);
  EXPECT_EQ(std::get<Roadmap>(map.map).edge(EdgeId(0)).duration, Ticks{1});
}

TEST(RoadmapXml, UndirectedEdgesLeadBothWays) {
  const auto edges = [](const char* directed) {
    const test::Fault change{"id=\"e1\" source", std::string(directed) + " source", ""};
    std::istringstream in(test::with_fault(test::contents(test::data("roadmap.xml")), change));
    return std::get<Roadmap>(read_map_xml(in, "f", kResolution).value().map).edges();
  };
  const Edge there{VertexId(0), VertexId(1), std::nullopt};
  const Edge back{VertexId(1), VertexId(0), std::nullopt};
  EXPECT_EQ(edges("directed=\"false\""), (std::vector<Edge>{there, back, there}));
  EXPECT_EQ(edges("directed=\"true\""), (std::vector<Edge>{there, back}));
}

TEST(RoadmapXml, WhatSurroundsTheNumbersDoesNotMatter) {
  const std::string file = test::contents(test::data("roadmap.xml"));
  const auto roadmap = [&](const std::string& text) {
    std::istringstream in(text);
    return std::get<Roadmap>(read_map_xml(in, "f", kResolution).value().map).positions();
  };
  const std::vector<Point> expected = roadmap(file);
  const std::vector<test::Fault> changes = {
      {"1.5,-2", " 1.5 , -2\n<!-- & <here> \"'--> ", ""},
      {"1.5,-2", "<![CDATA[1.5,-2]]>", ""},
      {"1.5,-2", "&#49;.5&#x2c;-2", ""},
      {"<graph id", "<desc a='&lt;\"&amp;'>it's &quot;&apos;&gt;</desc><?skip & < ?><graph id", ""},
  };
  for (const test::Fault& change : changes)
    EXPECT_EQ(roadmap(test::with_fault(file, change)), expected) << change.to;
}

TEST(RoadmapXml, ReadsGridsAndTasks) {
  const OccupancyGrid grid = cells();
  EXPECT_EQ(grid.width, 4);
  EXPECT_EQ(grid.height, 2);
  EXPECT_EQ(grid.passable, (std::vector<bool>{1, 1, 0, 1, 1, 1, 1, 1}));
  const TaskXml task = read_task_xml(test::data("tasks.xml")).value();
  ASSERT_EQ(task.rows.size(), 2u);
  EXPECT_EQ(task.rows[0].line, 2);
  EXPECT_EQ(task.rows[1].line, 3);
  const auto roadmap = GridRoadmap::make(grid, 2, 300'000, kResolution).value();
  const auto agents = agents_of(task, 2, roadmap, 300'000, kUnitSpeed).value();
  EXPECT_EQ(roadmap.cell(agents[0].goal()), (Cell{3, 0}));
  EXPECT_EQ(roadmap.cell(agents[1].start), (Cell{3, 1}));
  EXPECT_EQ(roadmap.cell(agents[1].goal()), (Cell{0, 1}));
}

TEST(RoadmapXml, RefusesWrongRoadmaps) {
  const std::vector<test::Fault> faults = {
      {"", "", "f:1: the file is empty"},
      {"", " \n ", "f:1: the file is empty"},
      {"", std::string("<root>\n\0</root>", 15), "f:2: a NUL byte"},
      {"", "<map/>", "f:1: neither <graphml> nor <root> but 'map'"},
      {"", "<root/>\n<root/>", "f:2: there is a second root element"},
      {"</graphml>", "</graphml> x", "f:19: not well-formed XML: text outside"},
      {"</graphml>", "</graph>", "f:19: not well-formed XML"},
      {"attr.name=\"coords\"", "attr.name=\"place\"", "f:2: nodes have no places"},
      {"directed", "both", "f:5: edgedefault has to be"},
      {"<node id=\"n1\">", "<node id=\"n2\">", "f:12: the target 'n1' of an edge is no node"},
      {"<node id=\"n1\">", "<node>", "f:9: a node without an id"},
      {"1.5,-2", "1.5",
       "f:9: node 'n1' has the coordinates '1.5', not two or three finite numbers"},
      {"1.5,-2", "1.5,x", "f:9: node 'n1' has the coordinates"},
      {"1.5,-2", "1.5,-2,3,4", "f:9: node 'n1' has the coordinates"},
      {"1.5,-2", "nan,0", "f:9: node 'n1' has the coordinates"},
      {"1.5,-2", "0,inf", "f:9: node 'n1' has the coordinates"},
      {"1.5,-2", "1e999,0", "f:9: node 'n1' has the coordinates"},
      {"1.5,-2", "1e12,0", "f:9: node 'n1': the coordinate 1e+12 is too large"},
      {"<data key=\"key0\">1.5,-2</data>", "", "f:9: node 'n1' has the coordinates ''"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\" source=\"n2\"", "f:15: the source 'n2' of an edge"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\" source=\"n-1\"", "f:15: the source 'n-1' of an edge"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\" source=\"1\"", "f:15: the source '1' of an edge"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\" source=\"n99999999999999999999\"",
       "f:15: the source 'n99999999999999999999' of an edge"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\" source=\"n0\"", "f:15: an edge from a node to itself"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\"", "f:15: the source '' of an edge is no node"},
      {"</graph>", "</graph><graph/>", "f:18: there is a second <graph>"},
      {"</graph>", "<node id=\"n2\"><graph/></node></graph>", "f:18: <graph> outside of <graphml>"},
      {"<data key=\"key0\">1.5,-2</data>", "<node id=\"n2\"/>", "f:10: <node> outside of <graph>"},
      {"<graph id", "<edge source=\"n0\" target=\"n1\"/><graph id",
       "f:5: <edge> outside of <graph>"},
      {"<graph id", "<key id=\"c\" for=\"node\" attr.name=\"coords\"/><graph id",
       "f:5: there is a second <key> for coords"},
      {"<graph id", "<key id=\"key0\" for=\"edge\" attr.name=\"x\"/><graph id",
       "f:5: there is a second <key> with the id 'key0'"},
      {"<key id=\"key0\"", "<key", "f:3: the <key> for coords has no id"},
      {"1.5,-2</data>", "1.5,-2</data>\n<data key=\"key0\">3,4</data>",
       "f:11: the coordinates of a node are given twice"},
      {"1.5,-2", "1,2<!-- x -->5", "f:10: <data> has to be text without elements or comments"},
      {"1.5,-2", "1.5,-2<b/>", "f:10: <data> has to be text without elements or comments"},
      {"1.5,-2", "1.5,<![CDATA[-2]]>", "f:10: <data> has to be text without elements or comments"},
      {"1.5,-2", "1.5&comma;-2", "f:10: not well-formed XML: '&comma;' is no character that XML"},
      {"1.5,-2", "1.5,-2&#0;", "f:10: not well-formed XML: '&#0;' is no character that XML"},
      {"1.5,-2", "1.5,-2&#x110000;", "f:10: not well-formed XML: '&#x110000;' is no character"},
      {"1.5,-2", "1.5,-2&", "f:10: not well-formed XML: '&' is no character that XML knows"},
      {"id=\"e1\" source", "id=\"&e;\" source", "f:15: not well-formed XML: '&e;' is no"},
      {"id=\"e1\" source", "id=\"<e\" source", "f:15: not well-formed XML: '<' in an attribute"},
      {"id=\"e1\" source", "id=\"e1\" target=\"n0\" source",
       "f:15: not well-formed XML: the attribute 'target' is given twice"},
      {"id=\"e1\" source", "id=\"e1\" directed=\"no\" source",
       "f:15: directed is 'no', neither true nor false"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\" source=\"n01\"", "f:15: the source 'n01' of an edge"},
      {"id=\"e1\" source=\"n1\"", "id=\"e1\" source=\"n1 \"", "f:15: the source 'n1 ' of an edge"},
      {"", "\xEF\xBB\xBF<graphml/>", "f:1: nodes have no places"},
  };
  test::expect_refused(test::contents(test::data("roadmap.xml")), faults, read_map);
}

TEST(RoadmapXml, RefusesWrongGrids) {
  const std::vector<test::Fault> faults = {
      {"<map>", "<cells>", "f:"},
      {"<width>4</width>", "", "f:2: <width> has to be 1 .. 65536 and is ''"},
      {"<width>4", "<width>-4", "f:2: <width> has to be 1 .. 65536 and is '-4'"},
      {"<width>4", "<width>0", "f:2: <width> has to be 1 .. 65536 and is '0'"},
      {"<width>4", "<width>4.5", "f:2: <width> has to be 1 .. 65536 and is '4.5'"},
      {"<width>4", "<width>100000000000", "f:2: <width> has to be 1 .. 65536"},
      {"<height>2", "<height>65536", "f:2: 2 rows where the height is 65536"},
      {"<height>2", "<height>nan", "f:2: <height> has to be 1 .. 65536 and is 'nan'"},
      {"<height>2", "<height>1", "f:2: 2 rows where the height is 1"},
      {"0 0 1 0", "0 0 1", "f:6: a row of 3 cells where the width is 4"},
      {"0 0 1 0", "0 0 1 0 1", "f:6: a row of 5 cells where the width is 4"},
      {"0 0 1 0", "0 0 2 0", "f:6: a row consists of 0 and 1 and has '2'"},
      {"0 0 1 0", "", "f:6: a row of 0 cells where the width is 4"},
      {"<width>4", "<width>4</width><width>4", "f:3: there is a second <width>"},
      {"<height>2", "<height>3</height><height>2", "f:4: there is a second <height>"},
      {"</grid>", "</grid><grid><row>0 0 0 0</row></grid>", "f:8: there is a second <grid>"},
      {"</map>", "</map>\n<map/>", "f:10: there is a second <map>"},
      {"</grid>", "</grid><row>0 0 0 0</row>", "f:8: <row> outside of <grid>"},
      {"</map>", "<x><map/></x></map>", "f:9: <map> outside of <root>"},
      {"<width>4", "<width>4<!-- -->0", "f:3: <width> has to be text without elements or comments"},
      {"0 0 1 0", "0 0<!-- --> 1 0", "f:6: <row> has to be text without elements or comments"},
      {"<row>0 0 1 0", "<row a=\"1\" a=\"1\">0 0 1 0",
       "f:6: not well-formed XML: the attribute 'a' is given twice"},
  };
  test::expect_refused(test::contents(test::data("cells.xml")), faults, read_map);
}

TEST(RoadmapXml, RefusesWrongTasks) {
  const std::vector<test::Fault> faults = {
      {"", "<tasks/>", "f:1: not <root> but 'tasks'"},
      {"<agent start_id", "<robot start_id", "f:3: not <agent> but 'robot'"},
      {"start_id=\"7\" ", "", "f:3: an <agent> has start_id and goal_id"},
      {"start_id=\"7\"", "start_id=\"7\" start_i=\"1\"", "f:3: an <agent> has start_id"},
      {"goal_j=\"3\"", "goal_j=\"-3\"", "f:2: goal_j is '-3', not a natural number"},
      {"goal_j=\"3\"", "goal_j=\"x\"", "f:2: goal_j is 'x', not a natural number"},
      {"goal_j=\"3\"", "goal_j=\"1.0\"", "f:2: goal_j is '1.0', not a natural number"},
      {"goal_j=\"3\"", "goal_j=\"99999999999\"", "f:2: goal_j is '99999999999'"},
      {"start_id=\"7\"", "start_id=\"7\" start_id=\"6\"",
       "f:3: not well-formed XML: the attribute 'start_id' is given twice"},
      {"goal_j=\"3\"", "goal_j=\"-0\"", "f:2: goal_j is '-0', not a natural number"},
      {"goal_id=\"4\"/>", "goal_id=\"4\"><agent/></agent>", "f:3: <agent> outside of <root>"},
  };
  test::expect_refused(test::contents(test::data("tasks.xml")), faults, read_task);
}

TEST(RoadmapXml, AgentsHaveToFitTheMap) {
  const auto grid = GridRoadmap::make(cells(), 2, 300'000, kResolution).value();
  const auto agents = [&](const std::string& row, std::size_t count) {
    std::istringstream in("<root>\n" + row + "\n</root>");
    return agents_of(read_task_xml(in, "f").value(), count, grid, 300'000, kUnitSpeed);
  };
  EXPECT_EQ(agents("<agent start_id=\"0\" goal_id=\"1\"/>", 2).error().to_string(),
            "f: 2 agents are asked for, but there are 1");
  EXPECT_EQ(agents("<agent start_id=\"0\" goal_id=\"2\"/>", 1).error().to_string(),
            "f:2: the goal of agent 0: (2, 0) is blocked");
  EXPECT_EQ(agents("<agent start_i=\"2\" start_j=\"0\" goal_i=\"0\" goal_j=\"0\"/>", 1)
                .error()
                .to_string(),
            "f:2: the start of agent 0: (0, 2) is outside of the grid of 4 x 2 cells");
  // Beside an obstacle there is no room for a larger one.
  const auto wide = GridRoadmap::make(cells(), 2, 600'000, kResolution).value();
  std::istringstream task("<root><agent start_id=\"0\" goal_id=\"1\"/></root>");
  const auto no_room =
      agents_of(read_task_xml(task, "f").value(), 1, wide, 600'000, kUnitSpeed).error();
  EXPECT_EQ(no_room.to_string(),
            "f:1: the goal of agent 0: a disc of radius 0.6 does not fit at (1, 0)");
  EXPECT_EQ(no_room.code, ErrorCode::no_plan);
  // Rows that nobody asked for are not looked at.
  EXPECT_TRUE(agents("<agent start_id=\"0\" goal_id=\"2\"/>", 0).has_value());
  const Roadmap roadmap = Roadmap::make({{0, 0}, {9, 9}}, {}).value();
  std::istringstream in(
      "<root><agent start_i=\"0\" start_j=\"0\" goal_i=\"1\" goal_j=\"1\"/></root>");
  EXPECT_FALSE(agents_of(read_task_xml(in, "f").value(), 1, roadmap, 1, kUnitSpeed).has_value());
}

TEST(RoadmapXml, HostileFilesDoNoHarm) {
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "<a>";
  for (const std::string& text : {deep, "<root>" + deep, std::string(1'000'000, '<')}) {
    std::istringstream in(text);
    EXPECT_FALSE(read_map(in).has_value());
  }
  std::string closed = deep;
  for (int i = 0; i < 200'000; ++i) closed += "</a>";
  std::istringstream in("<root>" + closed + "</root>");
  EXPECT_FALSE(read_map(in).has_value());
  EXPECT_EQ(read_map_xml(std::filesystem::path("/"), kResolution).error().code, ErrorCode::io);
  EXPECT_EQ(read_task_xml(std::filesystem::path("none")).error().code, ErrorCode::io);
}

TEST(GridRoadmap, NeighbourhoodsHaveTheirMoves) {
  const OccupancyGrid open{7, 7, std::vector<bool>(49, true)};
  const std::size_t expected[] = {4, 8, 16, 32};
  for (const int k : {2, 3, 4, 5}) {
    const auto grid = GridRoadmap::make(open, k, 353'553, kResolution).value();
    const VertexId centre = *grid.vertex({3, 3});
    EXPECT_EQ(grid.roadmap()->out_edges(centre).size(), expected[k - 2]) << k;
  }
  for (const int k : {1, 6, -1})
    EXPECT_FALSE(GridRoadmap::make(open, k, 353'553, kResolution).has_value());
  for (const Length radius : {Length{0}, Length{-1}, Length{17'000'000}})
    EXPECT_FALSE(GridRoadmap::make(open, 3, radius, kResolution).has_value());
}

TEST(GridRoadmap, AMoveIsThereIfTheDiscMeetsNoObstacle) {
  // An obstacle beside the diagonal from (0, 0) to (1, 1); its corner is 0 from the way.
  OccupancyGrid grid{2, 2, {true, true, false, true}};
  auto made = GridRoadmap::make(grid, 3, 1, kResolution).value();
  const auto edges = [&](Cell cell) {
    return made.roadmap()->out_edges(*made.vertex(cell)).size();
  };
  EXPECT_EQ(edges({0, 0}), 1u);
  EXPECT_EQ(edges({1, 0}), 2u);
  EXPECT_EQ(made.vertex({0, 1}), std::nullopt);
  EXPECT_EQ(made.vertex({0, 5}), std::nullopt);
  // A knight's move passes a corner at distance sqrt(5)/10 = 0.2236...
  grid = {2, 3, {true, true, false, true, true, true}};
  for (const Length radius : {Length{223'606}, Length{223'607}}) {
    made = GridRoadmap::make(grid, 4, radius, kResolution).value();
    const VertexId from = *made.vertex({0, 0}), to = *made.vertex({2, 1});
    bool found = false;
    for (const EdgeId e : made.roadmap()->out_edges(from))
      found = found || made.roadmap()->edge(e).to == to;
    EXPECT_EQ(found, radius == 223'606) << radius;
  }
  // A disc wider than a cell does not fit between two obstacles.
  grid = {1, 3, {true, true, false}};
  made = GridRoadmap::make(grid, 2, 500'000, kResolution).value();
  EXPECT_EQ(made.roadmap()->num_vertices(), 2u);  // it touches the obstacle
  made = GridRoadmap::make(grid, 2, 500'001, kResolution).value();
  EXPECT_EQ(made.roadmap()->num_vertices(), 1u);
}

}  // namespace
}  // namespace quadrille::continuous
