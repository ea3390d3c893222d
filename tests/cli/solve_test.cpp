// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

using SolveTest = CliTest;

constexpr const char* kSystems[] = {"dpll", "dpll-mdd", "smt-cbs", "mdd-sat"};

TEST_F(SolveTest, OptimalIs0WithEverySystemAndObjective) {
  for (const char* system : kSystems)
    for (const auto& [objective, cost] : {std::pair{"sum-of-costs", 8}, {"makespan", 3}}) {
      SCOPED_TRACE(std::string(system) + " " + objective);
      const Finished finished = run(
          small("solve", {"--system", system, "--objective", objective, "--quiet", "--json", "-"}));
      ASSERT_EQ(finished.code, 0) << finished.err;
      EXPECT_EQ(finished.err, "");
      const json result = json::parse(finished.out);
      EXPECT_EQ(result["status"], "optimal");
      EXPECT_EQ(result["objective"], objective);
      EXPECT_EQ(result["cost"], cost);
      EXPECT_EQ(result["lower_bound"], cost);
      EXPECT_EQ(result["stop_reason"], "none");
      EXPECT_EQ(result["options"]["system"], system);
    }
}

TEST_F(SolveTest, CheckSchedules) {
  for (const char* check : {"watch", "propagate", "1/2", "1/3,2/3", "1/2,3/4"}) {
    SCOPED_TRACE(check);
    const Finished finished =
        run(small("solve", {"--system", "dpll-mdd", "--check", check, "--json", "-"}));
    ASSERT_EQ(finished.code, 0) << finished.err;
    EXPECT_EQ(json::parse(finished.out)["options"]["check"], check);
  }
  const Finished finished =
      run(small("solve", {"--system", "dpll", "--check", "1/2", "--json", "-"}));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out)["options"]["system"], "dpll-mdd");
}

TEST_F(SolveTest, CostSearches) {
  for (const char* search : {"iterative", "core-guided"})
    for (const char* system : kSystems) {
      SCOPED_TRACE(std::string(search) + " " + system);
      const Finished finished =
          run(small("solve", {"--system", system, "--cost-search", search, "--json", "-"}));
      ASSERT_EQ(finished.code, 0) << finished.err;
      EXPECT_EQ(json::parse(finished.out)["cost"], 8);
      EXPECT_EQ(json::parse(finished.out)["options"]["cost_search"], search);
    }
}

TEST_F(SolveTest, AllSystemsKnowGoalSets) {
  const std::string file = write("sets.json", R"({"quadrille": "instance", "version": 1,
"grid": {"width": 4, "height": 1, "rows": ["...."]},
"agents": [{"start": [1, 0], "goals": [[0, 0], [2, 0]]}, {"start": [3, 0], "goal": [2, 0]}]})");
  for (const char* system : kSystems) {
    SCOPED_TRACE(system);
    const Finished finished =
        run({"solve", "--instance", file, "--system", system, "--quiet", "--json", "-"});
    ASSERT_EQ(finished.code, 0) << finished.err;
    EXPECT_EQ(json::parse(finished.out)["cost"], 2);
  }
  const Finished proved = run({"solve", "--instance", file, "--proof", path("sets.qcert")});
  EXPECT_EQ(proved.code, 64);
  EXPECT_THAT(proved.err, HasSubstr("which --proof does not know yet"));
}

// Both are nearer to the dock in the middle than to their own.
TEST_F(SolveTest, ExplanationsSayWhoTakesWhichGoal) {
  const std::string docks = write(
      "docks.json",
      "{\"quadrille\": \"instance\", \"version\": 1, \"grid\": {\"width\": 7, \"height\": 1, "
      "\"rows\": [\".......\"]},\n\"agents\": [{\"start\": [2, 0], \"goals\": [[0, 0], [3, 0]]}, "
      "{\"start\": [4, 0], \"goals\": [[3, 0]]}]}");
  EXPECT_THAT(run({"explain", "--instance", docks}).out,
              HasSubstr("goals      agent 0 takes (0, 0), 1 farther than (3, 0), because agent 1 "
                        "takes that\n"));
  const std::string roads =
      write("roads.json",
            "{\"quadrille\": \"instance\", \"version\": 1, \"resolution\": 0.001, \"roadmap\": "
            "{\"vertices\": [[0, 0], [2, 0], [3, 0], [4, 0]], \"edges\": [[0, 1], [1, 0], [1, 2], "
            "[2, 1], [2, 3], [3, 2]]},\n\"agents\": [{\"start\": 1, \"goals\": [0, 2], \"radius\": "
            "0.3}, {\"start\": 3, \"goals\": [2], \"radius\": 0.3}]}");
  EXPECT_THAT(run({"explain", "--instance", roads}).out,
              HasSubstr("goals      agent 0 takes vertex 0, 1 farther than vertex 2, because agent "
                        "1 takes that\n"));
}

