// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ExportTest : public RoadmapCliTest {
 protected:
  ExportTest() {
    EXPECT_EQ(run(xml("solve", {"--quiet", "--plan", path("plan.json")})).code, 0);
    plan_ = json::parse(read("plan.json"))["plan"];
  }
  [[nodiscard]] std::string exported(const std::vector<std::string>& more) const {
    const Finished finished =
        run(xml("export", more + std::vector<std::string>{path("plan.json")}));
    EXPECT_EQ(finished.code, 0) << finished.err;
    return finished.out;
  }
  json plan_;
};

TEST_F(ExportTest, SamplesAreOnThePath) {
  std::istringstream lines(exported({"--to", "csv", "--rate", "8"}));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, "agent,time,x,y,vx,vy");
  std::size_t count = 0;
  double last_time = -1;
  int last_agent = -1;
  while (std::getline(lines, line)) {
    int agent = 0;
    double time = 0, x = 0, y = 0, vx = 0, vy = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%lf,%lf,%lf,%lf,%lf", &agent, &time, &x, &y, &vx, &vy),
              6)
        << line;
    if (agent == last_agent) {
      EXPECT_GT(time, last_time);
      EXPECT_LE(time, last_time + 0.125 + 1e-9);
    } else {
      EXPECT_EQ(time, 0);
    }
    last_agent = agent;
    last_time = time;
    // Agent 0 goes from (0, 0) to (2, 0), agent 1 from (1, -1) to (1, 1), at speed 1.
    const json& stops = plan_[static_cast<std::size_t>(agent)];
    const double depart = stops[0]["depart"], arrive = stops[1]["arrive"];
    const double way = std::clamp(time, depart, arrive) - depart;
    EXPECT_NEAR(x, agent == 0 ? way : 1, 1e-9);
    EXPECT_NEAR(y, agent == 0 ? 0 : way - 1, 1e-9);
    const double speed = depart <= time && time < arrive ? 1 : 0;
    EXPECT_NEAR(agent == 0 ? vx : vy, speed, 1e-9);
    ++count;
  }
  EXPECT_EQ(last_agent, 1);
  EXPECT_GE(count, 34u);
}

TEST_F(ExportTest, MessagesHaveTheFieldsOfRos) {
  const json multidof = json::parse(exported({"--to", "multidof", "--rate", "2"}));
  ASSERT_EQ(multidof.size(), 2u);
  EXPECT_EQ(multidof[1]["joint_names"], json({"agent1"}));
  const json& last = multidof[1]["points"].back();
  EXPECT_EQ(last["transforms"][0]["translation"], json({{"x", 1.0}, {"y", 1.0}, {"z", 0.0}}));
  EXPECT_EQ(last["velocities"][0]["linear"]["y"], 0.0);
  const double arrive = plan_[1][1]["arrive"];
  const auto seconds = [](const json& time, const char* whole, const char* nanoseconds) {
    EXPECT_EQ(time.size(), 2u);
    return time.at(whole).get<double>() + time.at(nanoseconds).get<double>() / 1e9;
  };
  EXPECT_NEAR(seconds(last["time_from_start"], "sec", "nanosec"), arrive, 1e-9);
  const json nav = json::parse(exported({"--to", "path", "--rate", "2"}));
  ASSERT_EQ(nav.size(), 2u);
  ASSERT_EQ(nav[0]["poses"].size(), multidof[0]["points"].size());
  EXPECT_EQ(nav[0]["poses"].back()["pose"]["position"]["x"], 2.0);
  EXPECT_EQ(nav[0]["poses"].back()["header"]["frame_id"], "map");
  const json old = json::parse(exported({"--to", "path", "--rate", "2", "--ros", "1"}));
  EXPECT_NEAR(seconds(old[1]["poses"].back()["header"]["stamp"], "secs", "nsecs"), arrive, 1e-9);
}

