// SPDX-License-Identifier: MIT
//
// Files that people bring, given to the program: each is read, or called by its name.
#include <gmock/gmock.h>

#include "cli/process.hpp"
#include "formats/plan_samples.hpp"
#include "formats/samples.hpp"

namespace quadrille::cli::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Words = std::vector<std::string>;

class BroughtTest : public CliTest {
 protected:
  BroughtTest() {
    write("m.map", "type octile\nheight 3\nwidth 4\nmap\n@.@@\n....\n@..@\n");
    write("m.scen", "version 1\n0\tm.map\t4\t3\t1\t0\t1\t2\t0\n0\tm.map\t4\t3\t0\t1\t3\t1\t0\n");
  }
  [[nodiscard]] Words grid(const std::string& command, const Words& more) const {
    return Words{command, "--map", path("m.map"), "--scen", path("m.scen"), "--agents", "2"} + more;
  }
};

TEST_F(BroughtTest, PlansOnGrids) {
  for (const std::string& text :
       {formats::kLns2, formats::kLacam, formats::kPlanViz, formats::kTracker, formats::kAtb033}) {
    const Finished finished = run(grid("verify", {write("plan", text)}));
    EXPECT_EQ(finished.code, 0) << text << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("6"));
    EXPECT_EQ(run(grid("view", {"--output", path("page.html"), path("plan")})).code, 0) << text;
  }
  // What a file states is checked.
  std::string wrong = formats::kLacam;
  wrong.replace(wrong.find("soc=6"), 5, "soc=5");
  EXPECT_EQ(run(grid("verify", {write("wrong", wrong)})).code, 1);
}

TEST_F(BroughtTest, PlansAlone) {
  const std::string plan = write("plan", "0:(1,0),(0,1),\n1:(1,1),(0,1),\n2:(1,2),(1,1),\n");
  const Finished finished = run({"verify", "--map", path("m.map"), plan});
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("agents     2 from " + plan));
  EXPECT_EQ(run({"view", "--map", path("m.map"), "--output", path("page.html"), plan}).code, 0);
  EXPECT_TRUE(exists("page.html"));
  const std::string collision = write("bad", "0:(1,0),(0,1),\n1:(1,1),(1,1),\n2:(1,2),(1,1),\n");
  EXPECT_EQ(run({"verify", "--map", path("m.map"), collision}).code, 1);
  const Finished same =
      run({"verify", "--map", path("m.map"), write("same", "0:(1,0),(1,0),\n1:(1,1),(1,0),\n")});
  EXPECT_EQ(same.code, 65);
  EXPECT_THAT(same.err, HasSubstr("same: agents 0 and 1 have the same start"));
  // Agents without a scenario are a mistake, as is a solve without agents.
  EXPECT_EQ(run({"verify", "--map", path("m.map"), "--agents", "2", plan}).code, 64);
  EXPECT_EQ(run({"solve", "--map", path("m.map")}).code, 64);
}

TEST_F(BroughtTest, RoadmapsOfAllKinds) {
  const std::string task =
      write("task.xml", "<root><agent start_id=\"A\" goal_id=\"dock\"/></root>");
  const Finished lif =
      run({"solve", "--roadmap", write("lif", formats::kLif), "--task", task, "--radius", "0.2"});
  EXPECT_EQ(lif.code, 0) << lif.err;
  EXPECT_THAT(lif.out, HasSubstr("5.5"));  // 4 at half speed, then 1.5
  EXPECT_THAT(lif.out, HasSubstr("note       'trajectory' of an edge is not used (1 time)\n"));
  for (const std::string& text : {formats::kRouteGraph, formats::kNetworkx, formats::kOmplInSpace,
                                  formats::kYed, formats::kGml}) {
    const Finished finished = run({"info", "--roadmap", write("roadmap", text)});
    EXPECT_EQ(finished.code, 0) << text << finished.err;
  }
  const std::string nav = write("nav", formats::kNavGraph);
  EXPECT_THAT(run({"info", "--roadmap", nav}).err, HasSubstr("--level says which is meant"));
  EXPECT_THAT(run({"info", "--roadmap", nav, "--level", "L1"}).out,
              HasSubstr("3 vertices, 3 edges"));
  // A roadmap with names becomes one in our own JSON.
  EXPECT_EQ(run({"convert", "--roadmap", path("lif"), "--task", task, "--radius", "0.2", "--to",
                 "json", "--output", path("own.json")})
                .code,
            0);
  EXPECT_THAT(read("own.json"), HasSubstr("\"A\""));
}