// Six agents in a column, whose goals beside them are in the opposite order: for all, each takes
// the goal of its row; in pairs, that of its partner.
TEST_F(SolveTest, AgentsShareGoals) {
  const std::string map = write("field.map",
                                "type octile\nheight 6\nwidth 6\nmap\n......\n......\n......\n"
                                "......\n......\n......\n");
  std::string rows = "version 1\n";
  for (int row = 0; row < 6; ++row)
    rows += "0\tfield.map\t6\t6\t0\t" + std::to_string(row) + "\t5\t" + std::to_string(5 - row) +
            "\t9\n";
  const std::string scen = write("field.scen", rows);
  const auto given = [&](const std::string& command, const std::string& sharing) {
    std::vector<std::string> arguments{command, "--map", map, "--scen", scen, "--agents", "6"};
    if (!sharing.empty())
      arguments = arguments + std::vector<std::string>{"--share-goals", sharing};
    return arguments;
  };
  // Nearest are for each: 5 moves in its own row; in pairs (0,1), (2,3) and (4,5) the goals are in
  // rows 5 and 4, 3 and 2, 1 and 0.
  for (const auto& [sharing, cost] : {std::pair{"all", 30}, {"6", 30}, {"7", 30}, {"2", 46}}) {
    SCOPED_TRACE(sharing);
    const Finished finished =
        run(given("solve", sharing) +
            std::vector<std::string>{"--quiet", "--json", "-", "--plan", path("shared.json")});
    ASSERT_EQ(finished.code, 0) << finished.err;
    EXPECT_EQ(json::parse(finished.out)["cost"], cost);
    EXPECT_EQ(run(given("verify", sharing) + std::vector<std::string>{path("shared.json")}).code,
              0);
    EXPECT_EQ(run(given("verify", "") + std::vector<std::string>{path("shared.json")}).code, 1);
  }
  const Finished alone = run(given("solve", "1") + std::vector<std::string>{"--json", "-"});
  EXPECT_EQ(
      json::parse(alone.out)["cost"],
      json::parse(run(given("solve", "") + std::vector<std::string>{"--json", "-"}).out)["cost"]);
}

TEST_F(SolveTest, InfeasibleIs20AndSaysWhy) {
  const Finished finished = run(corridor("solve", {"--json", "-"}));
  ASSERT_EQ(finished.code, 20) << finished.err;
  const json result = json::parse(finished.out);
  EXPECT_EQ(result["status"], "infeasible");
  EXPECT_TRUE(result["cost"].is_null());
  EXPECT_TRUE(result["lower_bound"].is_null());
  EXPECT_TRUE(result["plan"].is_null());
  EXPECT_NE(result["explanation"], "");
  EXPECT_THAT(finished.err, HasSubstr("infeasible"));
}

TEST_F(SolveTest, LimitsGive30OrAPlan) {
  const std::vector<std::string> limits[] = {{"--time-limit", "0"},     {"--time-limit", "0.001"},
                                             {"--cpu-limit", "0"},      {"--cpu-limit", "0.001"},
                                             {"--memory-limit", "1"},   {"--conflict-limit", "0"},
                                             {"--conflict-limit", "1"}, {"--time-limit", "1e-300"}};
  for (const auto& limit : limits)
    for (const char* system : kSystems) {
      SCOPED_TRACE(testing::PrintToString(limit) + system);
      Process process(folder_, hard("solve", limit + std::vector<std::string>{"--system", system,
                                                                              "--json", "-"}));
      const Finished finished = process.wait(20);
      EXPECT_THAT(finished.code, testing::AnyOf(10, 30)) << finished.err;
      const json result = json::parse(finished.out);
      EXPECT_EQ(result["status"], finished.code == 10 ? "feasible" : "unknown");
      EXPECT_NE(result["stop_reason"], "none");
      EXPECT_TRUE(result["lower_bound"].is_number_integer());
      EXPECT_EQ(result["plan"].is_null(), finished.code == 30);
    }
}

TEST_F(SolveTest, ALimitOfZeroOnAnEasyInstanceIsNeverAWrongAnswer) {
  for (const char* seconds : {"0", "0.001"}) {
    const Finished finished = run(small("solve", {"--time-limit", seconds, "--json", "-"}));
    const json result = json::parse(finished.out);
    EXPECT_THAT(finished.code, testing::AnyOf(0, 10, 30)) << finished.err;
    if (finished.code == 0) {
      EXPECT_EQ(result["cost"], 8);
    }
    EXPECT_LE(result["lower_bound"], 8);
  }
}

