// SPDX-License-Identifier: MIT
//
// Robots that turn: --headings and --turn.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class TurningTest : public RoadmapCliTest {
 protected:
  /// The robots of `small`, which turn.
  [[nodiscard]] std::vector<std::string> turning(const std::string& command,
                                                 const std::vector<std::string>& more = {}) const {
    return small(command, std::vector<std::string>{"--headings", "4"} + more);
  }
};

// Two rows: from the upper left cell to the one below it, and to the left on the other side.
TEST_F(TurningTest, TurnsCostTimesteps) {
  write("two.map", "type octile\nheight 2\nwidth 3\nmap\n...\n...\n");
  write("two.scen",
        "version 1\n0\ttwo.map\t3\t2\t0\t0\t0\t1\t1\n0\ttwo.map\t3\t2\t2\t0\t1\t0\t1\n");
  const std::vector<std::string> two{
      "--map", path("two.map"), "--scen", path("two.scen"), "--agents", "2", "--headings", "4"};
  const auto cost = [&](const std::vector<std::string>& more) {
    const Finished solved = run(std::vector<std::string>{"solve"} + two + more +
                                std::vector<std::string>{"--quiet", "--json", "-"});
    EXPECT_EQ(solved.code, 0) << solved.err;
    return json::parse(solved.out).at("cost");
  };
  // A quarter turn and a step, half a turn and a step.
  EXPECT_EQ(cost({}), 2 + 3);
  EXPECT_EQ(cost({"--turn", "5"}), 6 + 11);
  EXPECT_EQ(cost({"--objective", "makespan", "--turn", "2"}), 5);
}

TEST_F(TurningTest, AllThatReadsPlansKnowsThem) {
  const Finished solved = run(turning("solve", {"--plan", path("p.json"), "--view", path("v.html"),
                                                "--svg", path("s.svg"), "--json", path("r.json")}));
  ASSERT_EQ(solved.code, 0) << solved.err;
  EXPECT_THAT(solved.out,
              HasSubstr("4 x 3 grid, 4 headings, turns of 1 timestep, 40 vertices, 100 edges"));
  const json options = json::parse(read("r.json")).at("options");
  EXPECT_EQ(options.at("headings"), 4);
  EXPECT_EQ(options.at("turn"), 1);
  EXPECT_EQ(options.at("map"), path("small.map"));
  EXPECT_EQ(options.at("scen"), path("small.scen"));
  for (const char* plan : {"p.json", "r.json"}) {
    const Finished verified = run(turning("verify", {path(plan)}));
    EXPECT_EQ(verified.code, 0) << verified.err;
    EXPECT_THAT(verified.out, HasSubstr("no violations"));
  }
  // With longer turns it is no plan.
  EXPECT_EQ(run(turning("verify", {"--turn", "2", path("p.json")})).code, 1);
  EXPECT_EQ(run(turning("view", {"--output", path("again.html"), path("p.json")})).code, 0);
  EXPECT_EQ(run(turning("execute-check", {path("p.json")})).code, 0);
  EXPECT_EQ(run(turning("export", {"--to", "csv", path("p.json")})).code, 0);
  EXPECT_EQ(run(turning("info")).code, 0);
}

