// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

using ReportTest = CliTest;

TEST_F(ReportTest, HumanOutputOfASmallSolve) {
  const Finished finished = run(small("solve"));
  ASSERT_EQ(finished.code, 0);
  EXPECT_EQ(finished.err, "");
  for (const char* part :
       {"small.map: 4 x 3 grid, 10 vertices, 10 edges\n", "agents     3 from ", "(of 4 rows)\n",
        "system     dpll", "objective sum-of-costs, seed 0\n", "result     optimal\n",
        "cost       8 (sum-of-costs), lower bound 8\n", " SAT calls, ",
        "verified   3 agents, makespan 3, sum of costs 8, no violations\n",
        // The ring turns: there is only one plan of this cost.
        "t=0   t=1   t=2   t=3\n"
        "a..b  .a..  ..a.  ...A\n"
        ".##.  .##b  .##.  .##.\n"
        "...c  ..c.  .c.B  C..B\n",
        "  a 0  (0, 0)    (3, 0)       3  RRR\n", "  b 1  (3, 0)    (3, 2)       2  DD\n",
        "  c 2  (3, 2)    (0, 2)       3  LLL\n"})
    EXPECT_THAT(finished.out, HasSubstr(part));
}

TEST_F(ReportTest, ThePlanIsNotDrawnWhenAFileTakesIt) {
  EXPECT_THAT(run(small("solve", {"--plan", path("p.json")})).out, Not(HasSubstr("t=0")));
}

TEST_F(ReportTest, JsonHasAllThatIsDocumented) {
  const Finished finished =
      run(small("solve", {"--seed", "9", "--time-limit", "30", "--memory-limit", "4000", "--json",
                          path("r.json")}));
  ASSERT_EQ(finished.code, 0);
  const json result = json::parse(read("r.json"));
  for (const char* key : {"quadrille", "status", "objective", "cost", "lower_bound", "gap_percent",
                          "stop_reason", "explanation", "internal_error", "agents", "statistics",
                          "version", "seed", "options", "plan"})
    EXPECT_TRUE(result.contains(key)) << key;
  EXPECT_EQ(result.size(), 15u);
  for (const char* key :
       {"cpu_s", "wall_s", "peak_rss_mib", "sat_calls", "conflicts", "decisions", "variables",
        "clauses", "collision_clauses", "checks", "models_checked", "cores"})
    EXPECT_TRUE(result["statistics"][key].is_number()) << key;
  EXPECT_EQ(result["statistics"]["first_plan"], "lacam");
  EXPECT_EQ(result["statistics"].size(), 13u);
  EXPECT_EQ(result["version"], QUADRILLE_VERSION);
  EXPECT_EQ(result["seed"], 9);
  EXPECT_EQ(result["agents"], 3);
  EXPECT_TRUE(result["internal_error"].is_null());
  EXPECT_EQ(result["options"]["time_limit"], 30);
  EXPECT_EQ(result["options"]["memory_limit"], 4000);
  EXPECT_TRUE(result["options"]["cpu_limit"].is_null());
  EXPECT_EQ(result["options"]["map"], path("small.map"));
  EXPECT_EQ(result["plan"], json::parse("[[[0,0],[1,0],[2,0],[3,0]],[[3,0],[3,1],[3,2]],"
                                        "[[3,2],[2,2],[1,2],[0,2]]]"));
}

TEST_F(ReportTest, GraphsHaveVertexNumbers) {
  const std::string graph =
      write("g.json",
            "{\"quadrille\": \"instance\", \"version\": 1, \"graph\": {\"vertices\": 3, \"edges\": "
            "[[0, 1], [1, 2]]}, \"agents\": [{\"start\": 0, \"goal\": 2}]}");
  const Finished finished = run({"solve", "--instance", graph, "--json", "-"});
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out)["plan"], json::parse("[[0,1,2]]"));
  EXPECT_THAT(finished.err, HasSubstr("graph, 3 vertices, 2 edges"));
  EXPECT_THAT(finished.err, HasSubstr("  0 1 2\n"));
}

TEST_F(ReportTest, FileNamesNeedNotBeUtf8) {
  const std::string strange = path("\xff\"\\\n.map");
  std::filesystem::copy_file(path("small.map"), strange);
  const Finished finished = run(
      {"solve", "--map", strange, "--scen", path("small.scen"), "--agents", "3", "--json", "-"});
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_TRUE(json::accept(finished.out)) << finished.out;
}

TEST_F(ReportTest, InfoOfMapsAndInstances) {
  const Finished map = run({"info", "--map", path("small.map")});
  EXPECT_EQ(map.code, 0);
  EXPECT_THAT(map.out, HasSubstr("components 1, of 10 vertices\n"));
  EXPECT_THAT(map.out, HasSubstr("degrees    2: 10\n"));
  EXPECT_THAT(map.out, Not(HasSubstr("feasible")));
  const Finished instance = run(small("info"));
  EXPECT_THAT(instance.out, HasSubstr("distances  sum 8, largest 3 "));
  EXPECT_THAT(instance.out, HasSubstr("feasible   yes"));
  const Finished all = run({"info", "--map", path("small.map"), "--scen", path("small.scen")});
  EXPECT_THAT(all.out, HasSubstr("agents     4 from "));
  const Finished infeasible = run(corridor("info"));
  EXPECT_EQ(infeasible.code, 0);
  EXPECT_THAT(infeasible.out, HasSubstr("feasible   no: "));
  write("apart.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
  const Finished apart =
      run({"info", "--map", path("apart.map"), "--scen", path("corridor.scen"), "--agents", "2"});
  EXPECT_THAT(apart.out, HasSubstr("components 2, of 1, 1 vertices\n"));
  EXPECT_THAT(apart.out, HasSubstr("2 agents cannot reach their goal\n"));
}

}  // namespace
}  // namespace quadrille::cli::test
