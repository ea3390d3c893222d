// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

using RoadmapTest = RoadmapCliTest;

TEST_F(RoadmapTest, ASecondVerifierIsAsked) {
  const Finished solved =
      run(discs("solve", {"--check-with", "fcl", "--plan", path("checked.json")}));
  ASSERT_EQ(solved.code, 0) << solved.err;
  EXPECT_THAT(solved.out, HasSubstr("fcl        clear; 0 pairs of bodies collide, 0 touch"));
  const Finished checked =
      run(discs("verify", {"--check-with", "fcl", "--json", "-", path("checked.json")}));
  ASSERT_EQ(checked.code, 0) << checked.err;
  EXPECT_EQ(json::parse(checked.out)["second_opinion"]["verdict"], "clear");
  const Finished unknown = run(discs("verify", {"--check-with", "me", path("checked.json")}));
  EXPECT_EQ(unknown.code, 64);
}

TEST_F(RoadmapTest, HumanOutputOfASmallSolve) {
  const Finished finished = run(discs("solve"));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  for (const char* part :
       {"discs.json: 4 vertices, 6 edges\n", "agents     2 from ",
        "radius 0.25 to 0.3, speed 1 to 2\n",
        "units      one tick, and one length unit, is 0.001\n", "system     dpll",
        "objective sum-of-costs, seed 0\n", "result     optimal\n",
        "cost       5.015 (sum-of-costs), lower bound 5.015\n",
        "verified   2 agents, makespan 2.9, sum of costs 5.015, no violations\n",
        "least clearance 7.3e-05, between agents 0 and 1 at 0.623\n", "claim      exact in ticks",
        "    0     2.115  0 (0.115) 1 2\n", "    1       2.9  2 1 3 1 0\n"})
    EXPECT_THAT(finished.out, HasSubstr(part));
}

