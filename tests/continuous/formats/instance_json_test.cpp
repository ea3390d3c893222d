// SPDX-License-Identifier: MIT
#include "quadrille/continuous/instance_json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "continuous/formats/file_support.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::continuous {
namespace {

bool equal(const Instance& a, const Instance& b) {
  return a.roadmap().positions() == b.roadmap().positions() &&
         a.roadmap().edges() == b.roadmap().edges() &&
         a.roadmap().shapes() == b.roadmap().shapes() &&
         a.roadmap().no_waiting() == b.roadmap().no_waiting() && a.agents() == b.agents() &&
         a.obstacles() == b.obstacles() && a.resolution() == b.resolution();
}

TEST(RoadmapJson, ReadsTheExample) {
  const Instance instance = read_instance_json(test::data("discs.json")).value();
  EXPECT_EQ(instance.resolution(), 0.001);
  EXPECT_EQ(instance.roadmap().positions(),
            (std::vector<Point>{{0, 0}, {1000, 0}, {2000, 0}, {1000, 800}}));
  ASSERT_EQ(instance.roadmap().num_edges(), 6u);
  EXPECT_EQ(instance.roadmap().edge(EdgeId(4)), (Edge{VertexId(1), VertexId(3), std::nullopt}));
  EXPECT_EQ(instance.roadmap().edge(EdgeId(5)), (Edge{VertexId(3), VertexId(1), Ticks{1500}}));
  ASSERT_EQ(instance.num_agents(), 2u);
  EXPECT_EQ(instance.agent(AgentId(0)), (Agent{VertexId(0), VertexId(2), Disc{300}, kUnitSpeed}));
  EXPECT_EQ(instance.agent(AgentId(1)),
            (Agent{VertexId(2), VertexId(0), Disc{250}, 2 * kUnitSpeed}));
}

TEST(RoadmapJson, ReadsWhatFleetsNeed) {
  const Instance instance = read_instance_json(test::data("fleet.json")).value();
  ASSERT_EQ(instance.roadmap().num_edges(), 6u);
  EXPECT_EQ(instance.roadmap().edge(EdgeId(3)), (Edge{VertexId(2), VertexId(1), std::nullopt}));
  EXPECT_EQ(instance.roadmap().edge(EdgeId(4)),
            (Edge{VertexId(1), VertexId(3), std::nullopt, {GroupId(1), GroupId(2)}}));
  EXPECT_EQ(instance.roadmap().edge(EdgeId(5)),
            (Edge{VertexId(3), VertexId(1), Ticks{150}, {GroupId(1)}}));
  ASSERT_EQ(instance.num_agents(), 2u);
  EXPECT_EQ(instance.agent(AgentId(0)).group, GroupId(0));
  EXPECT_EQ(instance.agent(AgentId(0)).deadline, std::nullopt);
  EXPECT_EQ(instance.agent(AgentId(1)).group, GroupId(1));
  EXPECT_EQ(instance.agent(AgentId(1)).release, Ticks{150});
  EXPECT_EQ(instance.agent(AgentId(1)).deadline, Ticks{1200});
  EXPECT_FALSE(instance.agent(AgentId(0)).leaves);
  EXPECT_TRUE(instance.agent(AgentId(1)).leaves);
  ASSERT_EQ(instance.obstacles().size(), 1u);
  EXPECT_EQ(instance.obstacles()[0],
            (MovingObstacle{Disc{20}, {{{100, 100}, 0, 200}, {{100, 300}, 450, 450}}, true}));
}

TEST(RoadmapJson, ReadsWhereNobodyMayWaitAndHowFastLanesAre) {
  const auto read = [](const std::string& edge, const std::string& no_waiting) {
    std::istringstream file(
        "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": 0.1, \"roadmap\": "
        "{\"vertices\": [[0, 0], [3, 4], [6, 4]],\n\"edges\": [[0, 1], {\"from\": 1, \"to\": 2" +
        edge + "}],\n\"no_waiting\": " + no_waiting +
        "}, \"agents\": [{\"start\": 0, \"goal\": 2, \"radius\": 0.5}]}");
    return read_instance_json(file, "f");
  };
  const auto instance = read(", \"speed_limit\": 0.5", "[1]");
  ASSERT_TRUE(instance) << instance.error().message;
  EXPECT_EQ(instance->roadmap().edge(EdgeId(1)).speed_limit, kUnitSpeed / 2);
  EXPECT_EQ(instance->duration(ClassId(0), EdgeId(1)), Ticks(60));
  EXPECT_EQ(instance->duration(ClassId(0), EdgeId(0)), Ticks(50));
  EXPECT_FALSE(instance->roadmap().may_wait(VertexId(1)));
  const auto refuses = [&](const std::string& edge, const std::string& no_waiting,
                           const std::string& why) {
    const auto made = read(edge, no_waiting);
    ASSERT_FALSE(made) << why;
    EXPECT_EQ(made.error().to_string(), why);
  };
  refuses(
      ", \"speed_limit\": 0", "[]",
      "f:2: /roadmap/edges/1/speed_limit: the speed is not 0.000001 .. 1000000 length units per "
      "tick: 0");
  refuses(", \"duration\": 3, \"speed_limit\": 1", "[]",
          "f:2: /roadmap/edges/1/speed_limit: the edge has a duration and a speed limit");
  refuses("", "[3]", "f:3: /roadmap/no_waiting/0: there is no vertex 3 among 3");
  refuses("", "[1, 1]", "f:3: /roadmap/no_waiting/1: this vertex is named twice");
  refuses("", "1", "f:3: /roadmap/no_waiting: expected a list of vertices, found an integer");
  refuses("", "[2]", "f:3: agent 0 would stay at vertex 2, where nobody may wait");
  refuses("", "[0]", "f:3: agent 0 starts at vertex 0, where nobody may wait");
}

TEST(RoadmapJson, ReadsAndWritesGoalsToChooseFrom) {
  std::istringstream file(
      "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": 0.1, \"roadmap\": "
      "{\"vertices\": [[0, 0], [3, 4], [6, 4]], \"edges\": [[0, 1], [1, 2]]}, \"agents\": "
      "[{\"start\": 0, \"goals\": \"docks\", \"radius\": 0.5}, "
      "{\"start\": 2, \"goals\": [2], \"radius\": 0.5}], \"goal_sets\": {\"docks\": [2, 1]}}");
  const Instance instance = read_instance_json(file, "f").value();
  EXPECT_EQ(instance.agent(AgentId(0)).goals, Goals({VertexId(1), VertexId(2)}));
  EXPECT_EQ(instance.agent(AgentId(1)).goal(), VertexId(2));
  std::ostringstream written;
  EXPECT_FALSE(write_instance_json(written, "f", instance));
  EXPECT_NE(written.str().find("\"goals\": [1, 2]"), std::string::npos);
  EXPECT_NE(written.str().find("\"goal\": 2"), std::string::npos);
}

TEST(RoadmapJson, ReadsMovesInProgress) {
  const auto read = [](const std::string& how) {
    std::istringstream file(
        "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": 0.1, \"roadmap\": "
        "{\"vertices\": [[0, 0], [3, 4]], \"edges\": [[0, 1, 2.5]]}, \"agents\": [{\"start\": 0, "
        "\"goal\": 1, \"radius\": 0.5, \"at_start\": " +
        how + "}]}");
    return read_instance_json(file, "f");
  };
  EXPECT_TRUE(read("\"under_way\"").value().agent(AgentId(0)).under_way);
  EXPECT_FALSE(read("\"stay\"").value().agent(AgentId(0)).under_way);
  EXPECT_EQ(read("\"go\"").error().to_string(),
            "f:1: /agents/0/at_start: expected 'stay' or 'under_way', found 'go'");
  EXPECT_EQ(read("\"under_way\", \"release\": 1").error().to_string(),
            "f:1: agent 0 is under way, and cannot be released later");
}

TEST(RoadmapJson, ReadsPlacesInTheMiddleOfMoves) {
  const auto read = [](const std::string& point, const std::string& place) {
    std::istringstream file(
        "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": 0.1, \"roadmap\": "
        "{\"vertices\": [[0, 0], [1, 0], " +
        point +
        "], \"edges\": [[0, 1, 3], [2, 1, 2]], \"lane_places\": [{\"vertex\": 2, \"from\": 0, " +
        place + "}]}, \"agents\": [{\"start\": 2, \"goal\": 1, \"radius\": 0.5}]}");
    return read_instance_json(file, "f");
  };
  const std::string third = "\"to\": 1, \"behind\": 1, \"whole\": 3";
  const Instance instance = read("[0.3, 0]", third).value();
  EXPECT_EQ(instance.roadmap().place(VertexId(2)), geometry::Place({0, 0}, {10, 0}, 10, 30));
  EXPECT_EQ(instance.motion(ClassId(0), EdgeId(1)), (geometry::Motion{{0, 0}, {10, 0}, 20, 10}));
  std::ostringstream written;
  EXPECT_FALSE(write_instance_json(written, "f", instance));
  std::istringstream again(written.str());
  EXPECT_EQ(read_instance_json(again, "f").value().roadmap().lane_places(),
            instance.roadmap().lane_places());
  const auto error = [&](const std::string& point, const std::string& place) {
    return read(point, place).error().to_string();
  };
  const std::string in_the_middle = "f:1: /roadmap: vertex 2 is in the middle of a move, but ";
  EXPECT_EQ(error("[0.4, 0]", third),
            in_the_middle + "its coordinates are not those of that place");
  EXPECT_EQ(error("[0.3, 0]", "\"to\": 1, \"behind\": 1, \"whole\": 4"),
            in_the_middle + "the edge from it is not the rest of the move");
  EXPECT_EQ(error("[0.3, 0]", "\"to\": 0, \"behind\": 1, \"whole\": 3"),
            in_the_middle + "that is not one between two other vertices");
  EXPECT_EQ(error("[0.3, 0]", "\"to\": 1, \"behind\": 3, \"whole\": 3"),
            in_the_middle + "30 of 30 ticks lie behind it");
  EXPECT_EQ(error("[0.3, 0]", "\"to\": 1, \"behind\": 1"),
            "f:1: /roadmap/lane_places/0: the key 'whole' is missing");
}

TEST(RoadmapJson, RefusesWhatIsWrongWithTheRulesOfFleets) {
  const std::vector<test::Fault> faults = {
      {"[1, 2]}", "[1, 64]}", "f:9: /roadmap/edges/4/groups/1: 64 is not between 0 and 63"},
      {"[1, 2]}", "[1, 1]}", "f:9: /roadmap/edges/4/groups/1: this group is named twice"},
      {"[1, 2]}", "[]}", "f:9: /roadmap/edges/4/groups: the edge is open to no group"},
      {"[1, 2]}", "1}", "f:9: /roadmap/edges/4/groups: expected a list of groups"},
      {"[1, 2]}", "[\"a\"]}", "f:9: /roadmap/edges/4/groups/0: expected an integer"},
      {"{\"from\": 1, ", "{", "f:9: /roadmap/edges/4: the key 'from' is missing"},
      {"\"to\": 3", "\"too\": 3", "f:9: /roadmap/edges/4/too: this key is not known here"},
      {"\"to\": 3", "\"to\": 1", "f:9: /roadmap/edges/4: the edge is a loop"},
      {"\"duration\": 1.5", "\"duration\": 0",
       "f:10: /roadmap/edges/5/duration: the duration is less than one tick"},
      {"\"group\": 1", "\"group\": 64", "f:15: /agents/1/group: 64 is not between 0 and 63"},
      {"\"group\": 1", "\"group\": -1", "f:15: /agents/1/group: -1 is not between 0 and 63"},
      {"1.5, \"deadline", "-1, \"deadline", "f:15: /agents/1/release: the time is negative"},
      {"1.5, \"deadline", "1e300, \"deadline", "f:15: /agents/1/release: the time is negative, or"},
      {"1.5, \"deadline", "true, \"deadline", "f:15: /agents/1/release: expected a number"},
      {"12", "-12", "f:15: /agents/1/deadline: the time is negative, or too late"},
      {"12", "null", "f:15: /agents/1/deadline: expected a number"},
      {"\"deadline", "\"goals\": [0, 2], \"deadline",
       "f:15: /agents/1/goals: expected either 'goal' or 'goals'"},
      {"\"goal\": 0", "\"goals\": []", "f:15: /agents/1/goals: there is no goal in the list"},
      {"\"goal\": 0", "\"goals\": 0", "f:15: /agents/1/goals: expected a list of goals"},
      {"\"goal\": 0", "\"goals\": [0, 1, 0]",
       "f:15: /agents/1/goals/2: the goal vertex 0 is given twice"},
      {"\"goal\": 0", "\"goals\": [0, 4]", "f:15: /agents/1/goals/1: there is no vertex 4 among 4"},
      {"\"goal\": 0, ", "", "f:15: /agents/1: the key 'goal' is missing"},
      {"12", "3.49", "f:15: agent 1 cannot arrive before 3.5, and its deadline is 3.49"},
      {"\"radius\": 0.2, ", "",
       "f:18: /obstacles/0: one of the keys 'radius' and 'polygon' is missing"},
      {"\"path\"", "\"way\"", "f:18: /obstacles/0/way: this key is not known here"},
      {"\"vertex\": 3", "\"vertex\": 4", "f:18: /obstacles/0/path/0/vertex: there is no vertex 4"},
      {"\"vertex\": 3, ", "", "f:18: /obstacles/0/path/0: expected one of the keys 'vertex'"},
      {"\"vertex\": 3, ", "\"vertex\": 3, \"at\": [0, 0], ",
       "f:18: /obstacles/0/path/0: expected one of the keys 'vertex'"},
      {"\"at\": [1, 3]", "\"at\": [1]", "f:18: /obstacles/0/path/1/at: expected 2 coordinates"},
      {"4.5", "2", "f:18: /obstacles/0/path/1/arrive: the arrival is not after the last departure"},
      {"4.5", "-4.5", "f:18: /obstacles/0/path/1/arrive: the time is negative"},
      {"\"arrive\": 0,", "\"arrive\": 3,",
       "f:18: /obstacles/0/path/0/depart: the departure is before the arrival"},
      {"{\"vertex\": 3, \"arrive\": 0, \"depart\": 2}, ", "",
       "f:18: /obstacles/0/path: it vanishes at the moment at which it appears"},
      {"\"at_end\": \"leave\"", "\"at_end\": \"go\"",
       "f:18: /obstacles/0/at_end: expected 'stay' or 'leave', found 'go'"},
      {"\"vertex\": 3", "\"vertex\": 2", "f:17: /obstacles: obstacle 0 is at the start of agent 1"},
      {"\"at_goal\": \"leave\"", "\"at_goal\": \"vanish\"",
       "f:15: /agents/1/at_goal: expected 'stay' or 'leave', found 'vanish'"},
      {"\"at_goal\": \"leave\"", "\"at_goal\": true", "f:15: /agents/1/at_goal: expected a string"},
      {"\"goal\": 2", "\"goal\": 3", "f:14: agent 0 cannot get from vertex 0 to vertex 3"},
  };
  test::expect_refused(test::contents(test::data("fleet.json")), faults,
                       [](std::istream& in) { return read_instance_json(in, "f"); });
}

TEST(RoadmapJson, IsToldFromOtherInstances) {
  EXPECT_TRUE(is_roadmap_json(test::contents(test::data("discs.json"))));
  EXPECT_FALSE(
      is_roadmap_json(test::contents(std::string(QUADRILLE_TEST_DATA "/valid/graph.json"))));
  EXPECT_FALSE(is_roadmap_json("{\"quadrille\": \"roadmap\"}"));
  EXPECT_FALSE(is_roadmap_json("[\"roadmap\"]"));
  EXPECT_FALSE(is_roadmap_json("{\"agents\": {\"roadmap\": 1}}"));
  EXPECT_FALSE(is_roadmap_json("{\"roadmap\": 1"));
  EXPECT_TRUE(is_roadmap_json("{\"agents\": [[1, {\"x\": 2}], 3], \"roadmap\": 1}"));
}

TEST(RoadmapJson, RefusesWhatIsWrongWithLineAndReason) {
  const std::vector<test::Fault> faults = {
      {"", "", "f:1: not valid JSON"},
      {"", "[]", "f:1: expected an object, found a list"},
      {"", "{\"quadrille\": 1, \"roadmap\": {}}", "f:1: the key 'version' is missing"},
      {"", std::string("{\0}", 3), "f:1: a NUL byte"},
      {"\"instance\"", "\"plan\"", "f:2: /quadrille: expected 'instance', found 'plan'"},
      {"\"version\": 1", "\"version\": 2", "f:3: /version: 2 is not between 1 and 1"},
      {"0.001", "0", "f:4: /resolution: a resolution is positive"},
      {"0.001", "-1", "f:4: /resolution: a resolution is positive"},
      {"0.001", "nan", "f:4: not valid JSON"},
      {"0.001", "1e999", "f:4: not valid JSON"},
      {"0.001", "\"x\"", "f:4: /resolution: expected a number, found a string"},
      {"\"resolution\"", "\"reso\"", "f:4: /reso: this key is not known here"},
      {"\"resolution\": 0.001", "\"version\": 1", "f:4: /version: this key is given twice"},
      {"\"vertices\"", "\"nodes\"", "f:6: /roadmap/nodes: this key is not known here"},
      {"[1, 0], [2, 0], [1, 0.8]", "[1, 0], [2], [1, 0.8]",
       "f:6: /roadmap/vertices/2: expected 2 coordinates, found 1"},
      {"[1, 0.8]", "[1, 0.8, 2]", "f:6: /roadmap/vertices/3: expected 2 coordinates, found 3"},
      {"[0, 0], [1, 0]", "[0, 0, 1], [1, 0]",
       "f:6: /roadmap/vertices/1: expected 3 coordinates, found 2"},
      {"[0, 0], [1, 0]", "[0], [1, 0]",
       "f:6: /roadmap/vertices/0: expected 2 coordinates, found 1"},
      {"[1, 0.8]", "[1, \"0.8\"]", "f:6: /roadmap/vertices/3/1: expected a number"},
      {"[1, 0.8]", "[1, Infinity]", "f:6: not valid JSON"},
      {"[1, 0.8]", "[1, 1e300]", "f:6: /roadmap/vertices/3/1: the coordinate is too large"},
      {"[1, 0.8]", "[1, 0.0001]", "f:7: /roadmap/edges/4: the edge has length zero"},
      {"[1, 3]", "[1, 1]", "f:7: /roadmap/edges/4: the edge is a loop"},
      {"[1, 3]", "[1, 4]", "f:7: /roadmap/edges/4/1: there is no vertex 4 among 4"},
      {"[1, 3]", "[-0, 3]", "f:7: /roadmap/edges/4/0: expected an integer"},
      {"[1, 3]", "[-1, 3]", "f:7: /roadmap/edges/4/0: -1 is not between 0"},
      {"[1, 3]", "[1, 3.5]", "f:7: /roadmap/edges/4/1: expected an integer"},
      {"[1, 3]", "[1]", "f:7: /roadmap/edges/4: expected [from, to] or [from, to, duration]"},
      {"[1, 3]", "[]", "f:7: /roadmap/edges/4: expected [from, to] or [from, to, duration]"},
      {"[1, 3]", "[1, 3, 1, 1]", "f:7: /roadmap/edges/4: expected [from, to]"},
      {"1.5]]", "0]]", "f:7: /roadmap/edges/5/2: the duration is less than one tick"},
      {"1.5]]", "-2]]", "f:7: /roadmap/edges/5/2: the duration is less than one tick"},
      {"\"speed\": 2", "\"speed\": 0",
       "f:11: /agents/1/speed: the speed is not 0.000001 .. 1000000 length units per tick"},
      {"\"speed\": 2", "\"speed\": -1",
       "f:11: /agents/1/speed: the speed is not 0.000001 .. 1000000 length units per tick"},
      {"\"speed\": 2", "\"speed\": null", "f:11: /agents/1/speed: expected a number"},
      {"0.25", "0", "f:11: /agents/1/radius: the radius is less than one length unit"},
      {"0.25", "0.0009", "f:11: /agents/1/radius: the radius is less than one length unit"},
      {", \"radius\": 0.25", "",
       "f:11: /agents/1: one of the keys 'radius' and 'polygon' is missing"},
      {"\"radius\": 0.25", "\"radius\": 0.25, \"polygon\": []",
       "f:11: /agents/1/polygon: an agent has a radius or a polygon, not both"},
      {"\"radius\": 0.25", "\"polygon\": 1", "f:11: /agents/1/polygon: expected a list"},
      {"\"radius\": 0.25", "\"polygon\": [[0, 0], [1, 0]]", "f:11: /agents/1/polygon: polygon: "},
      {"\"radius\": 0.25", "\"polygon\": [[0, 0], [1, 0], [2]]",
       "f:11: /agents/1/polygon/2: expected 2 coordinates, found 1"},
      {"\"radius\": 0.25", "\"polygon\": [[0, 0], [1, 0], [2, \"x\"]]",
       "f:11: /agents/1/polygon/2/1: expected a number"},
      {"\"radius\": 0.25", "\"polygon\": [[0, 0], [1e300, 0], [0, 1]]",
       "f:11: /agents/1/polygon/1/0: the coordinate is too large"},
      {"\"radius\": 0.25", "\"polygon\": [[0, 0], [1, 0], [2, 0.0009]]",
       "f:11: /agents/1/polygon: polygon: three consecutive corners are on a line"},
      {"\"start\": 2", "\"start\": 9", "f:11: /agents/1/start: there is no vertex 9 among 4"},
      {"\"start\": 2", "\"start\": 0",
       "f:11: the starts of agent 0 at vertex 0 and agent 1 at vertex 0 overlap"},
      {"\"goal\": 0", "\"goal\": 2",
       "f:11: the goals of agent 0 at vertex 2 and agent 1 at vertex 2 overlap"},
      {"0.3", "1.751", "f:11: the starts of agent 0 at vertex 0 and agent 1 at vertex 2 overlap"},
      {"[0, 1], [1, 0], [1, 2]", "[0, 1], [1, 2]",
       "f:11: agent 1 cannot get from vertex 2 to vertex 0"},
      {"\"speed\": 2", "\"speed\": 1000000",
       "f:11: the lane from vertex 0 to vertex 1 takes agent 1 less than half a step of 0.001, or "
       "too long"},
  };
  test::expect_refused(test::contents(test::data("discs.json")), faults,
                       [](std::istream& in) { return read_instance_json(in, "f"); });
}

TEST(RoadmapJson, TouchingStartsAreAllowed) {
  const test::Fault touching{"0.3", "1.75", ""};
  std::istringstream in(test::with_fault(test::contents(test::data("discs.json")), touching));
  EXPECT_TRUE(read_instance_json(in, "f").has_value());
}

TEST(RoadmapJson, DeepAndHugeFilesAreRefused) {
  std::istringstream deep("{\"roadmap\": " + std::string(100'000, '['));
  EXPECT_EQ(read_instance_json(deep, "f").error().code, ErrorCode::out_of_range);
  EXPECT_EQ(read_instance_json(std::filesystem::path("/")).error().code, ErrorCode::io);
  EXPECT_EQ(read_instance_json(std::filesystem::path("none.json")).error().code, ErrorCode::io);
}

TEST(RoadmapJson, Heights) {
  const auto read = [](const std::string& points, const std::string& body,
                       const std::string& more = "") {
    std::istringstream file(
        "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": 0.1, \"roadmap\":\n"
        "{\"vertices\": " +
        points +
        ", \"edges\": [[0, 1]]}, \"agents\":\n"
        "[{\"start\": 0, \"goal\": 1, " +
        body + "}]" + more + "}");
    return read_instance_json(file, "f");
  };
  const std::string disc = "\"radius\": 0.5",
                    square = "\"polygon\": [[0, 0], [1, 0], [1, 1], [0, 1]]",
                    spatial = "[[0, 0, -1], [2, 2, 0]]";
  const Instance made = read(spatial, disc).value();
  EXPECT_EQ(made.roadmap().positions(), (std::vector<Point>{{0, 0, -10}, {20, 20}}));
  EXPECT_FALSE(made.is_flat());
  EXPECT_EQ(made.duration(ClassId(0), EdgeId(0)), Ticks{30});
  EXPECT_EQ(read(spatial, square).error().to_string(),
            "f:3: agent 0 is a polygon, but there are places with a height: in space bodies are "
            "spheres");
  // Three coordinates alone make nothing high.
  EXPECT_TRUE(read("[[0, 0, 0], [2, 2, 0]]", square).value().is_flat());
  const auto obstacle = [](const std::string& body, const std::string& at) {
    return ", \"obstacles\":\n[{" + body + ", \"path\": [{\"at\": " + at + ", \"arrive\": 5}]}]";
  };
  EXPECT_EQ(read("[[0, 0], [2, 2]]", disc, obstacle(disc, "[5, 5, 5]")).error().to_string(),
            "f:4: /obstacles/0/path/0/at: expected 2 coordinates, found 3");
  const Instance flown_over =
      read("[[0, 0, 0], [2, 2, 0]]", disc, obstacle(disc, "[5, 5, 5]")).value();
  EXPECT_TRUE(flown_over.roadmap().is_flat());
  EXPECT_FALSE(flown_over.is_flat());
  EXPECT_EQ(read("[[0, 0, 0], [2, 2, 0]]", square, obstacle(disc, "[5, 5, 5]")).error().code,
            ErrorCode::invalid_instance);
  EXPECT_EQ(read(spatial, disc, obstacle(square, "[5, 5, 5]")).error().to_string(),
            "f:4: /obstacles: obstacle 0 is a polygon, but there are places with a height: in "
            "space bodies "
            "are spheres");
}

TEST(RoadmapJson, WhatIsWrittenIsReadBack) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    test::RandomOptions random;
    random.obstacles_percent = 30;
    random.under_way_percent = 30;
    const Instance drawn = test::random_instance(seed, random);
    // Other resolutions, where decimals are not exact.
    const Resolution resolutions[] = {1e-6, 1, 0.001, 0.3, 7, 1.0 / 3, {0.001, 0.01}, {0.3, 7}};
    const Instance instance =
        Instance::make(drawn.shared_roadmap(), drawn.agents().items(),
                       resolutions[seed % std::size(resolutions)], {}, drawn.obstacles())
            .value();
    std::stringstream file;
    ASSERT_EQ(write_instance_json(file, "out", instance), std::nullopt);
    const auto again = read_instance_json(file, "out");
    ASSERT_TRUE(again.has_value()) << again.error().to_string() << '\n' << file.str();
    EXPECT_TRUE(equal(*again, instance)) << file.str();
  }
}

TEST(RoadmapJson, NamesAreReadAndWritten) {
  const auto read = [](const std::string& more, const std::string& names, text::Names* found) {
    std::istringstream in(
        R"({"quadrille": "instance", "version": 1, "roadmap": {"vertices": [[0, 0], [2, 0]],
            "edges": [[0, 1], [1, 0]])" +
        names + R"(}, "agents": [{"start": 0, "goal": 1, "radius": 0.1})" + more + "}");
    return read_instance_json(in, "f", found);
  };
  text::Names names;
  ASSERT_TRUE(read("]", "", &names).has_value());
  EXPECT_EQ(names.agent(0), nullptr);
  const auto instance = read(R"(, {"start": 1, "goal": 0, "radius": 0.1, "name": "a \"b\"\u0001"}],
             "group_names": [null, "small"])",
                             R"(, "names": ["1", [1, ["x", -2]]])", &names);
  ASSERT_TRUE(instance.has_value()) << instance.error().to_string();
  EXPECT_EQ(*names.agent(1), "a \"b\"\x01");
  EXPECT_EQ(names.vertices, (std::vector<std::string>{"\"1\"", "[1, [\"x\", -2]]"}));
  EXPECT_EQ(names.groups, (std::vector<std::optional<std::string>>{std::nullopt, "small"}));
  std::stringstream file;
  ASSERT_EQ(write_instance_json(file, "out", *instance, names), std::nullopt);
  text::Names again;
  ASSERT_TRUE(read_instance_json(file, "out", &again).has_value()) << file.str();
  EXPECT_EQ(again, names);
  const auto why = [&](const std::string& more, const std::string& wrong) {
    return read(more, wrong, nullptr).error().message;
  };
  const std::string second = R"(, {"start": 1, "goal": 0, "radius": 0.1, "name": )";
  EXPECT_EQ(why(second + "\"0\"}]", ""), "/agents/1: agents 0 and 1 are both called '0'");
  EXPECT_EQ(why(second + "[]}]", ""), "/agents/1/name: expected a name");
  EXPECT_EQ(why("]", R"(, "names": ["a", "a"])"), "/roadmap/names/1: another vertex has this name");
  EXPECT_EQ(why("]", R"(, "names": ["a", "b", "c"])"),
            "/roadmap/names/2: there are only 2 vertices");
  EXPECT_EQ(why("]", R"(, "names": [0.5])"),
            "/roadmap/names/0: a vertex is called by a text, a whole number or a list of these");
  EXPECT_EQ(why("], \"group_names\": [[]]", ""), "/group_names/0: expected a name");
}