// Pages of what robots did under delays have arrows, too: along its way each robot faces ahead.
TEST_F(TurningTest, PagesOfRunsSayWhereRobotsFace) {
  ASSERT_EQ(run(turning("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  const Finished ended = run(turning(
      "simulate", {path("p.json"), "--view", "-", "--quiet", "--delays", "0.5", "--seed", "3"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::size_t type = ended.out.find("type=\"application/json\"");
  ASSERT_NE(type, std::string::npos);
  const std::size_t begin = ended.out.find('>', type) + 1;
  const json scene =
      json::parse(ended.out.substr(begin, ended.out.find("</script>", begin) - begin));
  std::size_t num_turns = 0;
  for (const json& agent : scene.at("agents")) {
    const json &stops = agent.at("stops"), &headings = agent.at("headings");
    ASSERT_EQ(stops.size(), 4 * headings.size());
    for (std::size_t k = 0; k + 1 < headings.size(); ++k) {
      const double dx = stops[4 * k + 4].get<double>() - stops[4 * k].get<double>();
      const double dy = stops[4 * k + 5].get<double>() - stops[4 * k + 1].get<double>();
      const double from = headings[k], to = headings[k + 1];
      if (std::hypot(dx, dy) < 1) {
        num_turns += from == to ? 0 : 1;
        continue;
      }
      EXPECT_EQ(from, to);
      EXPECT_NEAR(std::remainder(std::atan2(dy, dx) * 180 / std::numbers::pi - from, 360), 0, 1);
    }
  }
  EXPECT_GE(num_turns, 1U);
}

// Facing east, it turns to the right for two timesteps, goes down, and turns back.
TEST_F(TurningTest, ExportsSayWhereRobotsFace) {
  write("down.map", "type octile\nheight 2\nwidth 1\nmap\n.\n.\n");
  write("down.scen", "version 1\n0\tdown.map\t1\t2\t0\t0\t0\t1\t1\n");
  write("down.json", R"({"quadrille": "plan", "version": 1,
    "resolution": {"length": 0.01, "time": 1}, "plan": [[
    {"vertex": 0, "arrive_ticks": 0, "depart_ticks": 1},
    {"vertex": 1, "arrive_ticks": 3, "depart_ticks": 3},
    {"vertex": 5, "arrive_ticks": 4, "depart_ticks": 5},
    {"vertex": 4, "arrive_ticks": 7}]]})");
  const auto exported_to = [&](const std::string& format, const std::string& plan) {
    std::vector<std::string> words{
        "export",   "--map", path("down.map"), "--scen",  path("down.scen"),
        "--agents", "1",     "--headings",     "4",       "--turn",
        "2",        "--to",  format,           path(plan)};
    if (format == "multidof") words.insert(words.end(), {"--rate", "1"});
    const Finished finished = run(words);
    EXPECT_EQ(finished.code, 0) << finished.err;
    return json::parse(finished.out)[0];
  };
  const json points = exported_to("multidof", "down.json")["points"];
  // In eighths of a full turn, and per timestep.
  const std::vector<int> facing{0, 0, 1, 2, 2, 2, 1, 0}, turning{0, 1, 1, 0, 0, -1, -1, 0};
  ASSERT_EQ(points.size(), facing.size());
  const double eighth = std::acos(0.0) / 2;
  for (std::size_t k = 0; k < facing.size(); ++k) {
    SCOPED_TRACE(k);
    const json& rotation = points[k]["transforms"][0]["rotation"];
    EXPECT_NEAR(rotation["z"].get<double>(), std::sin(facing[k] * eighth / 2), 1e-12);
    EXPECT_NEAR(rotation["w"].get<double>(), std::cos(facing[k] * eighth / 2), 1e-12);
    EXPECT_NEAR(points[k]["velocities"][0]["angular"]["z"].get<double>(), turning[k] * eighth,
                1e-12);
  }
  const json order = exported_to("vda5050", "down.json");
  std::vector<double> thetas;
  for (const json& node : order["nodes"]) thetas.push_back(node["nodePosition"]["theta"]);
  EXPECT_EQ(thetas, (std::vector<double>{0, 2 * eighth, 2 * eighth, 0}));

  // To the left by way of north: west is half a turn to either side.
  write("left.json", R"({"quadrille": "plan", "version": 1,
    "resolution": {"length": 0.01, "time": 1}, "plan": [[
    {"vertex": 0, "arrive_ticks": 0, "depart_ticks": 0},
    {"vertex": 3, "arrive_ticks": 2, "depart_ticks": 2},
    {"vertex": 2, "arrive_ticks": 4}]]})");
  write("down.scen", "version 1\n0\tdown.map\t1\t2\t0\t0\t0\t0\t0\n");
  const json left = exported_to("multidof", "left.json")["points"];
  ASSERT_EQ(left.size(), 5u);
  for (std::size_t k = 0; k < left.size(); ++k) {
    SCOPED_TRACE(k);
    const json& rotation = left[k]["transforms"][0]["rotation"];
    EXPECT_NEAR(rotation["w"].get<double>(), std::cos(static_cast<double>(k) * eighth / 2), 1e-12);
    EXPECT_NEAR(left[k]["velocities"][0]["angular"]["z"].get<double>(), k < 4 ? -eighth : 0, 1e-12);
  }
}

TEST_F(TurningTest, AnInstanceFileIsTheSame) {
  ASSERT_EQ(run(turning("convert", {"--to", "json", "--output", path("i.json")})).code, 0);
  const Finished solved = run(turning("solve", {"--quiet", "--json", path("r.json")}));
  ASSERT_EQ(solved.code, 0) << solved.err;
  const Finished again =
      run({"solve", "--instance", path("i.json"), "--quiet", "--json", "-", "--plan", path("q")});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out).at("plan"), json::parse(read("r.json")).at("plan"));
  EXPECT_EQ(run(turning("verify", {path("q")})).code, 0);
  EXPECT_EQ(run({"verify", "--instance", path("i.json"), path("r.json")}).code, 0);
  // Logs name vertices then, not cells.
  for (const auto& input :
       {turning("convert"), std::vector<std::string>{"convert", "--instance", path("i.json")}}) {
    ASSERT_EQ(run(input +
                  std::vector<std::string>{"--to", "ccbs", "--output", path("log.xml"), path("q")})
                  .code,
              0);
    EXPECT_EQ(run(turning("verify", {path("log.xml")})).code, 0);
  }
}

