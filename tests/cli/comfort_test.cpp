// SPDX-License-Identifier: MIT
// What makes the program easy to live with: files from everywhere, errors that say what to do,
// verdicts for scripts, runs that go on where another one was ended.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ComfortTest : public RoadmapCliTest {
 protected:
  /// The program with a file as its standard input.
  Finished run_with_input(const std::string& file, const std::string& arguments) const {
    const std::string command = std::string(QUADRILLE_PROGRAM) + " " + arguments + " < " + file +
                                " > " + path("stdin.out") + " 2> " + path("stdin.err");
    const int status = std::system(command.c_str());
    Finished finished;
    finished.code = WEXITSTATUS(status);
    finished.out = read("stdin.out");
    finished.err = read("stdin.err");
    return finished;
  }
  /// A path that does as it likes: agent 0 jumps, and stands on agent 1's goal.
  std::string bad_plan() const {
    return write("bad.json", R"({"quadrille": "plan", "version": 1, "plan": [[[0, 0], [2, 0]],
        [[3, 0], [2, 0]], [[0, 2], [0, 1]]]})");
  }
};

TEST_F(ComfortTest, ADashIsStandardInput) {
  const Finished discs = run_with_input(path("discs.json"), "solve --instance - --quiet --json -");
  EXPECT_EQ(discs.code, 0) << discs.err;
  EXPECT_EQ(json::parse(discs.out)["status"], "optimal");
  const std::vector<std::string> grid = small("solve", {"--plan", path("p.json")});
  ASSERT_EQ(run(grid).code, 0);
  const Finished verdict = run_with_input(
      path("p.json"), "verify --map " + grid[2] + " --scen " + grid[4] + " --agents 3 -");
  EXPECT_EQ(verdict.code, 0) << verdict.err;
  EXPECT_THAT(verdict.out, HasSubstr("no violations"));
  const Finished map = run_with_input(grid[2], "info --map -");
  EXPECT_EQ(map.code, 0) << map.err;
}

TEST_F(ComfortTest, AgentsTakesTheFirstAgentsOfAnInstance) {
  const std::vector<std::string> discs = {"solve",  "--instance", path("discs.json"),
                                          "--json", "-",          "--agents"};
  EXPECT_EQ(json::parse(run(discs + std::vector<std::string>{"1"}).out)["agents"], 1);
  const Finished many = run(discs + std::vector<std::string>{"99"});
  EXPECT_EQ(many.code, 65);
  EXPECT_THAT(many.err, HasSubstr("discs.json: there are only "));
  const std::string grid = path("grid.json");
  ASSERT_EQ(run(small("convert", {"--to", "json", "--output", grid})).code, 0);
  const std::vector<std::string> first = {"solve", "--instance", grid, "--json", "-", "--agents"};
  EXPECT_EQ(json::parse(run(first + std::vector<std::string>{"2"}).out)["agents"], 2);
  EXPECT_EQ(run(first + std::vector<std::string>{"4"}).code, 65);
}

TEST_F(ComfortTest, AFileOfAnotherKindIsToldWhereItBelongs) {
  const std::vector<std::string> grid = small("solve");
  const auto error = [&](const std::string& file) {
    const Finished finished = run({"solve", "--instance", file});
    EXPECT_EQ(finished.code, 65);
    return finished.err;
  };
  EXPECT_THAT(error(grid[2]), HasSubstr(":1: this is a map of MovingAI's: it belongs to --map"));
  EXPECT_THAT(error(grid[4]), HasSubstr("it belongs to --scen"));
  EXPECT_THAT(error(path("map.xml")), HasSubstr("it belongs to --roadmap"));
  write("swamp.map", "type octile\nheight 1\nwidth 3\nmap\n.S.\n");
  EXPECT_THAT(run({"info", "--map", path("swamp.map")}).err, HasSubstr("--passable and --blocked"));
  EXPECT_THAT(run({"info", "--roadmap", path("swamp.map")}).err, HasSubstr("--passable and"));
}