TEST(RoadmapJson, LengthAndTimeMayHaveResolutionsOfTheirOwn) {
  const auto read = [](const std::string& resolution) {
    std::istringstream file(
        "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": " + resolution +
        ", \"roadmap\": {\"vertices\": [[0, 0], [3, 4]], \"edges\": [[0, 1], [1, 0, 2.5]]}, "
        "\"agents\": [{\"start\": 0, \"goal\": 1, \"radius\": 0.35}]}");
    return read_instance_json(file, "f");
  };
  const Instance instance = read("{\"length\": 0.001, \"time\": 0.05}").value();
  EXPECT_EQ(instance.resolution(), Resolution(0.001, 0.05));
  EXPECT_EQ(instance.roadmap().position(VertexId(1)), (Point{3000, 4000}));
  // A speed that is not given is 1 in the file's units: 50 length units per tick.
  EXPECT_EQ(instance.agent(AgentId(0)),
            (Agent{VertexId(0), VertexId(1), Disc{350}, 50 * kUnitSpeed}));
  EXPECT_EQ(instance.duration(ClassId(0), EdgeId(0)), Ticks{100});  // 5 / 0.05
  EXPECT_EQ(instance.duration(ClassId(0), EdgeId(1)), Ticks{50});

  const std::pair<const char*, const char*> wrong[] = {
      {"{}", "f:1: /resolution: the key 'length' is missing"},
      {"{\"length\": 1}", "f:1: /resolution: the key 'time' is missing"},
      {"{\"length\": 0, \"time\": 1}", "f:1: /resolution/length: a resolution is positive"},
      {"{\"length\": 1, \"time\": -1}", "f:1: /resolution/time: a resolution is positive"},
      {"{\"length\": 1e-3, \"time\": 1e-10}",
       "f:1: /agents/0: the speed is not 0.000001 .. 1000000"},
      {"[1, 1]", "f:1: /resolution: expected a number"}};
  for (const auto& [resolution, message] : wrong) {
    const auto refused = read(resolution);
    ASSERT_FALSE(refused.has_value()) << resolution;
    EXPECT_EQ(refused.error().to_string().substr(0, std::string(message).size()), message);
  }
}

