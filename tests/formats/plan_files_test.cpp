// SPDX-License-Identifier: MIT
//
// Plans and instances of other programs on grids, graphs and roadmaps.
#include "quadrille/continuous/plan_files.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "formats/plan_samples.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::formats {
namespace {

using discrete::Instance;
using discrete::PlanFile;

Result<PlanFile> read(const std::string& text, const Instance& instance = crossing(),
                      std::optional<discrete::PlanFormat> format = std::nullopt) {
  std::istringstream in(text);
  return read_plan(in, "f", instance, format);
}

void refuses(const std::string& text, const std::string& why) {
  const auto plan = read(text);
  ASSERT_FALSE(plan.has_value()) << why;
  EXPECT_EQ(plan.error().to_string().substr(0, why.size()), why);
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(PlanFiles, AreTheSamePlanInAllFormats) {
  const discrete::Plan expected = read(kLns2).value().plan;
  const auto report = verify(crossing(), expected);
  EXPECT_TRUE(report.valid());
  EXPECT_EQ(report.sum_of_costs, 6);
  for (const std::string& text : {kLacam, kPlanViz, kTracker, kAtb033}) {
    const auto plan = read(text);
    ASSERT_TRUE(plan.has_value()) << plan.error().to_string() << "\n" << text;
    const auto again = verify(crossing(), plan->plan);
    EXPECT_TRUE(again.valid()) << text;
    EXPECT_EQ(again.sum_of_costs, 6) << text;
    EXPECT_EQ(again.makespan, 4) << text;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t t = 0; t < expected.paths[AgentId(i)].size(); ++t)
        EXPECT_EQ(plan->plan.paths[AgentId(i)][t], expected.paths[AgentId(i)][t]) << text;
  }
}

TEST(PlanFiles, ResultsOfLacamStateWhatIsChecked) {
  const auto plan = read(kLacam);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->stated.sum_of_costs, 6);
  EXPECT_EQ(plan->stated.makespan, 4);
  EXPECT_EQ(plan->stated.lower_bound, 5);
  EXPECT_TRUE(read(kLacam, crossing(), discrete::PlanFormat::visualizer).has_value());
  refuses(changed(kLacam, "agents=2", "agents=3"), "f:1: 3 agents are stated, but 2 have paths");
  refuses(changed(kLacam, "starts=(1,0)", "starts=(2,1)"),
          "f:6: these are not the places where the paths begin");
  refuses(changed(kLacam, "goals=(1,2)", "goals=(2,1)"),
          "f:7: these are not the places where the paths end");
  refuses(changed(kLacam, "starts=(1,0)", "starts=(0,0)"), "f:6: agent 0 at timestep 0: (0, 0) is");
  refuses(changed(kLacam, "solved=1", "solved=0"), "f:3: there is no plan: solved=0");
  refuses(changed(kLacam, "soc=6", "soc=seven"), "f:4: soc is 'seven', not a natural number");
  refuses(changed(kLacam, "makespan=4", "soc=7"), "f:5: soc is given twice");
  refuses(kLacam.substr(0, kLacam.find("solution=")),
          "f:10: there is no plan: no line 'solution='");
}

TEST(PlanFiles, OfTheTrackerBeginAtTheStarts) {
  const auto plan = read(kTracker);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->stated.sum_of_costs, 6);
  EXPECT_EQ(plan->stated.lower_bound, 5);
  std::istringstream in(kTracker);
  const auto alone = read_plan(in, "f", crossing().graph());
  ASSERT_FALSE(alone.has_value());
  EXPECT_NE(alone.error().message.find("needs a scenario"), std::string::npos);
  // With up and down exchanged the first step leaves the grid.
  refuses(changed(kTracker, "w3rw\",FALSE", "w3rw\",TRUE"),
          "f:3: agent 0, timestep 1: (1, -1) is outside");
  refuses(changed(kTracker, "2d2w", "2x2w"), "f:3: expected moves such as 5r2d3w, found '2x2w'");
  refuses(changed(kTracker, ",1,2,5", ",1,4,5"), "f: there is no row for 2 agents");
  refuses(changed(kTracker, ",1,1,2", ",1,2,2"), "f:3: a second row for 2 agents");
  refuses(changed(kTracker, "\nw3rw", ""), "f:3: 1 paths for 2 agents");
  refuses(changed(kTracker, "3rw\"", "3rw"), "f:3: the file ends inside of quotes");
  refuses(changed(kTracker, "agents,", "robots,"), "f:1: there is no column 'agents'");
  refuses(changed(kTracker, "2d2w", "99999999999d"), "f:3: expected moves such as");
}