TEST_F(ComfortTest, AScenarioOfAnotherMapIsNoted) {
  const std::vector<std::string> grid = small("solve");
  EXPECT_THAT(run(grid).out, Not(HasSubstr("note ")));
  std::ifstream in(grid[2]);
  write("other.map", {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
  const Finished other =
      run({"solve", "--map", path("other.map"), "--scen", grid[4], "--agents", "3"});
  EXPECT_EQ(other.code, 0);
  EXPECT_THAT(other.out, HasSubstr("note       the scenario names another map, "));
}

TEST_F(ComfortTest, VerdictsAsJsonHaveAllViolations) {
  const auto arguments = small("verify", {"--json", "-", bad_plan()});
  const Finished bad = run(arguments);
  EXPECT_EQ(bad.code, 1);
  const json verdict = json::parse(bad.out);
  EXPECT_EQ(verdict["quadrille"], "verdict");
  EXPECT_EQ(verdict["valid"], false);
  EXPECT_TRUE(verdict["makespan"].is_null());
  ASSERT_GE(verdict["violations"].size(), 2u);
  bool jumps = false;
  for (const json& violation : verdict["violations"]) {
    EXPECT_THAT(bad.err, HasSubstr(violation["message"].get<std::string>()));
    if (violation["kind"] != "not-adjacent") continue;
    jumps = true;
    EXPECT_EQ(violation["agents"], json::array({0}));
    EXPECT_EQ(violation["at"], json::array({0, 0}));
    EXPECT_EQ(violation["timestep"], 0);
  }
  EXPECT_TRUE(jumps);

  ASSERT_EQ(run(small("solve", {"--plan", path("p.json")})).code, 0);
  const Finished good = run(small("verify", {"--quiet", "--json", path("v.json"), path("p.json")}));
  EXPECT_EQ(good.code, 0);
  EXPECT_EQ(good.out + good.err, "");
  const json praise = json::parse(read("v.json"));
  EXPECT_EQ(praise["valid"], true);
  EXPECT_EQ(praise["sum_of_costs"], 8);
  EXPECT_EQ(praise["violations"], json::array());
  EXPECT_EQ(run(small("verify", {"--json", path("p.json"), path("p.json")})).code, 64);
}

TEST_F(ComfortTest, VerdictsAboutRoadmapsHaveTimesAndClearance) {
  const std::vector<std::string> discs = {"--instance", path("discs.json")};
  ASSERT_EQ(run(std::vector<std::string>{"solve", "--plan", path("p.json")} + discs).code, 0);
  const std::vector<std::string> verify = {"verify", "--json", "-", path("p.json")};
  const Finished good = run(verify + discs);
  EXPECT_EQ(good.code, 0);
  const json praise = json::parse(good.out);
  EXPECT_TRUE(praise["least_clearance"].is_number());
  EXPECT_GT(praise["makespan"], 0);

  // The first agent arrives one unit of time late.
  json plan = json::parse(read("p.json"));
  json& last = plan["plan"][0].back();
  last["arrive"] = last["arrive"].get<double>() + 1;
  last["arrive_ticks"] =
      std::llround(last["arrive"].get<double>() / plan["resolution"].get<double>());
  for (const char* key : {"cost", "objective"}) plan.erase(key);
  write("p.json", plan.dump());
  const Finished bad = run(verify + discs);
  EXPECT_EQ(bad.code, 1) << bad.err;
  const json verdict = json::parse(bad.out);
  ASSERT_FALSE(verdict["violations"].empty());
  EXPECT_EQ(verdict["violations"][0]["kind"], "duration");
  EXPECT_TRUE(verdict["violations"][0]["tick"].is_number_integer());
}

TEST_F(ComfortTest, ARunGoesOnWithThePlanOfAnother) {
  const auto hard_plan = path("hard.json");
  const auto first =
      run(hard("solve", {"--conflict-limit", "50", "--plan", hard_plan, "--json", "-"}));
  ASSERT_EQ(first.code, 10) << first.err;
  const auto cost = json::parse(first.out)["cost"].get<int>();
  // No time for anything but the plan that is given, which may be written again.
  const auto second = run(hard("solve", {"--time-limit", "0", "--initial-plan", hard_plan, "--plan",
                                         hard_plan, "--json", "-"}));
  EXPECT_EQ(second.code, 10) << second.err;
  EXPECT_EQ(json::parse(second.out)["cost"], cost);
  EXPECT_EQ(json::parse(second.out)["options"]["initial_plan"], hard_plan);
  EXPECT_EQ(run(hard("verify", {"--quiet", hard_plan})).code, 0);

  const auto refused = run(small("solve", {"--initial-plan", bad_plan()}));
  EXPECT_EQ(refused.code, 65);
  EXPECT_THAT(refused.err, HasSubstr("bad.json: not a valid plan: agent 0"));
}

TEST_F(ComfortTest, ABoundThatIsKnownIsWhereASearchBegins) {
  const std::vector<std::string> discs = {"solve", "--instance", path("discs.json")};
  for (const std::vector<std::string>& solve : {small("solve"), discs}) {
    const auto first = json::parse(run(solve + std::vector<std::string>{"--json", "-"}).out);
    EXPECT_FALSE(first.contains("rests_on_known_bound"));
    const std::string cost = first["cost"].dump();
    const auto with = [&](const std::string& bound) {
      return run(solve + std::vector<std::string>{"--known-bound", bound, "--json", "-"});
    };
    const auto stopped = run(solve + std::vector<std::string>{"--known-bound", cost, "--time-limit",
                                                              "0", "--json", "-"});
    EXPECT_EQ(json::parse(stopped.out)["lower_bound"], first["cost"]);
    if (solve == discs) {  // where nothing is known in no time
      EXPECT_EQ(json::parse(stopped.out)["rests_on_known_bound"], true);
      EXPECT_THAT(stopped.err, HasSubstr("bound      as it was given, not proved here\n"));
    }
    EXPECT_EQ(json::parse(stopped.out)["options"]["known_bound"], first["cost"]);
    EXPECT_EQ(json::parse(with("1").out)["cost"], first["cost"]);
    EXPECT_EQ(json::parse(with("1").out)["rests_on_known_bound"], false);
    const auto refused = run(solve + std::vector<std::string>{"--known-bound", "1000"});
    EXPECT_EQ(refused.code, 65);
    EXPECT_THAT(refused.err, HasSubstr("the known lower bound is wrong"));
  }
  EXPECT_THAT(run(small("solve", {"--known-bound", "1.5"})).err,
              HasSubstr("--known-bound is a whole number of timesteps"));
}

TEST_F(ComfortTest, ATerminalShowsColoursUnlessTheyAreNotWanted) {
  const auto on_terminal = [&](const std::string& environment) {
    std::string command = environment + " " QUADRILLE_PROGRAM;
    for (const std::string& word : small("solve")) command += " " + word;
    const std::string script =
        "script -qec '" + command + "' /dev/null > " + path("terminal.out") + " < /dev/null";
    EXPECT_EQ(std::system(script.c_str()), 0) << script;
    return read("terminal.out");
  };
  const std::string green = "result     \033[32moptimal\033[0m";
  EXPECT_THAT(on_terminal("TERM=xterm"), HasSubstr(green));
  EXPECT_THAT(on_terminal("TERM=xterm"), HasSubstr("\033[32mverified\033[0m   3 agents"));
  for (const char* environment : {"TERM=dumb", "TERM=xterm NO_COLOR=1"}) {
    EXPECT_THAT(on_terminal(environment), HasSubstr("result     optimal")) << environment;
    EXPECT_THAT(on_terminal(environment), Not(HasSubstr("\033"))) << environment;
  }
  EXPECT_THAT(run(small("solve")).out, Not(HasSubstr("\033")));
}

TEST_F(ComfortTest, RoadmapsToo) {
  const std::vector<std::string> discs = {"--instance", path("discs.json")};
  const auto plan = path("p.json");
  const auto first = run(std::vector<std::string>{"solve", "--plan", plan, "--json", "-"} + discs);
  ASSERT_EQ(first.code, 0);
  const auto second = run(std::vector<std::string>{"solve", "--time-limit", "0", "--initial-plan",
                                                   plan, "--json", "-"} +
                          discs);
  EXPECT_EQ(second.code, 10) << second.err;
  EXPECT_EQ(json::parse(second.out)["cost"], json::parse(first.out)["cost"]);
}

}  // namespace
}  // namespace quadrille::cli::test
