// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ExecutionCliTest : public RoadmapCliTest {
 protected:
  /// Four agents that turn in a square.
  [[nodiscard]] std::vector<std::string> square(const std::string& command,
                                                const std::vector<std::string>& more = {}) const {
    write("square.json",
          "{\"quadrille\": \"instance\", \"version\": 1, \"grid\": {\"width\": 2, \"height\": 2, "
          "\"rows\": [\"..\", \"..\"]}, \"agents\": [\n"
          "{\"start\": [0, 0], \"goal\": [1, 0]}, {\"start\": [1, 0], \"goal\": [1, 1]},\n"
          "{\"start\": [1, 1], \"goal\": [0, 1]}, {\"start\": [0, 1], \"goal\": [0, 0]}]}\n");
    return std::vector<std::string>{command, "--instance", path("square.json")} + more;
  }
  void solve_to_plan(const std::vector<std::string>& solve) const {
    ASSERT_EQ(run(solve + std::vector<std::string>{"--plan", path("plan.json")}).code, 0);
  }
};

TEST_F(ExecutionCliTest, ExecuteCheckListsPrecedencesOfARoadmap) {
  solve_to_plan(discs("solve"));
  const Finished finished =
      run(discs("execute-check", {"--json", path("order.json"), path("plan.json")}));
  EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("nodes      no cycle"));
  const json order = json::parse(read("order.json"));
  EXPECT_EQ(order["quadrille"], "precedences");
  EXPECT_EQ(order["unit"], "tick");
  EXPECT_EQ(order["acyclic"], true);
  ASSERT_FALSE(order["precedences"].empty());
  for (const json& precedence : order["precedences"]) {
    EXPECT_GE(precedence["slack"].get<std::int64_t>(), 0);
    for (const char* who : {"leader", "follower"}) {
      const json& move = precedence[who];
      ASSERT_LT(move["move"].get<std::size_t>(),
                order["moves"][move["agent"].get<std::size_t>()].size());
    }
  }
}

TEST_F(ExecutionCliTest, ExecuteCheckNamesACycle) {
  solve_to_plan(square("solve"));
  const Finished finished =
      run(square("execute-check", {"--json", path("order.json"), path("plan.json")}));
  EXPECT_EQ(finished.code, 1) << finished.out << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("4 moves in a cycle"));
  EXPECT_THAT(finished.out, HasSubstr("agent 0 from (0, 0) to (1, 0), 0 to 1\n"));
  const json order = json::parse(read("order.json"));
  EXPECT_EQ(order["acyclic"], false);
  EXPECT_EQ(order["cycle"].size(), 4u);
}

TEST_F(ExecutionCliTest, AnInvalidPlanIsRefused) {
  write("bad.json",
        "{\"quadrille\": \"plan\", \"version\": 1, \"plan\": [[[0, 0]], [[1, 0], [1, 1]], "
        "[[1, 1], [0, 1]], [[0, 1], [0, 0]]]}\n");
  for (const char* command : {"execute-check", "simulate"}) {
    const Finished finished = run(square(command, {path("bad.json")}));
    EXPECT_EQ(finished.code, 65);
    EXPECT_THAT(finished.err, HasSubstr("bad.json: agent 0"));
  }
}

TEST_F(ExecutionCliTest, SimulateReportsEachRule) {
  solve_to_plan(square("solve"));
  const Finished finished = run(square("simulate", {"--json", path("report.json"), "--delays",
                                                    "0.5", "--runs", "10", path("plan.json")}));
  EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
  const json report = json::parse(read("report.json"));
  ASSERT_EQ(report["rules"].size(), 3u);
  const json &naive = report["rules"][0], &gated = report["rules"][1],
             &coupled = report["rules"][2];
  EXPECT_EQ(naive["rule"], "naive");
  EXPECT_GT(naive["colliding_runs"], 0);
  EXPECT_EQ(gated["endless_runs"], 10);
  EXPECT_EQ(coupled["colliding_runs"], 0);
  EXPECT_EQ(coupled["endless_runs"], 0);
  EXPECT_EQ(coupled["least_clearance"], nullptr);
  EXPECT_EQ(
      run(square("simulate", {"--json", "-", "--delays", "0.5", "--runs", "10", path("plan.json")}))
          .out,
      read("report.json"));
}