/// Where a robot is after the actions of a plan, as the League of Robot Runners has them; at no
/// time in a cell that is not passable.
std::pair<int, int> follow(const json& start, const std::string& actions,
                           const std::vector<std::string>& rows) {
  int y = start.at(0), x = start.at(1);
  int heading = static_cast<int>(std::string("ESWN").find(std::string(start.at(2))));
  for (std::size_t k = 0; k < actions.size(); ++k) {
    if (k % 2 == 1) {
      EXPECT_EQ(actions[k], ',');
      continue;
    }
    if (actions[k] == 'R') heading = (heading + 1) % 4;
    if (actions[k] == 'C') heading = (heading + 3) % 4;
    if (actions[k] == 'F') {
      x += heading == 0 ? 1 : heading == 2 ? -1 : 0;
      y += heading == 1 ? 1 : heading == 3 ? -1 : 0;
    }
    EXPECT_EQ(rows.at(static_cast<std::size_t>(y)).at(static_cast<std::size_t>(x)), '.');
  }
  return {y, x};
}

TEST_F(TurningTest, PlanVizShowsActions) {
  write("room.map", "type octile\nheight 3\nwidth 3\nmap\n...\n.@.\n...\n");
  write("room.scen",
        "version 1\n0\troom.map\t3\t3\t0\t0\t2\t2\t4\n0\troom.map\t3\t3\t2\t0\t0\t2\t4\n"
        "0\troom.map\t3\t3\t1\t2\t1\t0\t4\n");
  const std::vector<std::string> input{
      "--map", path("room.map"), "--scen", path("room.scen"), "--agents", "3", "--headings", "4"};
  const Finished solved = run(std::vector<std::string>{"solve"} + input +
                              std::vector<std::string>{"--quiet", "--json", path("r.json")});
  ASSERT_EQ(solved.code, 0) << solved.err;
  const json result = json::parse(read("r.json"));
  const std::vector<std::string> planviz{"--to", "planviz", path("r.json")};
  const Finished exported = run(std::vector<std::string>{"export"} + input + planviz);
  ASSERT_EQ(exported.code, 0) << exported.err;
  const json shown = json::parse(exported.out);
  EXPECT_EQ(shown.at("actionModel"), "MAPF_T");
  EXPECT_EQ(shown.at("teamSize"), 3);
  EXPECT_EQ(shown.at("sumOfCost"), result.at("cost"));
  EXPECT_EQ(shown.at("start"), json::parse(R"([[0, 0, "E"], [0, 2, "E"], [2, 1, "E"]])"));
  EXPECT_EQ(shown.at("tasks"), json::parse("[[0, 0, [2, 2]], [1, 0, [2, 0]], [2, 0, [0, 1]]]"));
  const std::pair<int, int> goals[] = {{2, 2}, {2, 0}, {0, 1}};
  const std::size_t makespan = shown.at("makespan");
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string actions = shown.at("actualPaths").at(i);
    EXPECT_EQ(actions.size(), 2 * makespan - 1);
    EXPECT_EQ(follow(shown.at("start").at(i), actions, {"...", ".@.", "..."}), goals[i]);
    // It does nothing after its last arrival.
    const std::size_t arrival = shown.at("events").at(i).at(0);
    EXPECT_EQ(actions.find_last_not_of("W,") / 2 + 1, arrival);
  }
  // Not for other turns, other roadmaps, or with a rate.
  EXPECT_EQ(run(std::vector<std::string>{"export"} + input +
                std::vector<std::string>{"--turn", "2"} + planviz)
                .code,
            65);
  EXPECT_EQ(run(discs("export", planviz)).code, 65);
  EXPECT_EQ(run(std::vector<std::string>{"export"} + input + planviz +
                std::vector<std::string>{"--rate", "2"})
                .code,
            64);
}