/// It waits, goes along y, waits, goes along x and back.
TEST_F(ExportTest, HeadingsAreAlongTheMoves) {
  write("bend.json", R"({"quadrille": "instance", "version": 1, "roadmap": {
    "vertices": [[0, 0], [0, 2], [1, 2]], "edges": [[0, 1], [1, 2], [2, 0]]},
    "agents": [{"start": 0, "goal": 0, "name": "forklift", "radius": 0.3}]})");
  write("bend_plan.json", R"({"quadrille": "plan", "version": 1, "resolution": 0.000001, "plan": [[
    {"vertex": 0, "arrive_ticks": 0, "depart_ticks": 1000000},
    {"vertex": 1, "arrive_ticks": 3000000, "depart_ticks": 4000000},
    {"vertex": 2, "arrive_ticks": 5000000, "depart_ticks": 5000000},
    {"vertex": 0, "arrive_ticks": 7236068}]]})");
  const auto exported_to = [&](const std::string& format) {
    const Finished finished = run({"export", "--instance", path("bend.json"), "--rate", "0.0001",
                                   "--to", format, path("bend_plan.json")});
    EXPECT_EQ(finished.code, 0) << finished.err;
    return json::parse(finished.out)[0];
  };
  const json poses = exported_to("path")["poses"], multidof = exported_to("multidof");
  EXPECT_EQ(multidof["joint_names"], json({"forklift"}));
  const double along_y = std::acos(0.0), back = std::atan2(-2, -1);
  const std::vector<double> expected{along_y, along_y, along_y, 0, back, back};
  ASSERT_EQ(poses.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    SCOPED_TRACE(k);
    const json& orientation = poses[k]["pose"]["orientation"];
    EXPECT_EQ(orientation["x"], 0.0);
    EXPECT_EQ(orientation["y"], 0.0);
    EXPECT_NEAR(orientation["z"].get<double>(), std::sin(expected[k] / 2), 1e-12);
    EXPECT_NEAR(orientation["w"].get<double>(), std::cos(expected[k] / 2), 1e-12);
    EXPECT_EQ(multidof["points"][k]["transforms"][0]["rotation"], orientation);
  }
}

TEST_F(ExportTest, RosEndsIn2038) {
  write("late.json", R"({"quadrille": "instance", "version": 1, "resolution":
    {"length": 0.001, "time": 3000000000}, "roadmap": {
    "vertices": [[0, 0], [1, 0]], "edges": [[0, 1, 3000000000]]},
    "agents": [{"start": 0, "goal": 1, "radius": 0.3, "speed": 1e-9}]})");
  write("late_plan.json", R"({"quadrille": "plan", "version": 1, "resolution":
    {"length": 0.001, "time": 3000000000}, "plan": [[
    {"vertex": 0, "arrive_ticks": 0, "depart_ticks": 0}, {"vertex": 1, "arrive_ticks": 1}]]})");
  for (const char* const format : {"csv", "path", "multidof"}) {
    const Finished finished = run({"export", "--instance", path("late.json"), "--rate", "1e-9",
                                   "--to", format, path("late_plan.json")});
    EXPECT_EQ(finished.code, format == std::string("csv") ? 0 : 65) << finished.err;
    if (finished.code != 0) {
      EXPECT_THAT(finished.err, HasSubstr("end at 2147483647 seconds"));
    }
  }
}

TEST_F(ExportTest, Heights) {
  const std::string drones = path("drones.json"), plan = path("drones_plan.json");
  ASSERT_EQ(run({"generate", "--kind", "roadmap", "--vertices", "20", "--width", "5", "--height",
                 "5", "--altitude", "4", "--agents", "3", "--instance-output", drones})
                .code,
            0);
  ASSERT_EQ(run({"solve", "--instance", drones, "--quiet", "--plan", plan}).code, 0);
  const auto exported_to = [&](const std::string& format) {
    return run({"export", "--instance", drones, "--to", format, plan});
  };
  const std::string csv = exported_to("csv").out;
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "agent,time,x,y,z,vx,vy,vz");
  const json stops = json::parse(read("drones_plan.json"))["plan"];
  const json paths = json::parse(exported_to("path").out);
  ASSERT_EQ(paths.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const json& position = paths[i]["poses"].back()["pose"]["position"];
    EXPECT_EQ(position["z"], stops[i].back()["at"][2]);
    EXPECT_GT(position["z"], 0);
  }
  const Finished orders = exported_to("vda5050");
  EXPECT_EQ(orders.code, 65);
  EXPECT_THAT(orders.err, HasSubstr("orders of VDA 5050 have no heights"));
}

