// SPDX-License-Identifier: MIT
//
// Options about rules, ties and starts: what they do, and what they do not go with.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;

class RulesCliTest : public RoadmapCliTest {
 protected:
  RulesCliTest() {
    write("line.json", R"({"quadrille": "instance", "version": 1,
  "graph": {"vertices": 4, "edges": [[0, 1], [1, 2], [2, 3]]},
  "agents": [{"start": 0, "goal": 2, "waypoints": [1]}]})");
    write("parked.json", R"({"quadrille": "instance", "version": 1, "resolution": 0.001,
  "roadmap": {"vertices": [[0, 0], [0.15, 0], [0, 1], [0.15, -1]], "edges": [[0, 2], [1, 3]]},
  "agents": [{"start": 0, "goal": 2, "radius": 0.1, "overlap_at_start": true},
             {"start": 1, "goal": 3, "radius": 0.1, "overlap_at_start": true}]})");
  }
  void expect_refusal(const std::vector<std::string>& arguments, const std::string& why,
                      int code = 64) const {
    const Finished refused = run(arguments);
    EXPECT_EQ(refused.code, code) << refused.out << refused.err;
    EXPECT_THAT(refused.err, HasSubstr(why));
  }
};

TEST_F(RulesCliTest, LeaveAndRobustAreForGridsAndGraphs) {
  const std::string own = "are for grids and graphs";
  for (const std::vector<std::string>& rule :
       {std::vector<std::string>{"--leave"}, {"--robust", "1"}}) {
    expect_refusal(xml("solve", rule), own);
    expect_refusal(discs("solve", rule), own);
    expect_refusal(small("solve", std::vector<std::string>{"--headings", "4"} + rule), own);
    expect_refusal(small("solve", std::vector<std::string>{"--proof", path("p")} + rule), "rules");
    expect_refusal(small("solve", std::vector<std::string>{"--explain"} + rule), "rules");
    expect_refusal(small("explain", rule), "rules");
  }
  for (const char* const number : {"-1", "1.5", "1048576", "x", ""})
    expect_refusal(small("solve", {"--robust", number}), "--robust");
  EXPECT_EQ(run(small("solve", {"--robust", "0", "--quiet"})).code, 0);
  const Finished robust = run(small("solve", {"--robust", "1"}));
  EXPECT_EQ(robust.code, 0) << robust.err;
  const Finished leave = run(small("solve", {"--leave", "--plan", path("p.json")}));
  EXPECT_EQ(leave.code, 0) << leave.err;
  EXPECT_EQ(run(small("verify", {"--leave", path("p.json")})).code, 0);
  const Finished alone = run({"verify", "--map", path("small.map"), "--leave", path("p.json")});
  EXPECT_NE(alone.code, 70) << alone.err;
}

TEST_F(RulesCliTest, WaypointsNeedDpll) {
  EXPECT_EQ(run({"solve", "--instance", path("line.json"), "--quiet"}).code, 0);
  for (const char* const system : {"dpll-mdd", "smt-cbs", "mdd-sat"})
    expect_refusal({"solve", "--instance", path("line.json"), "--system", system},
                   "waypoints, which needs --system dpll");
  expect_refusal({"solve", "--instance", path("line.json"), "--tie", "fewest-moves"}, "waypoints");
}

TEST_F(RulesCliTest, TiesAreBrokenByMoves) {
  const Finished text = run(small("solve", {"--tie", "fewest-moves"}));
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("no plan of this cost has fewer"));
  const auto json = nlohmann::json::parse(
      run(small("solve", {"--tie", "fewest-moves", "--quiet", "--json", "-"})).out);
  EXPECT_EQ(json["options"]["tie"], "fewest-moves");
  EXPECT_EQ(json["moves"]["proved"], true);
  EXPECT_EQ(json["moves"]["number"], json["moves"]["lower_bound"]);
  const auto any = nlohmann::json::parse(run(small("solve", {"--quiet", "--json", "-"})).out);
  EXPECT_FALSE(any.contains("moves"));
  EXPECT_EQ(any["options"]["tie"], "any");
  const auto cut = nlohmann::json::parse(
      run(small("solve", {"--tie", "fewest-moves", "--quiet", "--json", "-", "--time-limit", "0"}))
          .out);
  EXPECT_EQ(cut["moves"], nullptr);

  expect_refusal(small("solve", {"--tie", "fewest"}), "any or fewest-moves");
  expect_refusal(small("solve", {"--tie", "fewest-moves", "--gap", "1"}), "--gap");
  expect_refusal(xml("solve", {"--tie", "fewest-moves"}), "--tie does not apply to roadmaps");
  expect_refusal(small("solve", {"--tie", "fewest-moves", "--share-goals", "all"}), "goals");
}