/// A problem of the League of Robot Runners: robot k goes to the first place of task k.
class RobotRunnersTest : public TurningTest {
 protected:
  RobotRunnersTest() {
    std::filesystem::create_directories(path("maps"));
    write("maps/room.map", "type octile\nheight 2\nwidth 3\nmap\n.E.\nS.@\n");
    write("room.agents", "3\n0\n2\n4\n");
    write("room.tasks", "# version for LoRR 2024\n4\n1,0\n0\n3,1\n2\n");
    write("room.json", problem());
  }
  [[nodiscard]] static std::string problem(const std::string& more = "\"teamSize\": 2") {
    return "{\"mapFile\": \"maps/room.map\", \"agentFile\": \"room.agents\",\n"
           "\"taskFile\": \"room.tasks\", \"numTasksReveal\": 1.5,\n" +
           more + "}\n";
  }
  void expect_refused(const std::string& reason) const {
    const Finished finished = run({"solve", "--instance", path("room.json")});
    EXPECT_EQ(finished.code, 65) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr(reason));
  }
};

TEST_F(RobotRunnersTest, ProblemsAreInstances) {
  const Finished solved = run({"solve", "--instance", path("room.json"), "--json", path("r.json")});
  ASSERT_EQ(solved.code, 0) << solved.err;
  EXPECT_THAT(solved.out, HasSubstr("room.json: 3 x 2 grid, 4 headings, turns of 1 timestep"));
  const json result = json::parse(read("r.json"));
  // The first goes one cell ahead; the second comes from the right end to where the first was.
  EXPECT_EQ(result.at("agents"), 2);
  write("same.map", "type octile\nheight 2\nwidth 3\nmap\n...\n..@\n");
  write("same.scen",
        "version 1\n0\tsame.map\t3\t2\t0\t0\t1\t0\t1\n0\tsame.map\t3\t2\t2\t0\t0\t0\t2\n");
  const Finished same = run({"solve", "--map", path("same.map"), "--scen", path("same.scen"),
                             "--agents", "2", "--headings", "4", "--quiet", "--json", "-"});
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(json::parse(same.out).at("plan"), result.at("plan"));
  for (const std::string command : {"verify", "execute-check"})
    EXPECT_EQ(run({command, "--instance", path("room.json"), path("r.json")}).code, 0);
  EXPECT_EQ(
      run({"view", "--instance", path("room.json"), "--output", path("v.html"), path("r.json")})
          .code,
      0);
  const Finished shown =
      run({"export", "--instance", path("room.json"), "--to", "planviz", path("r.json")});
  EXPECT_EQ(json::parse(shown.out).at("sumOfCost"), result.at("cost"));
  EXPECT_EQ(
      run({"convert", "--instance", path("room.json"), "--to", "json", "--output", path("i.json")})
          .code,
      0);
  EXPECT_EQ(run({"verify", "--instance", path("i.json"), path("r.json")}).code, 0);
  EXPECT_EQ(run({"verify", "--instance", path("room.json"), "--agents", "1", path("r.json")}).code,
            1);
}