TEST_F(SolveTest, TheFreeCostsBoundTheCostEvenWithoutTime) {
  const std::string info = run(hard("info")).out;
  const auto at = info.find("distances  sum ");
  ASSERT_NE(at, std::string::npos) << info;
  const int sum = std::stoi(info.substr(at + 15));
  for (const char* system : kSystems) {
    const Finished finished =
        run(hard("solve", {"--time-limit", "0", "--system", system, "--quiet", "--json", "-"}));
    EXPECT_GE(json::parse(finished.out)["lower_bound"], sum) << system;
  }
}

TEST_F(SolveTest, TheSameSeedGivesTheSameAnswer) {
  const Finished made = run({"generate", "--kind", "random", "--width", "10", "--height", "10",
                             "--obstacles", "0.15", "--seed", "7", "--agents", "12", "--map-output",
                             path("r.map"), "--scen-output", path("r.scen")});
  ASSERT_EQ(made.code, 0) << made.err;
  for (const char* system : kSystems) {
    json results[2];
    for (json& result : results) {
      const Finished finished =
          run({"solve", "--map", path("r.map"), "--scen", path("r.scen"), "--agents", "12",
               "--system", system, "--seed", "5", "--quiet", "--json", "-"});
      ASSERT_EQ(finished.code, 0) << finished.err;
      result = json::parse(finished.out);
      for (const char* measured : {"cpu_s", "wall_s", "peak_rss_mib"})
        ASSERT_EQ(result["statistics"].erase(measured), 1u);
    }
    EXPECT_EQ(results[0], results[1]) << system;
  }
}

TEST_F(SolveTest, NoAgentsAtAll) {
  const Finished finished = run({"solve", "--map", path("small.map"), "--scen", path("small.scen"),
                                 "--agents", "0", "--json", "-"});
  ASSERT_EQ(finished.code, 0) << finished.err;
  const json result = json::parse(finished.out);
  EXPECT_EQ(result["cost"], 0);
  EXPECT_EQ(result["plan"], json::array());
}

TEST_F(SolveTest, AuditAndKnownPlanPassOnAGoodPlan) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  const Finished finished =
      run(small("solve", {"--audit", "--known-plan", path("p.json"), "--json", "-"}));
  EXPECT_EQ(finished.code, 0) << finished.err;
  const json options = json::parse(finished.out)["options"];
  EXPECT_EQ(options["audit"], true);
  EXPECT_EQ(options["known_plan"], path("p.json"));
}

TEST_F(SolveTest, LettersAreReadAsTold) {
  write("s.map", "type octile\nheight 1\nwidth 3\nmap\n.S.\n");
  write("s.scen", "version 1\n0\ts\t3\t1\t0\t0\t2\t0\t2\n");
  const auto solve = [&](const std::vector<std::string>& more) {
    return run(std::vector<std::string>{"solve", "--map", path("s.map"), "--scen", path("s.scen"),
                                        "--agents", "1"} +
               more);
  };
  EXPECT_EQ(solve({}).code, 65);
  const Finished open = solve({"--passable", "S"});
  EXPECT_EQ(open.code, 0);
  EXPECT_THAT(open.out, HasSubstr("1 cells 'S' read as passable"));
  EXPECT_EQ(solve({"--blocked", "S"}).code, 20);
  EXPECT_EQ(solve({"--blocked", "S", "--passable", "S"}).code, 65);
}

TEST_F(SolveTest, SettingsAreForWhoMeasures) {
  EXPECT_EQ(run(small("solve", {"--set", "core_passes=1", "--set", "core_turn=10"})).code, 0);
  for (const char* text : {"core_passes=0", "core_passes", "no_such_setting=1"}) {
    const Finished finished = run(small("solve", {"--set", text}));
    EXPECT_EQ(finished.code, 64) << text;
    EXPECT_THAT(finished.err, HasSubstr("--set")) << text;
  }
  EXPECT_THAT(run({"solve", "--help"}).out, Not(HasSubstr("--set")));
}

TEST_F(SolveTest, QuietIsQuiet) {
  const Finished finished = run(small("solve", {"--quiet"}));
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(finished.out + finished.err, "");
}

TEST_F(SolveTest, NothingButTheFileGoesToStdoutWithADash) {
  const Finished result = run(small("solve", {"--json", "-"}));
  EXPECT_TRUE(json::accept(result.out));
  EXPECT_THAT(result.err, HasSubstr("verified"));
  EXPECT_THAT(result.err, Not(HasSubstr("\r")));  // no progress line in a file
  const Finished plan = run(small("solve", {"--plan", "-", "--plan-format", "cbsh2"}));
  EXPECT_THAT(plan.out, testing::StartsWith("Agent 0: "));
  EXPECT_THAT(plan.out, Not(HasSubstr("verified")));
}

}  // namespace
}  // namespace quadrille::cli::test