TEST_F(RoadmapTest, RoundedDurationsAreTold) {
  // At 1.4 a lane of 0.1 takes 0.0714, which are 1.4 ticks.
  const auto write_lane = [&](const std::string& resolution) {
    write("lane.json",
          "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": " + resolution +
              ", \"roadmap\": {\"vertices\": [[0, 0], [0.1, 0]], \"edges\": [[0, 1]]},\n"
              "\"agents\": [{\"start\": 0, \"goal\": 1, \"radius\": 0.3, \"speed\": 1.4}]}\n");
  };
  const auto on_lane = [&](const std::string& command, const std::vector<std::string>& more) {
    return run(std::vector<std::string>{command, "--instance", path("lane.json")} + more);
  };
  const std::string warning =
      "quadrille: warning: " + path("lane.json") +
      ": durations are rounded by up to 30 %: from 0 to 1, agent 0 is planned to take 0.05 instead "
      "of 0.07143; a smaller resolution of time mends that\n";
  write_lane("0.05");
  Finished finished = on_lane("solve", {"--json", path("r.json"), "--plan", path("p.json")});
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(finished.err, warning);
  EXPECT_NEAR(json::parse(read("r.json"))["duration_error"].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(on_lane("verify", {path("p.json")}).err, warning);
  EXPECT_EQ(on_lane("export", {"--to", "csv", path("p.json")}).err, warning);
  EXPECT_EQ(on_lane("export", {"--to", "vda5050", path("p.json")}).err, warning);
  EXPECT_EQ(on_lane("solve", {"--quiet"}).err, "");
  EXPECT_EQ(on_lane("verify", {"--quiet", path("p.json")}).err, "");
  write_lane("0.0001");
  finished = on_lane("solve", {"--json", path("r.json")});
  EXPECT_EQ(finished.err, "");
  EXPECT_LT(json::parse(read("r.json"))["duration_error"].get<double>(), 0.001);
}

TEST_F(RoadmapTest, JsonHasAllThatIsDocumented) {
  ASSERT_EQ(
      run(discs("solve", {"--seed", "9", "--time-limit", "30", "--json", path("r.json")})).code, 0);
  const json result = json::parse(read("r.json"));
  for (const char* key : {"quadrille",  "status",      "objective",         "cost",
                          "cost_ticks", "lower_bound", "lower_bound_ticks", "resolution",
                          "claim",      "stop_reason", "explanation",       "internal_error",
                          "agents",     "bodies",      "duration_error",    "least_clearance",
                          "statistics", "gap_percent", "version",           "seed",
                          "options",    "plan"})
    EXPECT_TRUE(result.contains(key)) << key;
  EXPECT_EQ(result.size(), 22u);
  EXPECT_EQ(result["status"], "optimal");
  EXPECT_EQ(result["cost"], 5.015);
  EXPECT_EQ(result["cost_ticks"], 5015);
  EXPECT_EQ(result["lower_bound_ticks"], 5015);
  EXPECT_EQ(result["resolution"], 0.001);
  EXPECT_EQ(result["bodies"], json::array({{{"radius", 0.3}}, {{"radius", 0.25}}}));
  EXPECT_EQ(result["seed"], 9);
  EXPECT_EQ(result["options"]["time_limit"], 30);
  EXPECT_EQ(result["options"]["instance"], path("discs.json"));
  EXPECT_TRUE(result["options"]["roadmap"].is_null());
  ASSERT_EQ(result["plan"].size(), 2u);
  EXPECT_EQ(result["plan"][0][0], json({{"vertex", 0},
                                        {"at", {0, 0}},
                                        {"arrive", 0},
                                        {"arrive_ticks", 0},
                                        {"depart", 0.115},
                                        {"depart_ticks", 115}}));
  const json last = result["plan"][0].back();
  EXPECT_EQ(last["arrive_ticks"], 2115);
  EXPECT_FALSE(last.contains("depart"));
}

TEST_F(RoadmapTest, BothSystemsAndObjectivesWork) {
  for (const char* system : {"dpll", "smt-cbs"})
    for (const char* objective : {"sum-of-costs", "makespan"}) {
      const Finished finished = run(
          discs("solve", {"--system", system, "--objective", objective, "--quiet", "--json", "-"}));
      ASSERT_EQ(finished.code, 0) << finished.err;
      EXPECT_EQ(json::parse(finished.out)["cost_ticks"],
                std::string(objective) == "makespan" ? 2900 : 5015);
    }
}

TEST_F(RoadmapTest, ThreadsFindTheSameCost) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, std::vector<std::string>{"--race"}}) {
    std::vector<std::string> options{"--threads", "2", "--json", path("r.json")};
    options.insert(options.end(), more.begin(), more.end());
    ASSERT_EQ(run(discs("solve", options)).code, 0);
    const json result = json::parse(read("r.json"));
    EXPECT_EQ(result["cost"], 5.015);
    EXPECT_EQ(result["options"]["threads"], 2);
    EXPECT_EQ(result["options"]["race"], !more.empty());
  }
  const Finished refused = run(discs("solve", {"--race"}));
  EXPECT_EQ(refused.code, 64);
  EXPECT_THAT(refused.err, HasSubstr("--race needs --threads"));
}

TEST_F(RoadmapTest, VerifyAcceptsWhatSolveWritesInEachFormat) {
  for (const std::string name : {"p.json", "p.xml", "r.json"}) {
    SCOPED_TRACE(name);
    const char* option = name == "r.json" ? "--json" : "--plan";
    ASSERT_EQ(run(discs("solve", {"--quiet", option, path(name)})).code, 0);
    const Finished finished = run(discs("verify", {path(name)}));
    EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("sum of costs 5.015, no violations\n"));
    EXPECT_THAT(finished.out, HasSubstr("least clearance 7.3e-05, between agents 0 and 1"));
  }
  EXPECT_THAT(read("p.xml"), HasSubstr("<section number=\"0\" start_id=\"0\" goal_id=\"0\""));
  // The format can be named instead.
  ASSERT_EQ(run(discs("solve", {"--quiet", "--plan", path("p"), "--plan-format", "ccbs"})).code, 0);
  EXPECT_EQ(read("p"), read("p.xml"));
  EXPECT_EQ(run(discs("verify", {path("p"), "--plan-format", "ccbs"})).code, 0);
  EXPECT_EQ(run(discs("verify", {path("p"), "--plan-format", "json"})).code, 65);
}