TEST_F(ExportTest, OrdersReleaseTheLeaderOnly) {
  const json orders = json::parse(exported({"--to", "vda5050"}));
  ASSERT_EQ(orders.size(), 2u);
  // They cross: one of them has to wait for the other one to end.
  EXPECT_NE(orders[0]["edges"][0]["released"], orders[1]["edges"][0]["released"]);
  EXPECT_EQ(orders[0]["nodes"][0]["released"], true);
  EXPECT_EQ(orders[0]["nodes"][1]["nodePosition"],
            json({{"x", 2.0}, {"y", 0.0}, {"mapId", "map"}}));
  EXPECT_NEAR(orders[0]["edges"][0]["maximumSpeed"].get<double>(), 1, 1e-9);
}

TEST_F(ExportTest, VersionsOfOrders) {
  const json newest = json::parse(exported({"--to", "vda5050"}));
  EXPECT_EQ(newest[0]["version"], "3.0.0");
  EXPECT_EQ(json::parse(exported({"--to", "vda5050", "--vda-version", "3.0"})), newest);
  for (const std::string version : {"2.0", "2.1"}) {
    json older = json::parse(exported({"--to", "vda5050", "--vda-version", version}));
    for (std::size_t i = 0; i < older.size(); ++i) {
      EXPECT_EQ(older[i]["version"], version + ".0");
      older[i]["version"] = "3.0.0";
      json& edge = older[i]["edges"][0];
      EXPECT_EQ(edge["startNodeId"], older[i]["nodes"][0]["nodeId"]);
      EXPECT_EQ(edge["endNodeId"], older[i]["nodes"][1]["nodeId"]);
      edge["maximumSpeed"] = edge["maxSpeed"];
      for (const char* const key : {"startNodeId", "endNodeId", "maxSpeed"}) edge.erase(key);
    }
    EXPECT_EQ(older, newest);
  }
}

TEST_F(ExportTest, OrdersCallThingsByTheirNames) {
  // Those of the roadmap and of the instance.
  const std::string numbered = read("map.xml");
  write("map.xml", std::regex_replace(numbered, std::regex("\"n([0-3])"), "\"dock-$1"));
  const json by_ids = json::parse(exported({"--to", "vda5050"}));
  EXPECT_EQ(by_ids[1]["nodes"][0]["nodeId"], "dock-2");
  EXPECT_EQ(by_ids[1]["edges"][0]["edgeId"], "dock-2-dock-3");
  EXPECT_EQ(by_ids[1]["serialNumber"], "agent1");
  EXPECT_EQ(by_ids[1]["orderId"], "agent1");
  EXPECT_EQ(by_ids[1]["manufacturer"], "quadrille");
  write("map.xml", numbered);
  ASSERT_EQ(run(xml("convert", {"--to", "json", "--output", path("i.json")})).code, 0);
  json instance = json::parse(read("i.json"));
  instance["agents"][1]["name"] = "AGV_1:b";
  instance["roadmap"]["names"] = {"dock", 7, {1, "a"}};
  write("i.json", instance.dump());
  const auto exported_from = [&](const std::vector<std::string>& more) {
    return run(std::vector<std::string>{"export", "--instance", path("i.json"), "--to", "vda5050"} +
               more + std::vector<std::string>{path("plan.json")});
  };
  json orders = json::parse(exported_from({}).out);
  EXPECT_EQ(orders[1]["serialNumber"], "AGV_1:b");
  EXPECT_EQ(orders[1]["nodes"][0]["nodeId"], "[1, \"a\"]");
  EXPECT_EQ(orders[1]["nodes"][1]["nodeId"], "v3");
  EXPECT_EQ(orders[0]["edges"][0]["edgeId"], "dock-7");

  // Those that the user gives, in place of them.
  write("names.json",
        R"({"manufacturer": "ACME", "map": "hall 2", "agents": [null, "r2"], "vertices": ["a"]})");
  write("names.yaml", "manufacturer: ACME\nmap: hall 2\nagents: [null, r2]\nvertices:\n- a\n");
  for (const char* const file : {"names.json", "names.yaml"}) {
    const Finished finished =
        exported_from({"--names", path(file), "--order-id", "shift-7", "--vda-version", "2.1"});
    ASSERT_EQ(finished.code, 0) << finished.err;
    orders = json::parse(finished.out);
    EXPECT_EQ(orders[0]["serialNumber"], "agent0");
    EXPECT_EQ(orders[1]["serialNumber"], "r2");
    EXPECT_EQ(orders[1]["orderId"], "shift-7-r2");
    EXPECT_EQ(orders[1]["manufacturer"], "ACME");
    EXPECT_EQ(orders[0]["nodes"][0]["nodeId"], "a");
    EXPECT_EQ(orders[0]["edges"][0]["endNodeId"], "v1");
    EXPECT_EQ(orders[0]["nodes"][0]["nodePosition"]["mapId"], "hall 2");
  }
  // States name robots and orders in the same way.
  const std::string leader = orders[0]["edges"][0]["released"] == true ? "agent0" : "r2";
  write("states",
        json{{"serialNumber", leader}, {"orderId", "shift-7-" + leader}, {"lastNodeSequenceId", 2}}
                .dump() +
            "\n");
  const Finished released = exported_from(
      {"--names", path("names.json"), "--order-id", "shift-7", "--states", path("states")});
  EXPECT_EQ(released.code, 0) << released.err;
  EXPECT_EQ(std::count(released.out.begin(), released.out.end(), '\n'), 3) << released.err;
  const Finished multidof =
      run(xml("export", {"--to", "multidof", "--names", path("names.json"), path("plan.json")}));
  ASSERT_EQ(multidof.code, 0) << multidof.err;
  EXPECT_EQ(json::parse(multidof.out)[1]["joint_names"], json({"r2"}));
}

