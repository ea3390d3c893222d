// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using RoundTripTest = CliTest;

constexpr const char* kFormats[] = {"json", "cbsh2", "lns2", "visualizer", "lacam", "yaml"};

TEST_F(RoundTripTest, VerifyAcceptsThePlanOfSolveInEveryFormat) {
  for (const std::string format : kFormats) {
    SCOPED_TRACE(format);
    ASSERT_EQ(
        run(small("solve", {"--quiet", "--plan", path(format), "--plan-format", format})).code, 0);
    for (const auto& more : {std::vector<std::string>{}, {"--plan-format", format}}) {
      const Finished finished = run(small("verify", std::vector<std::string>{path(format)} + more));
      EXPECT_EQ(finished.code, 0) << finished.err;
      EXPECT_THAT(finished.out, HasSubstr("makespan 3, sum of costs 8, no violations"));
    }
  }
}

TEST_F(RoundTripTest, TheNameOfThePlanFileChoosesItsFormat) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.yaml")})).code, 0);
  EXPECT_THAT(read("p.yaml"), HasSubstr("schedule:"));
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.txt")})).code, 0);
  EXPECT_TRUE(json::accept(read("p.txt")));
}

TEST_F(RoundTripTest, VerifyAcceptsAResultAndHoldsItToItsCost) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--json", path("r.json")})).code, 0);
  EXPECT_EQ(run(small("verify", {path("r.json")})).code, 0);
  json result = json::parse(read("r.json"));
  result["cost"] = 7;
  const Finished lie = run(small("verify", {write("lie.json", result.dump())}));
  EXPECT_EQ(lie.code, 1);
  EXPECT_THAT(lie.out, HasSubstr("states a sum of costs of 7, but it is 8"));
}

TEST_F(RoundTripTest, VerifyRefusesAResultThatContradictsItself) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--json", path("r.json")})).code, 0);
  const json result = json::parse(read("r.json"));
  const auto verdict = [&](const json& change) {
    json changed = result;
    changed.update(change);
    return run(small("verify", {write("changed.json", changed.dump())}));
  };
  EXPECT_EQ(verdict({{"status", "feasible"}, {"lower_bound", 7}, {"gap_percent", nullptr}}).code,
            0);
  EXPECT_EQ(verdict({{"lower_bound", nullptr}}).code, 0);
  EXPECT_EQ(verdict({{"status", "feasible"}, {"lower_bound", 7}, {"gap_percent", 100.0 / 7}}).code,
            0);
  const std::pair<json, std::string> cases[] = {
      {{{"lower_bound", 9}}, "states a lower bound of 9, but the plan costs 8"},
      {{{"lower_bound", 7}}, "the plan is optimal, but the lower bound is 7 and the cost 8"},
      {{{"gap_percent", 12.5}}, "states a gap of 12.5 per cent, but it is 0"},
      {{{"status", "feasible"}}, "no more than feasible, but the lower bound is 8 and the cost 8"},
      {{{"status", "infeasible"}}, "states that the instance is infeasible, but has a plan"},
      {{{"status", "unknown"}}, "states that the instance is unknown, but has a plan"},
      {{{"objective", "makespan"}, {"cost", 3}},
       "states a lower bound of 8, but the plan costs 3"}};
  for (const auto& [change, message] : cases) {
    SCOPED_TRACE(message);
    const Finished finished = verdict(change);
    EXPECT_EQ(finished.code, 1) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr(message));
  }
  EXPECT_EQ(verdict({{"status", "solved"}}).code, 65);
}

TEST_F(RoundTripTest, VerifyNamesEachViolationAndExitsWith1) {
  const Finished finished =
      run(small("verify", {write("p",
                                 "0:(0,0),(3,0),(3,2),\n1:(1,0),(3,1),(2,2),\n"
                                 "2:(2,0),(3,0),(1,2),\n3:(3,0),(3,0),(1,2),\n")}));
  EXPECT_EQ(finished.code, 1);
  EXPECT_EQ(finished.err, "");
  EXPECT_THAT(finished.out, HasSubstr("invalid    3 violations\n"));
  const Finished quiet = run(small("verify", {path("p"), "--quiet"}));
  EXPECT_EQ(quiet.code, 1);
  EXPECT_EQ(quiet.out, "");
}

TEST_F(RoundTripTest, ConvertChangesTheFormatAndNothingElse) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("first")})).code, 0);
  for (const std::string from : kFormats)
    for (const std::string to : kFormats) {
      SCOPED_TRACE(from + " to " + to);
      const std::vector<std::string> map = {"convert", "--map", path("small.map")};
      ASSERT_EQ(
          run(map + std::vector<std::string>{"--to", from, "--output", path("a"), path("first")})
              .code,
          0);
      ASSERT_EQ(run(map + std::vector<std::string>{"--from", from, "--to", to, "--output",
                                                   path("b"), path("a")})
                    .code,
                0);
      const Finished finished = run(small("verify", {path("b")}));
      EXPECT_EQ(finished.code, 0) << finished.out;
      EXPECT_THAT(finished.out, HasSubstr("sum of costs 8"));
    }
}

TEST_F(RoundTripTest, InstancesInOwnJsonAndYamlAreSolvedAlike) {
  for (const std::string format : {"json", "yaml"})
    for (const std::string& name : {"i." + format, "plain-" + format}) {
      SCOPED_TRACE(name);
      ASSERT_EQ(run(small("convert", {"--to", format, "--output", path(name)})).code, 0);
      const Finished finished = run({"solve", "--instance", path(name), "--json", "-"});
      ASSERT_EQ(finished.code, 0) << finished.err;
      EXPECT_EQ(json::parse(finished.out)["cost"], 8);
    }
}

TEST_F(RoundTripTest, EveryKindOfGeneratedMapIsReadAndSolved) {
  for (const std::string kind : {"empty", "random", "maze", "room", "warehouse"}) {
    SCOPED_TRACE(kind);
    const std::vector<std::string> generate = {"generate", "--kind",   kind, "--seed",
                                               "3",        "--agents", "4"};
    for (const std::string name : {"a", "b"})
      ASSERT_EQ(run(generate + std::vector<std::string>{"--map-output", path(name + ".map"),
                                                        "--scen-output", path(name + ".scen")})
                    .code,
                0);
    EXPECT_EQ(read("a.map"), read("b.map"));
    EXPECT_NE(read("a.scen"), "");
    const Finished finished = run({"solve", "--map", path("a.map"), "--scen", path("a.scen"),
                                   "--agents", "4", "--quiet", "--time-limit", "30"});
    EXPECT_EQ(finished.code, 0) << finished.err;
  }
}

TEST_F(RoundTripTest, GenerateWritesTheMapToStdoutByDefault) {
  const Finished finished = run({"generate", "--kind", "empty", "--width", "3", "--height", "2"});
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(finished.out, "type octile\nheight 2\nwidth 3\nmap\n...\n...\n");
}

TEST_F(RoundTripTest, TooManyAgentsForAMap) {
  EXPECT_EQ(
      run({"generate", "--map", path("small.map"), "--agents", "11", "--scen-output", "-"}).code,
      65);
}

}  // namespace
}  // namespace quadrille::cli::test
