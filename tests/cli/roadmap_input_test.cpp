// SPDX-License-Identifier: MIT
//
// What is refused where time is continuous: command lines (64) and files (65).
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;

class RoadmapInputTest : public RoadmapCliTest {
 protected:
  void expect_refused(const std::vector<std::string>& arguments, const std::string& reason) {
    const Finished finished = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments) + "\n" + finished.err);
    EXPECT_EQ(finished.code, 65);
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.err, HasSubstr(reason));
    // One reason, one line.
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1);
  }
  /// As a person reads it and as JSON.
  void expect_no_plan(std::vector<std::string> arguments, const std::string& reason) {
    const Finished finished = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments) + "\n" + finished.err);
    EXPECT_EQ(finished.code, 20);
    EXPECT_EQ(finished.err, "");
    EXPECT_THAT(finished.out, HasSubstr("result     infeasible\nwhy        "));
    EXPECT_THAT(finished.out, HasSubstr(reason + "\n"));
    arguments.insert(arguments.end(), {"--quiet", "--json", "-"});
    const auto json = nlohmann::json::parse(run(arguments).out);
    EXPECT_EQ(json.at("status"), "infeasible");
    EXPECT_THAT(std::string(json.at("explanation")), HasSubstr(reason));
    for (const char* key : {"plan", "cost", "lower_bound", "agents", "bodies", "resolution"})
      EXPECT_TRUE(json.at(key).is_null()) << key;
  }
  /// The roadmap of map.xml with another task.
  std::vector<std::string> with_task(const std::string& rows, const std::string& agents = "2") {
    return {"solve",
            "--roadmap",
            path("map.xml"),
            "--task",
            write("bad.xml", "<root>\n" + rows + "</root>\n"),
            "--agents",
            agents,
            "--radius",
            "0.3"};
  }
};

TEST_F(RoadmapInputTest, OptionsThatMeanNothingForRoadmapsAreRefused) {
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{"--check", "watch"},
                                             {"--cost-search", "iterative"},
                                             {"--mdd-growth", "full"},
                                             {"--forbid-first"},
                                             {"--backtracking", "jump"},
                                             {"--no-first-plan"}})
    for (const auto& command : {discs("solve", option), xml("solve", option)}) {
      SCOPED_TRACE(testing::PrintToString(command));
      const Finished finished = run(command);
      EXPECT_EQ(finished.code, 64);
      EXPECT_EQ(finished.out, "");
      EXPECT_THAT(finished.err,
                  HasSubstr("quadrille: " + option.front() + " does not apply to roadmaps\n"));
    }
}

TEST_F(RoadmapInputTest, LemmasOfRoadmapsAreAudited) {
  const Finished finished = run(discs("solve", {"--audit", "--json", "-"}));
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("\"audit\":true"));
}