TEST_F(ExportTest, RefusesNamesThatAreNone) {
  const auto refuses = [&](const std::string& names, const std::string& why) {
    write("names.json", names);
    const Finished finished =
        run(xml("export", {"--to", "vda5050", "--names", path("names.json"), path("plan.json")}));
    EXPECT_EQ(finished.code, 65) << names;
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.err, testing::AllOf(HasSubstr("names.json"), HasSubstr(why))) << names;
  };
  refuses("[]", "expected an object");
  refuses(R"({"robots": []})", "robots");
  refuses(R"({"map": ""})", "the name is empty");
  refuses(R"({"agents": ["a", "b", "c"]})", "3 names, but 2 agents");
  refuses(R"({"agents": ["a", "a"]})", "agents 0 and 1 are both called 'a'");
  refuses(R"({"agents": ["agent1"]})", "agents 0 and 1 are both called 'agent1'");
  refuses(R"({"agents": ["a b"]})", "'a b' is no serial number of VDA 5050");
  refuses(R"({"agents": [""]})", "'' is no serial number");
  refuses("{\"agents\": [\"r\u00e9\"]}", "is no serial number");
  refuses(R"({"vertices": ["a", "b", "c", "d", "e"]})", "there are only 4 vertices");
  refuses(R"({"vertices": ["a", "a"]})", "another vertex has this name");
  refuses(R"({"vertices": ["v1"]})", "vertices 0 and 1 are both called 'v1'");
  refuses(R"({"vertices": [1, "1"]})", "vertices 0 and 1 are both called '1'");
  refuses(R"({"vertices": [""]})", "the name of vertex 0 is empty");
  refuses("{\"map\":\n", "names.json:");
}