TEST(PlanFiles, OfPlanVizHaveNoTurns) {
  refuses(changed(kPlanViz, "\"MAPF\"", "\"MAPF_T\""),
          "f:1: /actionModel: plans of the model 'MAPF_T' have turns");
  refuses(
      changed(kPlanViz, "D,D,W", "D,F,W"),
      "f:3: /actualPaths/0: expected moves U, D, L, R and W with commas between them, found 'F");
  refuses(changed(kPlanViz, "D,D,W", "U,D,W"),
          "f:3: /actualPaths/0: timestep 1: (1, -1) is outside the grid");
  refuses(changed(kPlanViz, "\"teamSize\": 2", "\"teamSize\": 3"),
          "f:1: /teamSize: 2 paths, not as many");
  refuses(changed(kPlanViz, ", \"W,R,R,R\"", ""), "f:3: /actualPaths: 1 paths, but 2 starts");
  refuses(changed(kPlanViz, "[0, 1, \"N/A\"]", "[0, 0, \"N/A\"]"),
          "f:2: /start/0: (0, 0) is block");
}

TEST(PlanFiles, OfOtherKindsAreCalledByTheirNames) {
  refuses("type octile\n", "f:1: this is a map of MovingAI's: it belongs to --map");
  refuses("<root><log/></root>", "f:1: this is a log of CCBS");
  std::istringstream in(kPlanViz);
  const auto named = read_plan(in, "f", crossing(), discrete::PlanFormat::json);
  ASSERT_FALSE(named.has_value());
  EXPECT_NE(named.error().message.find("PlanViz"), std::string::npos);
}

TEST(InstanceFiles, RoadmapsOfLibMultiRobotPlanning) {
  const auto read_yaml = [](const std::string& text) {
    std::istringstream in(text);
    return discrete::read_instance_yaml(in, "f");
  };
  const auto instance = read_yaml(kLibmrpRoadmap);
  ASSERT_TRUE(instance.has_value()) << instance.error().to_string();
  EXPECT_EQ(instance->graph().num_vertices(), 4u);
  EXPECT_EQ(instance->graph().num_edges(), 3u);
  // B, A, C, D in the order of the file.
  EXPECT_EQ(instance->agents()[AgentId(0)], (discrete::Agent{VertexId(0), VertexId(2)}));
  EXPECT_EQ(instance->agents()[AgentId(1)], (discrete::Agent{VertexId(2), VertexId(3)}));
  const auto refuse = [&](const std::string& from, const std::string& to, const std::string& why) {
    const auto wrong = read_yaml(changed(kLibmrpRoadmap, from, to));
    ASSERT_FALSE(wrong.has_value()) << why;
    EXPECT_EQ(wrong.error().to_string().substr(0, why.size()), why);
  };
  refuse("undirected: True", "undirected: False", "f:2: /roadmap/undirected: only undirected");
  refuse("actions: true", "actions: false", "f:3: /roadmap/allow_wait_actions: agents may always");
  refuse("[A, C]", "[A, A]", "f:6: /roadmap/edges/1: an edge from a vertex to itself");
  refuse("goal: 7", "goal: E", "f:14: /agents/1/goal: there is no vertex 'E'");
  refuse("  edges:", "  conflicts: []\n  edges:",
         "f:4: /roadmap/conflicts: conflicts between edges are not supported");
}