TEST_F(RoadmapInputTest, WrongCommandLinesExitWith64AndNameTheCulprit) {
  const struct {
    std::vector<std::string> arguments;
    const char* culprit;
  } cases[] = {
      {{"solve", "--roadmap", "m"}, "--task is missing"},
      {{"info", "--roadmap", "m", "--agents", "3"}, "--task is missing"},
      {{"solve", "--task", "t"}, "belong to --roadmap"},
      {small("solve", {"--radius", "1"}), "belong to --roadmap"},
      {small("verify", {"--speed", "1", "p"}), "belong to --roadmap"},
      {small("info", {"--neighbourhood", "2"}), "belong to --roadmap"},
      {small("convert", {"--resolution", "1", "--to", "json"}), "belong to --roadmap"},
      {discs("solve", {"--radius", "1"}), "belong to --roadmap"},
      {discs("solve", {"--map", "m"}), "--instance excludes --map and --scen"},
      {discs("solve", {"--passable", "S"}), "--passable and --blocked belong to .map files"},
      {xml("solve", {"--blocked", "S"}), "--passable and --blocked belong to .map files"},
      {xml("solve", {"--scen", "s"}), "--roadmap goes with --task"},
      {xml("solve", {"--instance", "i"}), "--roadmap goes with --task"},
      {xml("solve", {"--system", "mdd-sat"}), "a roadmap needs --system dpll or smt-cbs"},
      {xml("solve", {"--plan-format", "json"}), "--plan-format needs --plan"},
      {xml("solve", {"--plan-every", "1"}), "--plan-every needs --plan with a file"},
      {xml("solve", {"--plan", "-", "--plan-every", "1"}), "--plan-every needs --plan with a file"},
      {xml("solve", {"--plan", "p", "--plan-format", "yaml"}), "yaml is not for roadmaps"},
      {small("solve", {"--plan", "p", "--plan-format", "ccbs"}), "ccbs is for roadmaps"},
      {small("verify", {"p", "--plan-format", "ccbs"}), "ccbs is for roadmaps"},
      {small("convert", {"p", "--to", "ccbs"}), "ccbs is for roadmaps"},
      {discs("convert", {"p", "--to", "cbsh2"}), "cbsh2 is not for roadmaps"},
      {discs("convert", {"--to", "ccbs"}), "converted to json; ccbs needs PLAN"},
      {discs("convert", {"--to", "json", "--from", "json"}), "--from needs PLAN"},
      {discs("solve", {"--plan", path("discs.json")}), "discs.json is an input"},
      {xml("solve", {"--json", path("task.xml")}), "task.xml is an input"},
      {xml("solve", {"--resolution", "1"}), "--radius: 0.3 is less than one length unit"},
      {xml("solve", {"--speed", "1e-9"}), "--speed: 1e-09 is not between"},
      {xml("solve", {"--speed", "nan"}), "--speed"},
      {xml("solve", {"--speed", "-1"}), "--speed"},
      {xml("solve", {"--resolution", "0"}), "--resolution"},
      {xml("solve", {"--resolution", "inf"}), "--resolution"},
      {xml("solve", {"--neighbourhood", "6"}), "--neighbourhood"},
      {xml("solve", {"--neighbourhood", "1"}), "--neighbourhood"},
      {{"generate", "--kind", "roadmap"}, "--agents is missing"},
      {{"generate", "--kind", "roadmap", "--agents", "3", "--map-output", "m"}, "--map-output"},
      {{"generate", "--kind", "roadmap", "--agents", "3", "--doors", "0"}, "--doors"},
      {{"generate", "--kind", "empty", "--vertices", "3"}, "--vertices"},
      {{"generate", "--kind", "roadmap", "--agents", "101"}, "101 agents"},
      {{"generate", "--kind", "roadmap", "--agents", "1", "--radius", "9"}, "do not fit"},
      {{"generate", "--kind", "roadmap", "--agents", "1", "--vertices", "99999999"}, "--vertices"},
      {{"generate", "--map", "m", "--radius", "1"}, "--radius belongs to --kind"},
  };
  for (const auto& c : cases) {
    const Finished finished = run(c.arguments);
    SCOPED_TRACE(testing::PrintToString(c.arguments));
    EXPECT_EQ(finished.code, 64);
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.err, HasSubstr(c.culprit));
    EXPECT_THAT(finished.err, HasSubstr("--help'"));
  }
}

TEST_F(RoadmapInputTest, FilesThatCannotBeRead) {
  expect_refused({"solve", "--roadmap", path("none.xml"), "--task", path("task.xml")},
                 "none.xml: ");
  expect_refused({"solve", "--roadmap", path("none.map"), "--task", path("task.xml")},
                 "none.map: ");
  expect_refused({"solve", "--roadmap", path("map.xml"), "--task", path("none.xml")}, "none.xml: ");
  expect_refused({"solve", "--roadmap", path("map.xml"), "--task", path("none.scen")},
                 "none.scen: ");
  expect_refused({"solve", "--roadmap", folder_, "--task", path("task.xml")}, "is a directory");
  expect_refused(discs("verify", {path("none")}), "none: ");
  expect_refused(discs("convert", {"--to", "json", path("none")}), "none: ");
}

TEST_F(RoadmapInputTest, RoadmapsAndTasksNameFileLineAndReason) {
  // The details are in tests/continuous; here is one of each kind.
  const auto with_map = [&](const std::string& text) {
    return std::vector<std::string>{"solve", "--roadmap", write("bad.xml", text), "--task",
                                    path("task.xml")};
  };
  expect_refused(with_map(""), "bad.xml:1: the file is empty");
  expect_refused(with_map("<graphml>\n<key"), "bad.xml:2: not well-formed XML");
  expect_refused(with_map("<svg/>"), "bad.xml:1: neither <graphml> nor <root> but 'svg'");
  expect_refused(with_map("<root><map><width>100000000000</width><height>1</height></map></root>"),
                 "bad.xml:1: <width> has to be 1 .. 65536");
  expect_refused(with_task("<agent start_id=\"0\" goal_id=\"9\"/>\n", "1"),
                 "bad.xml:2: the goal of agent 0: there is no vertex 9 among 4");
  expect_refused(with_task("<agent start_id=\"0\"/>\n", "1"), "bad.xml:2: an <agent> has start_id");
  expect_refused(with_task("<agent start_id=\"0\" goal_id=\"1\"/>\n"),
                 "bad.xml: 2 agents are asked for, but there are 1");
  expect_refused(xml("solve", {"--neighbourhood", "3"}),
                 "map.xml: --neighbourhood is for grids, and this is a roadmap");
  expect_refused(xml("solve", {"--resolution", "1e-12"}),
                 "map.xml:5: node 'n1': the coordinate 2 is too large: at a resolution of 1e-12");
}