TEST_F(ExportTest, UpdatesReleaseWhatTheLeaderHasLeft) {
  const json orders = json::parse(exported({"--to", "vda5050"}));
  const std::string first = orders[0]["edges"][0]["released"] == true ? "agent0" : "agent1";
  const std::string second = first == "agent0" ? "agent1" : "agent0";
  const auto state = [](const std::string& robot, const json& node, const std::string& order) {
    return json{{"serialNumber", robot}, {"orderId", order}, {"lastNodeSequenceId", node}}.dump() +
           "\n";
  };
  const auto release = [&](const std::string& states) {
    write("states", states);
    return run(xml("export", {"--to", "vda5050", "--states", path("states"), path("plan.json")}));
  };
  const auto lines = [](const std::string& text) {
    std::istringstream in(text);
    std::vector<json> all;
    for (std::string line; std::getline(in, line);) all.push_back(json::parse(line));
    return all;
  };
  const std::string starts =
      state(second, 0, "") + state(first, 2, "another") + state(first, 0, first);
  Finished finished = release(starts);
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(json(lines(finished.out)), orders);  // Nobody has ended a move.
  // What comes after the last arrival is not read.
  finished = release(starts + state(first, 2, first) + state(second, 0, second) +
                     state(second, 2, second) + "nonsense\n");
  EXPECT_EQ(finished.code, 0) << finished.err;
  const auto all = lines(finished.out);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2]["serialNumber"], second);
  EXPECT_EQ(all[2]["orderUpdateId"], 1);
  EXPECT_EQ(all[2]["nodes"][0]["sequenceId"], 0);
  EXPECT_EQ(all[2]["edges"][0]["released"], true);
  EXPECT_EQ(all[2]["nodes"][1]["released"], true);

  const auto refuses = [&](const std::string& line, const std::string& why) {
    const Finished refused = release(starts + line + "\n");
    EXPECT_EQ(refused.code, 65);
    EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("states:4: "), HasSubstr(why)));
  };
  refuses(state(second, 2, second), "at node 2 without release; the last one released is 0");
  refuses(state(first, 4294967298u, first), "without release");

  // What says nothing about the plan does not keep robots from being released.
  const auto passes_over = [&](const std::string& line, const std::string& why,
                               const std::string& sum) {
    const Finished passed =
        release(line + "\n" + line + "\n" + state(first, 2, first) + state(second, 2, second));
    EXPECT_EQ(passed.code, 0) << passed.err;
    EXPECT_EQ(lines(passed.out), all) << line;
    EXPECT_EQ(passed.err, "quadrille: warning: " + path("states") + ":1: passed over: " + why +
                              "\nquadrille: warning: " + path("states") +
                              ": 2 lines passed over: 2 " + sum + " (first in line 1)\n");
  };
  passes_over("nonsense", "this is no JSON object", "broken");
  passes_over("[]", "this is no JSON object", "broken");
  passes_over("", "an empty line", "empty");
  passes_over(" \t\r", "an empty line", "empty");
  passes_over(R"({"serialNumber": "agent0", "orderId": "agent0"})",
              "a state has a number 'lastNodeSequenceId' that is not negative", "broken");
  passes_over(R"({"serialNumber": 0, "orderId": "agent0"})", "a state has a text 'serialNumber'",
              "broken");
  passes_over(R"({"serialNumber": "agent0"})", "a state has a text 'orderId'", "broken");
  const std::string number = "a state has a number 'lastNodeSequenceId' that is not negative";
  passes_over(json::parse(state(first, -2, first)).dump(), number, "broken");
  passes_over(json::parse(state(first, 1, first)).dump(), "nodes have even numbers, and not 1",
              "broken");
  passes_over(json::parse(state("AGV7", 8, "x-1")).dump(), "there is no robot 'AGV7' in the plan",
              "of robots that are not in the plan");
  passes_over(R"({"serialNumber": "AGV7"})", "there is no robot 'AGV7' in the plan",
              "of robots that are not in the plan");
  passes_over(json::parse(state(first, 8, "x-1")).dump(),
              "'" + first + "' follows the order 'x-1' of somebody else", "of other orders");
  finished = release(state("AGV7", 8, "x-1") + "\n" + state(first, 2, first) + "}\n" +
                     state(second, 2, second));
  EXPECT_EQ(lines(finished.out), all);
  EXPECT_THAT(finished.err,
              HasSubstr("3 lines passed over: 1 of robots that are not in the plan (first in line "
                        "1), 1 empty (first in line 2), 1 broken (first in line 4)\n"));
}