TEST_F(RobotRunnersTest, WhatIsWrongIsSaidWithItsFile) {
  write("room.json", problem("\"teamSize\": 4"));
  expect_refused("room.agents: there are 3 starts for 4 robots");
  write("room.json", "{\"mapFile\": \"maps/room.map\", \"agentFile\": \"room.agents\"}");
  expect_refused("room.json:1: the key 'taskFile' is missing");
  write("room.json", problem("\"teamSize\": -1"));
  expect_refused("room.json:3: ");
  for (const char* key : {"agentSize", "agentCounter"}) {
    write("room.json", problem("\"" + std::string(key) + "\": 3"));
    expect_refused("room.json:3: /" + std::string(key) + ": it belongs to problems with actions");
  }
  write("room.json", problem("\"version\": 1"));
  write("room.tasks", "2\n1\n5\n");
  expect_refused("room.tasks:3: cell 5 of the map is not passable");
  write("room.tasks", "2\n1\n");
  expect_refused("room.tasks:3: the file ends too early");
  write("room.tasks", "2\n1\n3\n");
  expect_refused("room.tasks: there are 2 tasks for 3 robots");
  write("room.agents", "3\n0\n6\n4\n");
  expect_refused("room.agents:3: cell 6 of the map is not passable");
  write("room.agents", "x\n");
  expect_refused("room.agents:1: 'x' is no number of lines");
  std::filesystem::remove(path("room.agents"));
  expect_refused("room.agents");
}

TEST_F(TurningTest, WrongOptionsAreRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {small("solve", {"--headings", "8"}), "--headings"},
      {small("solve", {"--turn", "1"}), "--turn needs --headings"},
      {xml("solve", {"--turn", "1"}), "--turn needs --headings"},
      {discs("solve", {"--turn", "1"}), "--turn needs --headings"},
      {turning("solve", {"--turn", "0"}), "--turn"},
      {turning("solve", {"--radius", "0.3"}), "--radius"},
      {turning("verify", {"--resolution", "0.3", path("p")}), "--resolution"},
      {discs("solve", {"--headings", "4"}), "--headings goes with --map"},
      {xml("solve", {"--headings", "4"}), "--headings goes with --map"},
      {{"solve", "--map", path("small.map"), "--headings", "4"}, "--scen is missing"},
      {turning("solve", {"--proof", path("x")}), "--proof"},
      {turning("solve", {"--plan", path("x"), "--plan-format", "cbsh2"}), "not for roadmaps"}};
  for (const auto& [arguments, reason] : cases) {
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.code, 64) << testing::PrintToString(arguments);
    EXPECT_THAT(finished.err, HasSubstr(reason)) << testing::PrintToString(arguments);
  }
}

TEST_F(TurningTest, WrongFilesAreRefused) {
  write("blocked.map", "type octile\nheight 1\nwidth 3\nmap\n..@\n");
  write("blocked.scen", "version 1\n0\tblocked.map\t3\t1\t0\t0\t2\t0\t1\n");
  const auto expect_refused = [&](const std::string& map, const std::string& scen, int code,
                                  const std::string& reason) {
    const Finished finished = run(
        {"solve", "--map", path(map), "--scen", path(scen), "--agents", "1", "--headings", "4"});
    EXPECT_EQ(finished.code, code) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr(reason));
  };
  expect_refused("blocked.map", "blocked.scen", 65,
                 "blocked.scen:2: the goal of agent 0: (2, 0) is blocked");
  expect_refused("map.xml", "blocked.scen", 65, "map.xml: --headings needs a grid");
  expect_refused("none.map", "blocked.scen", 65, "none.map");
}

}  // namespace
}  // namespace quadrille::cli::test
