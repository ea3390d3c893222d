// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "cli/process.hpp"
#include "cli/roadmap_support.hpp"
#include "support/sanitizer.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using ExplainTest = RoadmapCliTest;

std::vector<std::string> roundabout(const std::string& command,
                                    const std::vector<std::string>& more = {}) {
  const std::string maps = QUADRILLE_SOURCE_DIR "/examples/maps/roundabout";
  return std::vector<std::string>{command,    "--map", maps + ".map", "--scen", maps + ".scen",
                                  "--agents", "4"} +
         more;
}

/// The sum of the raises, after a look at the parts.
std::int64_t sum_of_raises(const json& attribution) {
  std::int64_t sum = 0;
  for (const json& raise : attribution["raises"]) {
    sum += raise["amount"].get<std::int64_t>();
    EXPECT_FALSE(raise["agents"].empty());
  }
  return sum;
}

TEST_F(ExplainTest, SolveSaysWhatTheBoundIsMadeOf) {
  const Finished finished = run(roundabout("solve", {"--explain", "--json", path("result.json")}));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out, AllOf(HasSubstr("bound      30 = 26 that the agents cost alone + 4\n"),
                                  HasSubstr("because  1 +")));
  const json result = json::parse(read("result.json"));
  const json& attribution = result["attribution"];
  EXPECT_EQ(attribution["lower_bound"], 30);
  EXPECT_EQ(attribution["free_bound"].get<std::int64_t>() + sum_of_raises(attribution), 30);
  EXPECT_EQ(attribution["agents"].size(), 4U);
  EXPECT_FALSE(attribution["sites"].empty());
  EXPECT_EQ(attribution["sites"][0]["place"]["from"].size(), 2U);  // a cell
  EXPECT_FALSE(result["reasons"].empty());
  EXPECT_EQ(result["options"]["explain"], true);
  const json plain = json::parse(run(roundabout("solve", {"--json", "-", "--quiet"})).out);
  EXPECT_FALSE(plain.contains("attribution"));
  EXPECT_EQ(plain["plan"], result["plan"]);
}

TEST_F(ExplainTest, ReasonsAddUpAndAreCheckedAgain) {
  const Finished finished = run(roundabout("explain", {"--json", path("result.json")}));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("because  1 +"), HasSubstr("as a search of these alone"),
                    HasSubstr("# blocked, . free"), Not(HasSubstr("moves"))));
  const json result = json::parse(read("result.json"));
  std::int64_t sum = 0;
  for (const json& reason : result["reasons"]) sum += reason["amount"].get<std::int64_t>();
  EXPECT_EQ(sum, 4);
}

TEST_F(ExplainTest, TheMakespanHasOneReason) {
  const Finished finished =
      run(roundabout("explain", {"--objective", "makespan", "--json", path("result.json")}));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("cannot all arrive before"));
  EXPECT_EQ(json::parse(read("result.json"))["reasons"].size(), 1U);
}

TEST_F(ExplainTest, InfeasibleNamesAgentsAndTheCorridor) {
  write("corridor.map", "type octile\nheight 1\nwidth 4\nmap\n....\n");
  write("corridor.scen",
        "version 1\n0\tcorridor.map\t4\t1\t0\t0\t3\t0\t3\n0\tcorridor.map\t4\t1\t3\t0\t0\t0\t3\n");
  const Finished finished = run(
      {"explain", "--map", path("corridor.map"), "--scen", path("corridor.scen"), "--agents", "2"});
  EXPECT_EQ(finished.code, 20) << finished.err;
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("agents 0 and 1 cannot pass each other"), HasSubstr("\na**b\n"),
                    HasSubstr("a to A agent 0, b to B agent 1")));
}

TEST_F(ExplainTest, RoadmapsNameVerticesAndTimes) {
  const Finished finished = run(discs("explain", {"--json", path("result.json")}));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out, AllOf(HasSubstr("because  1 +"), HasSubstr("vertex ")));
  const json attribution = json::parse(read("result.json"))["attribution"];
  EXPECT_EQ(attribution["free_bound"].get<std::int64_t>() + sum_of_raises(attribution),
            attribution["lower_bound"].get<std::int64_t>());
}