TEST(RoadmapJson, WriterReportsAFullDisk) {
  std::ofstream full("/dev/full");
  if (!full.is_open()) GTEST_SKIP() << "there is no /dev/full";
  const auto error = write_instance_json(full, "out", test::random_instance(1, {}));
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::io);
}

TEST(Quantise, TravelTimeIsDistanceBySpeedToTheNearestTick) {
  const auto ticks = [](Length x, Length y, Speed speed) {
    const auto time = travel_time({-2, 7}, {x - 2, y + 7}, speed);
    return time ? time : std::optional(Ticks{-1});
  };
  EXPECT_EQ(ticks(3, 4, kUnitSpeed), Ticks{5});
  EXPECT_EQ(ticks(30, 40, 2 * kUnitSpeed), Ticks{25});
  EXPECT_EQ(ticks(1, 1, kUnitSpeed), Ticks{1});           // 1.41
  EXPECT_EQ(ticks(2, 2, kUnitSpeed), Ticks{3});           // 2.83
  EXPECT_EQ(ticks(5, 0, 2 * kUnitSpeed), Ticks{3});       // 2.5: away from zero
  EXPECT_EQ(ticks(1, 0, 2 * kUnitSpeed), Ticks{1});       // 0.5
  EXPECT_EQ(ticks(1, 0, 2 * kUnitSpeed + 1), Ticks{-1});  // less: no tick
  EXPECT_EQ(ticks(0, 0, kUnitSpeed), Ticks{-1});
  // As far and as slow as it goes: 2^40 ticks are the longest move, and speeds are exact.
  const Length far = geometry::kMaxLength;
  EXPECT_EQ(ticks(far, 0, kUnitSpeed), geometry::kMaxDuration);
  EXPECT_EQ(ticks(far, 1, kUnitSpeed), geometry::kMaxDuration);  // half a millionth of a unit
  EXPECT_EQ(ticks(far + 1, 0, kUnitSpeed), Ticks{-1});
  EXPECT_EQ(ticks(far, 0, kUnitSpeed - 1), Ticks{-1});
  EXPECT_EQ(ticks(1'000'000, 0, 1), Ticks(1'000'000'000'000));
  EXPECT_EQ(ticks(far, 0, 1), Ticks{-1});
  EXPECT_EQ(ticks(1'000'000, 0, kMaxSpeed), Ticks{1});
}