TEST_F(RoadmapTest, VerifyNamesEachViolationAndExitsWith1) {
  ASSERT_EQ(run(discs("solve", {"--quiet", "--json", path("r.json")})).code, 0);
  json plan = json::parse(read("r.json"));
  for (json& path : plan["plan"])
    for (json& stop : path)
      for (const char* key : {"arrive", "depart", "at"}) stop.erase(key);
  json early = plan;  // agent 0 does not wait: one tick is enough to collide
  early["plan"][0] = json::array({{{"vertex", 0}, {"arrive_ticks", 0}, {"depart_ticks", 114}},
                                  {{"vertex", 1}, {"arrive_ticks", 1114}, {"depart_ticks", 1114}},
                                  {{"vertex", 2}, {"arrive_ticks", 2114}}});
  const Finished collision = run(discs("verify", {write("early.json", early.dump())}));
  EXPECT_EQ(collision.code, 1);
  EXPECT_THAT(collision.out, HasSubstr("invalid    1 violation\n"));
  EXPECT_THAT(
      collision.out,
      HasSubstr("agents 0 and 1 collide between times 0.609 and 0.637: nearest at about 0.62"));
  EXPECT_THAT(collision.out,
              HasSubstr(", while agent 0 moves from vertex 0 to vertex 1 and agent 1 "
                        "moves from vertex 1 to vertex 3, at most 0.0015 too close\n"));
  EXPECT_THAT(collision.out, HasSubstr("least clearance -"));
  json slow = plan;
  slow["plan"][0].back()["arrive_ticks"] = 2116;
  const Finished duration = run(discs("verify", {write("slow.json", slow.dump())}));
  EXPECT_EQ(duration.code, 1);
  EXPECT_THAT(duration.out, HasSubstr("agent 0 moves from vertex 1 to vertex 2 at time 1.115 and "
                                      "takes 1.001, but the edge takes 1\n"));
  const Finished quiet = run(discs("verify", {path("slow.json"), "--quiet"}));
  EXPECT_EQ(quiet.code, 1);
  EXPECT_EQ(quiet.out, "");
  json lie = plan;
  lie["cost_ticks"] = 5014;
  lie.erase("cost");
  const Finished false_cost = run(discs("verify", {write("lie.json", lie.dump())}));
  EXPECT_EQ(false_cost.code, 1);
  EXPECT_THAT(false_cost.out, HasSubstr("states a sum of costs of 5014, but it is 5015"));
}