TEST_F(BroughtTest, EachFileIsCalledByItsNameWhereverItIsGiven) {
  const std::string lif = write("lif", formats::kLif);
  const std::string words = "lif:1: this is a layout in VDMA's LIF: it belongs to --roadmap";
  for (const Words& arguments :
       {Words{"info", "--map", lif}, Words{"info", "--instance", lif},
        Words{"info", "--map", path("m.map"), "--scen", lif},
        Words{"solve", "--roadmap", path("m.map"), "--task", lif}, grid("verify", {lif})}) {
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.code, 65);
    EXPECT_THAT(finished.err, HasSubstr(words)) << ::testing::PrintToString(arguments);
  }
  for (const char* const text : {"hello\n", "{}", "a: b\n", "1 2 3\n"}) {
    const Finished finished = run({"info", "--roadmap", write("odd", text)});
    EXPECT_EQ(finished.code, 65);
    EXPECT_THAT(finished.err, Not(HasSubstr("not well-formed XML"))) << text;
  }
}

TEST_F(BroughtTest, ByteOrderMarksAreNoPartOfTheText) {
  const std::string mark = "\xEF\xBB\xBF";
  const std::string task =
      write("task.xml", mark + "<root><agent start_id=\"A\" goal_id=\"C\"/></root>");
  EXPECT_EQ(run({"solve", "--roadmap", write("lif", mark + formats::kLif), "--task", task,
                 "--radius", "0.2"})
                .code,
            0);
  EXPECT_EQ(run(grid("verify", {write("plan", mark + formats::kTracker)})).code, 0);
  EXPECT_THAT(run({"info", "--map", write("utf16", "\xFF\xFEt")}).err, HasSubstr("UTF-16"));
}

TEST_F(BroughtTest, RoadmapsOfLibMultiRobotPlanning) {
  const Finished finished = run({"solve", "--instance", write("r.yaml", formats::kLibmrpRoadmap)});
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("optimal"));
}

TEST_F(BroughtTest, CollisionsHaveTheirMomentsOfContact) {
  // Two discs of radius 1 meet head on: 10 apart, they close in at 2 and touch after 4.
  const std::string instance = write("i.json", R"({"quadrille": "instance", "version": 1,
    "resolution": 0.001, "roadmap": {"vertices": [[0, 0], [10, 0]], "edges": [[0, 1], [1, 0]]},
    "agents": [{"start": 0, "goal": 1, "radius": 1}, {"start": 1, "goal": 0, "radius": 1}]})");
  const std::string plan = write("p.json", R"({"quadrille": "plan", "version": 1,
    "resolution": 0.001, "plan": [
    [{"vertex": 0, "arrive_ticks": 0, "depart_ticks": 0}, {"vertex": 1, "arrive_ticks": 10000}],
    [{"vertex": 1, "arrive_ticks": 0, "depart_ticks": 0}, {"vertex": 0, "arrive_ticks": 10000}]]})");
  const Finished finished =
      run({"verify", "--instance", instance, "--json", path("verdict.json"), plan});
  EXPECT_EQ(finished.code, 1) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("collide between times 4 and 6: nearest at about 5"));
  EXPECT_THAT(read("verdict.json"), HasSubstr("\"tick\":4000"));
}

}  // namespace
}  // namespace quadrille::cli::test