// To look for a plan of these is to prove that there is none; nothing else can be done with them.
TEST_F(RoadmapInputTest, WhatCannotHaveAPlanIsInfeasible) {
  const std::string first = "<agent start_id=\"0\" goal_id=\"1\"/>\n";
  const struct {
    std::string second, reason;
  } cases[] = {
      {"<agent start_id=\"0\" goal_id=\"3\"/>\n", "the starts of agents 0 and 1 overlap"},
      {"<agent start_id=\"2\" goal_id=\"1\"/>\n", "the goals of agents 0 and 1 overlap"},
      {"<agent start_id=\"2\" goal_id=\"0\"/>\n",
       "agent 1 cannot reach its goal: there is no way from vertex 2 to vertex 0"},
  };
  for (const auto& c : cases) {
    std::vector<std::string> arguments = with_task(first + c.second);
    expect_no_plan(arguments, "bad.xml:3: " + c.reason);
    arguments.front() = "info";
    expect_refused(arguments, "bad.xml:3: " + c.reason);
  }
  std::string text = read("discs.json");
  const std::string goal = "\"goal\": 0";
  ASSERT_NE(text.find(goal), std::string::npos);
  text.replace(text.find(goal), goal.size(), "\"goal\": 2");
  expect_no_plan({"solve", "--instance", write("bad.json", text)},
                 "bad.json:11: the goals of agent 0 at vertex 2 and agent 1 at vertex 2 overlap");
}

TEST_F(RoadmapInputTest, MapsAndScenariosOfMovingAiToo) {
  const Finished other =
      run({"solve", "--roadmap", path("small.map"), "--task", path("corridor.scen")});
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_THAT(other.out,
              HasSubstr("corridor.scen: line 2 is for a map of 3 x 1 cells, and this one "
                        "has 4 x 3; all cells are inside of it\n"));
  expect_refused({"solve", "--roadmap", path("small.map"), "--task",
                  write("wall.scen", "version 1\n0\tm\t4\t3\t0\t0\t1\t1\t1\n")},
                 "wall.scen:2: the goal of agent 0: (1, 1) is blocked");
  expect_no_plan(
      {"solve", "--roadmap", path("small.map"), "--task",
       write("near.scen", "version 1\n0\tm\t4\t3\t0\t0\t1\t0\t1\n0\tm\t4\t3\t0\t1\t2\t0\t1\n"),
       "--radius", "0.6"},
      "near.scen:2: the goal of agent 0: a disc of radius 0.6 does not fit at (1, 0)");
}

TEST_F(RoadmapInputTest, InstancesNameFileLineAndReason) {
  const std::string good = read("discs.json");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
    return std::vector<std::string>{"solve", "--instance", write("bad.json", text)};
  };
  expect_refused(with("\"radius\": 0.3", "\"radius\": -0.3"),
                 "bad.json:10: /agents/0/radius: the radius is less than one length unit");
  expect_refused(with("[3, 1, 1.5]", "[3, 4]"),
                 "bad.json:7: /roadmap/edges/5/1: there is no vertex 4 among 4");
  expect_refused(with("\"agents\"", "\"robots\""), "bad.json:9: /robots: this key is not known");
  expect_refused(with("\n  ]\n}", ""), "bad.json:12: not valid JSON");
  // A name without extension, and a pipe.
  expect_refused({"info", "--instance", write("noname", "{\"roadmap\": 1}")},
                 "noname:1: the key 'quadrille' is missing");
  EXPECT_EQ(run({"solve", "--instance", write("discs", good), "--quiet"}).code, 0);
}

TEST_F(RoadmapInputTest, PlansOfOtherInstancesAreRefused) {
  ASSERT_EQ(run(xml("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  expect_refused(discs("verify", {path("p.json")}),
                 "p.json:4: /resolution: the resolution of the instance is 0.001");
  expect_refused(discs("verify", {write("p", "{\"resolution\": 0.001, \"status\": \"unknown\"}")}),
                 "p:1: there is no plan");
  expect_refused(discs("verify", {write("p", "Agent 0: (0,0)->\n")}),
                 "p:1: this is a file of paths of CBSH2, EECBS or LNS2: a plan on a grid");
}

TEST_F(RoadmapInputTest, NothingIsWrittenForBadInput) {
  write("old.json", "old");
  EXPECT_EQ(run(with_task("<agent/>\n") +
                std::vector<std::string>{"--json", path("old.json"), "--plan", path("new")})
                .code,
            65);
  EXPECT_EQ(read("old.json"), "old");
  EXPECT_FALSE(exists("new"));
}

}  // namespace
}  // namespace quadrille::cli::test