TEST_F(RoadmapTest, GraphmlWithTasksIsSolvedLikeItsJson) {
  const std::vector<std::string> arguments = xml("solve", {"--quiet", "--json", "-"});
  const Finished finished = run(arguments);
  ASSERT_EQ(finished.code, 0) << finished.err;
  const json first = json::parse(finished.out);
  ASSERT_EQ(run(xml("convert", {"--to", "json", "--output", path("i.json")})).code, 0);
  const Finished again = run({"solve", "--instance", path("i.json"), "--quiet", "--json", "-"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["plan"], first["plan"]);
  EXPECT_EQ(first["options"]["radius"], 0.3);
  EXPECT_EQ(first["resolution"], 1e-6);
}

TEST_F(RoadmapTest, AMovingAiMapIsAGridWhenAskedFor) {
  const std::vector<std::string> grid = {"--roadmap",        path("small.map"), "--task",
                                         path("small.scen"), "--agents",        "3"};
  const Finished solved = run(std::vector<std::string>{"solve"} + grid +
                              std::vector<std::string>{"--plan", path("p.xml")});
  ASSERT_EQ(solved.code, 0) << solved.err;
  EXPECT_THAT(solved.out, HasSubstr("4 x 3 grid, 2^3 neighbours, 10 vertices"));
  EXPECT_THAT(read("p.xml"), HasSubstr("start_i="));
  EXPECT_EQ(
      run(std::vector<std::string>{"verify"} + grid + std::vector<std::string>{path("p.xml")}).code,
      0);
  ASSERT_EQ(run(std::vector<std::string>{"convert"} + grid +
                std::vector<std::string>{"--to", "json", "--output", path("p.json"), path("p.xml")})
                .code,
            0);
  EXPECT_EQ(
      run(std::vector<std::string>{"verify"} + grid + std::vector<std::string>{path("p.json")})
          .code,
      0);
  const Finished four = run(std::vector<std::string>{"info"} + grid +
                            std::vector<std::string>{"--neighbourhood", "2"});
  EXPECT_THAT(four.out, HasSubstr("2^2 neighbours, 10 vertices, 20 edges"));
}

TEST_F(RoadmapTest, InfoDescribesRoadmapAndAgents) {
  const Finished finished = run(discs("info"));
  EXPECT_EQ(finished.code, 0);
  EXPECT_THAT(finished.out, HasSubstr("components 1, of 4 vertices\n"));
  EXPECT_THAT(finished.out, HasSubstr("degrees    1: 3, 3: 1"));
  EXPECT_THAT(finished.out, HasSubstr("classes    2 "));
  EXPECT_THAT(finished.out, HasSubstr("distances  sum 3, largest 2 (lower bounds"));
  const Finished alone = run({"info", "--roadmap", path("map.xml")});
  EXPECT_EQ(alone.code, 0) << alone.err;
  EXPECT_THAT(alone.out, Not(HasSubstr("distances")));
}

TEST_F(RoadmapTest, TwoAgentsThatCannotPassAreInfeasible) {
  const std::string discs_json = read("discs.json");
  write("narrow.json", std::string(discs_json).replace(discs_json.find("0.8]"), 4, "0.54]"));
  const Finished finished = run({"solve", "--instance", path("narrow.json"), "--json", "-"});
  EXPECT_EQ(finished.code, 20) << finished.err;
  const json result = json::parse(finished.out);
  EXPECT_EQ(result["status"], "infeasible");
  EXPECT_TRUE(result["lower_bound"].is_null());
  EXPECT_TRUE(result["lower_bound_ticks"].is_null());
  EXPECT_TRUE(result["plan"].is_null());
  EXPECT_THAT(result["explanation"], HasSubstr("reach their goals"));
}

TEST_F(RoadmapTest, GeneratedRoadmapsAreTheSameForASeedAndAreSolved) {
  const std::vector<std::string> generate = {
      "generate", "--kind", "roadmap",  "--vertices", "20",      "--agents", "6",
      "--width",  "12",     "--height", "12",         "--mixed", "--seed",   "4"};
  const Finished first = run(generate);
  ASSERT_EQ(first.code, 0) << first.err;
  ASSERT_EQ(run(generate + std::vector<std::string>{"--instance-output", path("d.json")}).code, 0);
  EXPECT_EQ(first.out, read("d.json"));
  EXPECT_EQ(run({"solve", "--instance", path("d.json"), "--plan", path("p.json")}).code, 0);
  EXPECT_EQ(run({"verify", "--instance", path("d.json"), path("p.json")}).code, 0);
}

TEST_F(RoadmapTest, KnownPlansAreHeldAgainstTheClauses) {
  // There are clauses only where the search of routes does not answer, with which dpll begins for
  // few agents unless there is a plan to check clauses against.
  ASSERT_EQ(run({"generate", "--kind", "roadmap", "--vertices", "20", "--agents", "8", "--width",
                 "9", "--height", "9", "--seed", "2", "--instance-output", path("eight.json")})
                .code,
            0);
  for (const auto& instance :
       {discs("solve", {}), discs("solve", {"--system", "smt-cbs"}),
        std::vector<std::string>{"solve", "--instance", path("eight.json"), "--cpu-limit", "20"}}) {
    SCOPED_TRACE(testing::PrintToString(instance));
    ASSERT_EQ(run(instance + std::vector<std::string>{"--quiet", "--plan", path("p.xml")}).code, 0);
    const Finished known = run(instance + std::vector<std::string>{"--quiet", "--known-plan",
                                                                   path("p.xml"), "--json", "-"});
    ASSERT_EQ(known.code, 0) << known.err;
    EXPECT_GT(json::parse(known.out)["statistics"]["collision_clauses"], 0);
  }
  const Finished wrong =
      run(discs("solve", {"--known-plan", write("w.xml", "<root><log/></root>")}));
  EXPECT_EQ(wrong.code, 65);
  EXPECT_THAT(wrong.err, HasSubstr("w.xml:1: there is no plan"));
}

TEST_F(RoadmapTest, EveryLimitEndsTheSearchAndIsNamed) {
  const struct {
    std::vector<std::string> limit;
    const char* reason;
  } cases[] = {{{"--time-limit", "0"}, "wall-time"},
               {{"--time-limit", "0.001"}, "wall-time"},
               {{"--cpu-limit", "0.01"}, "cpu-time"},
               {{"--memory-limit", "1"}, "memory"},
               {{"--conflict-limit", "1"}, "conflicts"}};
  for (const auto& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.limit));
    const Finished finished =
        run(crowd("solve", c.limit + std::vector<std::string>{"--quiet", "--json", "-"}));
    ASSERT_THAT(finished.code, testing::AnyOf(10, 30)) << finished.err;
    const json result = json::parse(finished.out);
    EXPECT_EQ(result["status"], finished.code == 10 ? "feasible" : "unknown");
    EXPECT_EQ(result["stop_reason"], c.reason);
    EXPECT_TRUE(result["lower_bound_ticks"].is_number_integer());
  }
}