TEST_F(ExplainTest, ReasonsAreCheckedAmongTheObstacles) {
  // Alone each has to wait until the obstacle at the crossing has left; then one of them waits
  // more.
  write("crossing.json", R"({"quadrille": "instance", "version": 1, "resolution": 0.001,
    "roadmap": {"vertices": [[0, 0], [1, 0], [2, 0], [1, 1], [1, -1]],
                "edges": [[0, 1], [1, 2], [3, 1], [1, 4]]},
    "agents": [{"start": 0, "goal": 2, "radius": 0.1}, {"start": 3, "goal": 4, "radius": 0.1}],
    "obstacles": [{"radius": 0.1, "at_end": "leave",
                   "path": [{"vertex": 1, "arrive": 0, "depart": 5}]}]})");
  const Finished finished =
      run({"explain", "--instance", path("crossing.json"), "--json", path("result.json")});
  ASSERT_EQ(finished.code, 0) << finished.err;
  const json reasons = json::parse(read("result.json"))["reasons"];
  ASSERT_EQ(reasons.size(), 1U) << finished.out;
  EXPECT_EQ(reasons[0]["checked"], true) << finished.out;
}

TEST_F(ExplainTest, NothingIsSearchedWhenTimeIsUp) {
  // Far too hard: the limit ends the search, and there is no time left to look at reasons.
  const std::string map = path("m.map"), scen = path("m.scen");
  ASSERT_EQ(run({"generate", "--kind", "empty", "--width", "24", "--height", "24", "--agents",
                 "250", "--map-output", map, "--scen-output", scen})
                .code,
            0);
  // Long enough for a few bounds, after the first plan.
  const std::string seconds = support::kAddressSanitizer ? "20" : "3";
  const Finished finished = run({"explain", "--map", map, "--scen", scen, "--agents", "250",
                                 "--cpu-limit", seconds, "--json", path("result.json")});
  const json result = json::parse(read("result.json"));
  ASSERT_EQ(result["stop_reason"], "cpu-time") << finished.out;
  ASSERT_FALSE(result["reasons"].empty());
  for (const json& reason : result["reasons"]) EXPECT_EQ(reason["checked"], false);
}

TEST_F(ExplainTest, InfeasibleRoadmapsNameWhatBothHaveToPass) {
  const std::string discs_json = read("discs.json");
  write("narrow.json", std::string(discs_json).replace(discs_json.find("0.8]"), 4, "0.54]"));
  const Finished finished = run({"explain", "--instance", path("narrow.json")});
  EXPECT_EQ(finished.code, 20) << finished.err;
  EXPECT_THAT(finished.out, AllOf(HasSubstr("agents 0 and 1 cannot both reach their goals: both "
                                            "have to pass vertices"),
                                  HasSubstr("in opposite directions")));
}

TEST_F(ExplainTest, ThePageSaysItAndADamagedResultIsRefused) {
  ASSERT_EQ(run(roundabout("explain", {"--json", path("r.json"), "--view", path("a.html")})).code,
            0);
  EXPECT_THAT(read("a.html"), HasSubstr("\"attribution\":{\"freeBound\":26"));
  ASSERT_EQ(run(roundabout("view", {"--output", path("b.html"), path("r.json")})).code, 0);
  EXPECT_THAT(read("b.html"), HasSubstr("\"attribution\":{\"freeBound\":26"));

  const std::string good = read("r.json");
  const auto refused = [&](const std::string& from, const std::string& to) {
    const auto at = good.find(from, good.find("\"attribution\""));
    EXPECT_NE(at, std::string::npos) << from;
    write("bad.json", std::string(good).replace(at, from.size(), to));
    const Finished bad = run(roundabout("view", {"--output", path("c.html"), path("bad.json")}));
    EXPECT_EQ(bad.code, 65);
    return bad.err;
  };
  EXPECT_THAT(refused("\"free_bound\":26", "\"free_bound\":25"),
              HasSubstr("/attribution/raises: the lower bound is 1 more"));
  EXPECT_THAT(refused("\"kind\":\"core\"", "\"kind\":\"corn\""),
              HasSubstr("there is no kind 'corn'"));
  EXPECT_THAT(refused("\"agents\":[2,3]", "\"agents\":[2,4]"), HasSubstr("/attribution/raises/0"));
  EXPECT_THAT(refused("\"from\":[4,2]", "\"from\":[1,1]"), HasSubstr("no such cell"));
}

TEST_F(ExplainTest, WhatCannotBeExplainedIsRefused) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--threads", "2"}, {"--system", "mdd-sat"}}) {
    const Finished finished =
        run(roundabout("solve", std::vector<std::string>{"--explain"} + more));
    EXPECT_EQ(finished.code, 64);
    EXPECT_THAT(finished.err, HasSubstr("--explain needs"));
  }
  EXPECT_EQ(run(discs("solve", {"--explain", "--threads", "2"})).code, 64);
}

}  // namespace
}  // namespace quadrille::cli::test