TEST_F(ExecutionCliTest, SimulateMeasuresClearanceOnARoadmap) {
  solve_to_plan(discs("solve"));
  const Finished finished = run(
      discs("simulate", {"--json", "-", "--rule", "coupled", "--delays", "1", path("plan.json")}));
  EXPECT_EQ(finished.code, 0) << finished.err;
  const json report = json::parse(finished.out);
  ASSERT_EQ(report["rules"].size(), 1u);
  EXPECT_EQ(report["rules"][0]["colliding_runs"], 0);
  EXPECT_GE(report["rules"][0]["least_clearance"].get<double>(), -1e-6);
  EXPECT_GT(report["rules"][0]["mean_makespan"].get<double>(),
            report["plan_makespan"].get<double>());
}

TEST_F(ExecutionCliTest, DispatchLetsAFleetWork) {
  const std::vector<std::string> generated = {
      "generate", "--kind", "roadmap",           "--vertices",      "40", "--agents", "5",
      "--seed",   "3",      "--instance-output", path("roads.json")};
  ASSERT_EQ(run(generated).code, 0) << run(generated).err;
  const std::vector<std::string> asked = {
      "dispatch",  "--instance", path("roads.json"), "--steps", "150",      "--delays", "0.01",
      "--longest", "5",          "--json",           "-",       "--effort", "3"};
  const Finished finished = run(asked);
  EXPECT_EQ(finished.code, 0) << finished.err;
  json report = json::parse(finished.out);
  EXPECT_EQ(report["quadrille"], "dispatch");
  EXPECT_EQ(report["robots"], 5);
  EXPECT_EQ(report["calls"], 150);
  EXPECT_EQ(report["contacts"], 0);
  EXPECT_GT(report["tasks_done"], 5);
  EXPECT_GE(report["gap_percent_mean"].get<double>(), 0);
  // The same again, but for the time that calls take.
  json again = json::parse(run(asked).out);
  ASSERT_EQ(report["each_call"]["gap_percent"].size(), 150u);
  for (json* const one : {&report, &again}) {
    for (const char* key : {"call_s_mean", "call_s_95", "call_s_longest"}) one->erase(key);
    (*one)["each_call"].erase("seconds");
  }
  EXPECT_EQ(report, again);
}

TEST_F(ExecutionCliTest, DispatchEndsWhenAllThereIsToDoIsDone) {
  const Finished finished = run(discs("dispatch", {"--own-tasks", "--json", "-"}));
  EXPECT_EQ(finished.code, 0) << finished.err;
  const json report = json::parse(finished.out);
  EXPECT_EQ(report["tasks_done"], report["robots"]);
  EXPECT_LT(report["calls"], 1000);
  EXPECT_THAT(run(discs("dispatch", {"--step", "1e30"})).err, HasSubstr("--step is too long"));
}

TEST_F(ExecutionCliTest, WrongOptionsAreRefused) {
  solve_to_plan(square("solve"));
  const auto refuses = [&](const std::vector<std::string>& more, const std::string& why) {
    const Finished finished =
        run(square("simulate", more + std::vector<std::string>{path("plan.json")}));
    EXPECT_EQ(finished.code, 64) << finished.out;
    EXPECT_THAT(finished.err, HasSubstr(why));
  };
  refuses({"--slow", "0.99"}, "--slow is at most 0.95");
  refuses({"--delays", "2"}, "a number from 0 to 1");
  refuses({"--rule", "quick"}, "naive, gated or coupled");
  refuses({"--period", "2"}, "--period is for roadmaps");
  refuses({"--longest", "1e30"}, "--longest is too long");
}

}  // namespace
}  // namespace quadrille::cli::test