TEST(Quantise, GoesThereAndBack) {
  for (const Resolution resolution :
       {Resolution(1e-6), Resolution(1e-9), Resolution(0.001), Resolution(0.3), Resolution(7),
        Resolution(1.0 / 3), Resolution(0.001, 0.05), Resolution(0.3, 1.0 / 3)})
    for (const std::int64_t units : {1L, 2L, 3L, 7L, 49L, 353'553L, 999'999L, 123'456'789L}) {
      SCOPED_TRACE(std::to_string(resolution.length) + " " + std::to_string(units));
      EXPECT_EQ(quantise_radius(radius_in_input_units(Length(units), resolution), resolution),
                Length(units));
      EXPECT_EQ(quantise_coordinate(in_input_units(Length(-units), resolution), resolution),
                Length(-units));
      EXPECT_EQ(quantise_duration(in_input_units(Ticks(units), resolution), resolution),
                Ticks(units));
      EXPECT_EQ(quantise_speed(speed_in_input_units(Speed(units), resolution), resolution),
                Speed(units));
      EXPECT_TRUE(is_about(in_input_units(units, resolution), units, resolution));
      EXPECT_FALSE(is_about(in_input_units(units + 1, resolution), units, resolution));
    }
  EXPECT_EQ(in_input_units(1'414'214, 1e-6), 1.414214);
  const Resolution apart(0.001, 0.01);  // Millimetres and hundredths of a second, say.
  EXPECT_EQ(in_input_units(Length{350}, apart), 0.35);
  EXPECT_EQ(in_input_units(Ticks{350}, apart), 3.5);
  EXPECT_EQ(quantise_speed(0.8, apart), 8 * kUnitSpeed);
  EXPECT_EQ(speed_in_input_units(8 * kUnitSpeed, apart), 0.8);
}