TEST_F(RulesCliTest, ParkedNearerThanTheirBodies) {
  const Finished solved =
      run({"solve", "--instance", path("parked.json"), "--plan", path("parked.plan.json")});
  ASSERT_EQ(solved.code, 0) << solved.err;
  EXPECT_THAT(solved.out, HasSubstr("1 pairs of agents overlap at their starts"));
  EXPECT_EQ(run({"verify", "--instance", path("parked.json"), "--check-with", "fcl", "--quiet",
                 path("parked.plan.json")})
                .code,
            0);
  // Nobody knows an order of moves that keeps them apart.
  expect_refusal({"execute-check", "--instance", path("parked.json"), path("parked.plan.json")},
                 "overlap at their starts", 65);
  write("near.xml",
        "<graphml>\n<key id=\"c\" for=\"node\" attr.name=\"coords\"/>\n"
        "<graph edgedefault=\"directed\">\n"
        "<node id=\"n0\"><data key=\"c\">0,0</data></node>\n"
        "<node id=\"n1\"><data key=\"c\">0.5,0</data></node>\n"
        "<node id=\"n2\"><data key=\"c\">0,2</data></node>\n"
        "<node id=\"n3\"><data key=\"c\">0.5,-2</data></node>\n"
        "<edge source=\"n0\" target=\"n2\"/>\n<edge source=\"n1\" target=\"n3\"/>\n"
        "</graph>\n</graphml>\n");
  write("near_task.xml",
        "<root>\n<agent start_id=\"0\" goal_id=\"2\"/>\n<agent start_id=\"1\" goal_id=\"3\"/>\n"
        "</root>\n");
  const std::vector<std::string> near{
      "solve", "--roadmap", path("near.xml"), "--task", path("near_task.xml"), "--radius", "0.3"};
  EXPECT_EQ(run(near).code, 20);
  const Finished parked = run(near + std::vector<std::string>{"--overlap-at-start"});
  EXPECT_EQ(parked.code, 0) << parked.err;
  EXPECT_THAT(parked.out, HasSubstr("overlap at their starts"));
  expect_refusal(small("solve", {"--overlap-at-start"}), "--overlap-at-start belongs to --roadmap");
  expect_refusal(discs("solve", {"--overlap-at-start"}), "--overlap-at-start belongs to --roadmap");
  expect_refusal(small("solve", {"--headings", "4", "--overlap-at-start"}), "--overlap-at-start");
  expect_refusal(near + std::vector<std::string>{"--overlap-at-start", "--proof", path("p")},
                 "overlap at their starts", 65);
}

TEST_F(RulesCliTest, OrdersHaveTimeStamps) {
  ASSERT_EQ(run(xml("solve", {"--quiet", "--plan", path("plan.json")})).code, 0);
  const auto orders = [&](const std::vector<std::string>& more) {
    return run(xml("export", std::vector<std::string>{"--to", "vda5050"} + more +
                                 std::vector<std::string>{path("plan.json")}));
  };
  const std::string time = "2028-02-29T23:59:59.001Z";
  for (const auto& [more, stamp] :
       {std::pair(std::vector<std::string>{}, std::string("1970-01-01T00:00:00.000Z")),
        std::pair(std::vector<std::string>{"--time-stamp", time}, time)}) {
    const Finished done = orders(more);
    ASSERT_EQ(done.code, 0) << done.err;
    const auto json = nlohmann::json::parse(done.out);
    ASSERT_EQ(json.size(), 2U);
    for (const auto& order : json) EXPECT_EQ(order["timestamp"], stamp);
  }
  for (const char* const wrong :
       {"", "now", "2027-02-29T00:00:00.000Z", "2028-13-01T00:00:00.000Z",
        "2028-00-01T00:00:00.000Z", "2028-01-01T24:00:00.000Z", "2028-01-01T00:60:00.000Z",
        "2028-01-01 00:00:00.000Z", "2028-01-01T00:00:00Z", "2028-01-01T00:00:00.000+01"}) {
    const Finished refused = orders({"--time-stamp", wrong});
    EXPECT_EQ(refused.code, 64) << wrong;
    EXPECT_THAT(refused.err, HasSubstr("--time-stamp"));
  }
  expect_refusal(xml("export", {"--to", "csv", "--time-stamp", time, path("plan.json")}),
                 "--time-stamp belongs to --to vda5050");
}

TEST_F(RulesCliTest, ConvertedPosesKeepTheirHeadings) {
  const Finished converted = run(small("convert", {"--headings", "4", "--to", "json"}));
  ASSERT_EQ(converted.code, 0) << converted.err;
  const auto json = nlohmann::json::parse(converted.out);
  const auto& names = json["roadmap"]["names"];
  ASSERT_EQ(names.size(), json["roadmap"]["vertices"].size());
  const char* const headings[] = {"east", "south", "west", "north"};
  for (std::size_t v = 0; v < names.size(); ++v) {
    EXPECT_EQ(names[v][2], headings[v % 4]);
    EXPECT_EQ(names[v][0], json["roadmap"]["vertices"][v][0]);
    EXPECT_EQ(names[v][1], json["roadmap"]["vertices"][v][1]);
  }
  write("poses.json", converted.out);
  EXPECT_EQ(run({"solve", "--instance", path("poses.json"), "--quiet"}).code, 0);
}

}  // namespace
}  // namespace quadrille::cli::test