TEST(MapFiles, HeadersOfPublishedMaps) {
  const auto read_map = [](const std::string& text) {
    std::istringstream in(text);
    return discrete::read_map(in, "f");
  };
  const auto plain = read_map("type octile\nheight 1\nwidth 2\nmap\n.@\n").value();
  for (const char* const text :
       {"type octile \nheight 1\t\nwidth 2 \nmap \n.@\n", "height 1\nwidth 2\nmap\n.@\n",
        "type octile\nwidth 2\nheight 1\nmap\n.@\n",
        "\xEF\xBB\xBFtype octile\nheight 1\nwidth 2\nmap\n.@\n"})
    EXPECT_EQ(read_map(text).value(), plain) << text;
  for (const char* const text :
       {"height 1\nheight 1\nmap\n.@\n", "type octile\nheight 1\nmap\n.@\n",
        "height 1\nwidth 2\n.@\n", " height 1\nwidth 2\nmap\n.@\n"})
    EXPECT_FALSE(read_map(text).has_value()) << text;
  // Blanks in rows are letters.
  EXPECT_FALSE(read_map("type octile\nheight 1\nwidth 2\nmap\n.@ \n").has_value());
}

TEST(MapFiles, SizesOfScenariosAreNotTrusted) {
  const auto graph = std::make_shared<const discrete::Graph>(crossing().graph());
  const auto scenario_of = [](const std::string& text) {
    std::istringstream in(text);
    return discrete::read_scenario(in, "f").value();
  };
  const std::string row = "0\ta.map\t3\t3\t1\t0\t1\t2\t0\n";
  const auto right = scenario_of("version 1\n" + row);
  EXPECT_EQ(note_on_sizes(right, 4, 3),
            "line 2 is for a map of 3 x 3 cells, and this one has 4 x 3"
            "; all cells are inside of it");
  EXPECT_EQ(note_on_sizes(right, 3, 3), "");
  EXPECT_TRUE(make_instance(graph, right, 1).has_value());
  // The cell is beyond the size that the row states, and on the map.
  EXPECT_TRUE(
      make_instance(graph, scenario_of("version 1\n0\ta\t2\t3\t3\t1\t1\t2\t0\n"), 1).has_value());
  const auto outside =
      make_instance(graph, scenario_of("version 1\n0\ta\t9\t9\t8\t1\t1\t2\t0\n"), 0);
  ASSERT_FALSE(outside.has_value());
  EXPECT_EQ(
      outside.error().to_string(),
      "f:2: the start (8, 1) is outside the map of 4 x 3 cells, and the row is for one of 9 x 9");
}

TEST(LogFiles, OfCcbsHaveCoordinatesOnRoadmaps) {
  std::istringstream in(kSidingJson);
  const continuous::Instance instance = continuous::read_instance_json(in, "i").value();
  const auto read_log = [&](const std::string& text) {
    std::istringstream log(text);
    return continuous::read_plan(log, "f", instance);
  };
  const auto by_ids = read_log(kLogWithIds), by_places = read_log(kLogWithPlaces);
  ASSERT_TRUE(by_ids.has_value()) << by_ids.error().to_string();
  ASSERT_TRUE(by_places.has_value()) << by_places.error().to_string();
  EXPECT_EQ(by_places->plan, by_ids->plan);
  EXPECT_TRUE(verify(instance, by_places->plan).valid());
  // Six digits are enough, and no other place is near.
  EXPECT_EQ(read_log(changed(kLogWithPlaces, "goal_i=\"1.5\"", "goal_i=\"1.50000\"")).value().plan,
            by_ids->plan);
  const auto wrong = read_log(changed(kLogWithPlaces, "goal_i=\"1.5\"", "goal_i=\"1.6\""));
  ASSERT_FALSE(wrong.has_value());
  EXPECT_EQ(wrong.error().to_string(),
            "f:5: the goal of a section, (1.6, 0), is no vertex of the roadmap");
}

}  // namespace
}  // namespace quadrille::formats