TEST(Quantise, RefusesWhatIsNotSupported) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, inf, -inf, 1e300}) {
    EXPECT_EQ(quantise_coordinate(wrong, 1e-6), std::nullopt);
    EXPECT_EQ(quantise_radius(wrong, 1e-6), std::nullopt);
    EXPECT_EQ(quantise_duration(wrong, 1e-6), std::nullopt);
    EXPECT_EQ(quantise_speed(wrong, 1), std::nullopt);
  }
  for (const double resolution : {0.0, -1.0, nan, inf}) {
    EXPECT_EQ(quantise_coordinate(1, resolution), std::nullopt);
    EXPECT_EQ(quantise_speed(1, {1, resolution}), std::nullopt);
  }
  EXPECT_EQ(quantise_radius(0.9e-6, 1e-6), std::nullopt);
  EXPECT_EQ(quantise_radius(-1, 1e-6), std::nullopt);
  EXPECT_EQ(quantise_radius(1.9e-6, 1e-6), Length{1});  // down
  EXPECT_EQ(quantise_radius_up(1.1e-6, 1e-6), Length{2});
  EXPECT_EQ(quantise_radius_up(0.35, 1e-3), Length{350});
  EXPECT_EQ(quantise_radius_up(1e-12, 1e-6), Length{1});
  EXPECT_EQ(quantise_radius_up(0, 1e-6), std::nullopt);
  EXPECT_EQ(quantise_radius_up(nan, 1e-6), std::nullopt);
  EXPECT_EQ(quantise_radius_up(std::ldexp(1.0, 40), 1), geometry::kMaxLength);
  EXPECT_EQ(quantise_radius_up(std::ldexp(1.0, 40) + 1, 1), std::nullopt);
  EXPECT_EQ(quantise_coordinate(1.9e-6, 1e-6), Length{2});  // to the nearest
  EXPECT_EQ(quantise_duration(0.4e-6, 1e-6), std::nullopt);
}

}  // namespace
}  // namespace quadrille::continuous