TEST_F(RoadmapTest, AGapEndsTheSearchWithAPlan) {
  ASSERT_EQ(run({"generate", "--kind", "roadmap", "--vertices", "40", "--agents", "25", "--width",
                 "9", "--height", "9", "--seed", "1", "--instance-output", path("some.json")})
                .code,
            0);
  const Finished wide = run({"solve", "--instance", path("some.json"), "--gap", "99", "--quiet",
                             "--cpu-limit", "20", "--json", "-"});
  EXPECT_EQ(wide.code, 10) << wide.err;
  const json result = json::parse(wide.out);
  EXPECT_EQ(result["status"], "feasible");
  EXPECT_EQ(result["stop_reason"], "gap");
  EXPECT_EQ(result["options"]["gap"], 99);
  EXPECT_GT(result["cost_ticks"], result["lower_bound_ticks"]);
  for (const char* system : {"dpll", "smt-cbs"}) {
    const Finished narrow =
        run(discs("solve", {"--gap", "0", "--system", system, "--quiet", "--json", "-"}));
    EXPECT_EQ(narrow.code, 0);
    EXPECT_EQ(json::parse(narrow.out)["cost_ticks"], 5015);
  }
}

TEST_F(RoadmapTest, AnInterruptKeepsTheBound) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process(folder_, crowd("solve", {"--quiet", "--json", "-"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    process.signal(signal);
    const Finished finished = process.wait(4);
    EXPECT_EQ(finished.signal, 0);
    ASSERT_THAT(finished.code, testing::AnyOf(10, 30)) << finished.err;
    const json result = json::parse(finished.out);
    EXPECT_EQ(result["stop_reason"], "interrupt");
    EXPECT_GT(result["lower_bound_ticks"], 0);
  }
}

TEST_F(RoadmapTest, AFullDeviceIs74ForEveryOutput) {
  ASSERT_EQ(run(discs("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  for (const auto& arguments :
       {discs("solve", {"--json", "/dev/full"}), discs("solve", {"--plan", "/dev/full"}),
        discs("convert", {"--to", "json", "--output", "/dev/full"}),
        discs("convert", {"--to", "ccbs", "--output", "/dev/full", path("p.json")}),
        std::vector<std::string>{"generate", "--kind", "roadmap", "--vertices", "4", "--agents",
                                 "1", "--instance-output", "/dev/full"}}) {
    const Finished finished = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments));
    EXPECT_EQ(finished.code, 74);
    EXPECT_THAT(finished.err, HasSubstr("quadrille: /dev/full: cannot write: No space left"));
  }
  const Finished lost = run(discs("solve", {"--quiet", "--plan", "/dev/full"}));
  EXPECT_THAT(lost.err, HasSubstr("\"plan\": ["));
  for (const auto& arguments : {discs("solve"), discs("verify", {path("p.json")}), discs("info"),
                                discs("convert", {"--to", "json"})}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Finished finished = run(arguments, "/dev/full");
    EXPECT_EQ(finished.code, 74);
    EXPECT_THAT(finished.err, HasSubstr("quadrille: standard output: cannot write"));
  }
}

}  // namespace
}  // namespace quadrille::cli::test