/// Four discs that turn in a square: each one's vertex is free only when it has gone.
TEST_F(ExportTest, OrdersThatLockUpAreNotWrittenInSilence) {
  write("square.json",
        "{\"quadrille\": \"instance\", \"version\": 1, \"roadmap\": {\n"
        "\"vertices\": [[0, 0], [2, 0], [2, 2], [0, 2]], "
        "\"edges\": [[0, 1], [1, 2], [2, 3], [3, 0]]},\n"
        "\"agents\": [{\"start\": 0, \"goal\": 1, \"radius\": 0.5}, "
        "{\"start\": 1, \"goal\": 2, \"radius\": 0.5},\n"
        "{\"start\": 2, \"goal\": 3, \"radius\": 0.5}, "
        "{\"start\": 3, \"goal\": 0, \"radius\": 0.5}]}\n");
  const std::string instance = path("square.json"), plan = path("square_plan.json");
  ASSERT_EQ(run({"solve", "--instance", instance, "--quiet", "--plan", plan}).code, 0);
  const auto exported_with = [&](const std::vector<std::string>& more) {
    return run(std::vector<std::string>{"export", "--instance", instance} + more +
               std::vector<std::string>{plan});
  };
  Finished finished = exported_with({"--to", "vda5050", "--output", path("orders.json")});
  EXPECT_EQ(finished.code, 1);
  EXPECT_FALSE(exists("orders.json"));
  EXPECT_THAT(finished.err, HasSubstr("quadrille: " + plan + ": with these orders robots wait"));
  for (const char* const who :
       {"agent0 waits at v0, on its way to v1, for agent1 to come from v1 to v2\n",
        "agent1 waits at v1, on its way to v2, for agent2 to come from v2 to v3\n",
        "agent2 waits at v2, on its way to v3, for agent3 to come from v3 to v0\n",
        "agent3 waits at v3, on its way to v0, for agent0 to come from v0 to v1\n"})
    EXPECT_THAT(finished.err, HasSubstr(who));
  EXPECT_THAT(finished.err, HasSubstr("--allow-cycles"));
  write("states", "");
  finished = exported_with({"--to", "vda5050", "--states", path("states")});
  EXPECT_EQ(finished.code, 1);
  EXPECT_EQ(finished.out, "");

  finished = exported_with({"--to", "vda5050", "--allow-cycles"});
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(json::parse(finished.out).size(), 4u);
  EXPECT_THAT(finished.err, HasSubstr("quadrille: warning: " + plan));
  EXPECT_THAT(finished.err, HasSubstr("agent3 waits at v3"));
  finished = exported_with({"--to", "vda5050", "--allow-cycles", "--states", path("states")});
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(std::count(finished.out.begin(), finished.out.end(), '\n'), 4);
  // Samples say when everybody is where, and make nobody wait.
  finished = exported_with({"--to", "path"});
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(finished.err, "");
}

TEST_F(ExportTest, RefusesWhatItCannotDo) {
  const auto refuses = [&](const std::vector<std::string>& arguments, int code,
                           const std::string& why) {
    const Finished finished = run(arguments + std::vector<std::string>{path("plan.json")});
    EXPECT_EQ(finished.code, code);
    EXPECT_THAT(finished.err, HasSubstr(why));
  };
  refuses(xml("export", {"--to", "vda5050", "--rate", "2"}), 64, "--rate belongs to samples");
  refuses(xml("export", {"--to", "csv", "--states", "-"}), 64, "--states belongs to");
  refuses(xml("export", {"--to", "csv", "--ros", "1"}), 64, "--ros belongs to multidof and path");
  refuses(xml("export", {"--to", "path", "--ros", "3"}), 64, "a whole number from 1 to 2");
  refuses(xml("export", {"--to", "vda5050", "--states", "-", "--output", path("x")}), 64,
          "orders go to standard output");
  refuses(xml("export", {"--to", "vda5050", "--states", path("none")}), 65, "cannot be read");
  refuses(xml("export", {"--to", "csv", "--allow-cycles"}), 64, "--allow-cycles belongs to");
  refuses(xml("export", {"--to", "csv", "--vda-version", "2.0"}), 64, "--vda-version belongs to");
  refuses(xml("export", {"--to", "vda5050", "--vda-version", "2"}), 64, "2.0, 2.1 or 3.0");
  refuses(xml("export", {"--to", "path", "--order-id", "a"}), 64, "--order-id belongs to");
  refuses(xml("export", {"--to", "vda5050", "--order-id", ""}), 64, "is not a name");
  refuses(xml("export", {"--to", "path", "--names", path("map.xml")}), 64, "--names belongs to");
  refuses(xml("export", {"--to", "vda5050", "--names", path("none")}), 65, "none");
  write("names.json", "{}");
  refuses(xml("export",
              {"--to", "vda5050", "--names", path("names.json"), "--output", path("names.json")}),
          64, "names.json is an input of this run");
  refuses(xml("export", {"--to", "bag"}), 64,
          "csv, multidof, path, vda5050, open-rmf-plan or planviz");
  refuses(xml("export", {"--to", "csv", "--rate", "1e12"}), 65, "more than 10 million samples");
  refuses(small("export", {"--to", "csv"}), 64, "export is for plans on roadmaps");
}

}  // namespace
}  // namespace quadrille::cli::test
