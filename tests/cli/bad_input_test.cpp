// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;

class BadInputTest : public CliTest {
 protected:
  void expect_refused(const std::vector<std::string>& arguments, const std::string& reason) {
    const Finished finished = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments) + "\n" + finished.err);
    EXPECT_EQ(finished.code, 65);
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.err, HasSubstr(reason));
    // One reason, one line.
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1);
  }
  std::vector<std::string> with_map(const std::string& text) {
    return {"solve",    "--map", write("bad.map", text), "--scen", path("small.scen"),
            "--agents", "3"};
  }
  std::vector<std::string> with_scen(const std::string& rows, const std::string& agents = "2") {
    return {
        "solve",    "--map", path("small.map"), "--scen", write("bad.scen", "version 1\n" + rows),
        "--agents", agents};
  }
};

TEST_F(BadInputTest, FilesThatCannotBeRead) {
  expect_refused(
      {"solve", "--map", path("none.map"), "--scen", path("small.scen"), "--agents", "1"},
      "none.map");
  expect_refused({"solve", "--map", path("small.map"), "--scen", path("none"), "--agents", "1"},
                 "none");
  expect_refused({"solve", "--map", folder_, "--scen", path("small.scen"), "--agents", "1"},
                 folder_.filename());
  expect_refused({"solve", "--instance", path("none.json")}, "none.json");
  expect_refused({"solve", "--instance", path("none")}, "none");
  expect_refused({"solve", "--instance", folder_}, folder_.filename());
  expect_refused(small("verify", {path("none")}), "none");
  expect_refused({"convert", "--map", path("small.map"), "--to", "json", path("none")}, "none");
  expect_refused(small("solve", {"--known-plan", path("none")}), "none");
  expect_refused({"info", "--map", path("none.map")}, "none.map");
  expect_refused({"generate", "--map", path("none.map"), "--scen-output", "-", "--agents", "1"},
                 "none.map");
}

TEST_F(BadInputTest, Maps) {
  expect_refused(with_map(""), "bad.map");
  expect_refused(with_map("type octile\nheight 3\nwidth 4\nmap\n....\n.@@.\n"), "bad.map");
  expect_refused(with_map("type octile\nheight 3\nwidth 4\nmap\n....\n.@@\n....\n"), "bad.map:6");
  expect_refused(with_map("type octile\nheight 3\nwidth 4\nmap\n....\n.@?.\n....\n"), "bad.map:6");
  expect_refused(with_map("type octile\nheight 100000000000\nwidth 100000000000\nmap\n"),
                 "bad.map:2");
  expect_refused(with_map(std::string("\x7f"
                                      "ELF\0\0\1\2\xff\xfe",
                                      10)),
                 "bad.map:1");
  expect_refused(with_map("type octile\nheight 2\nwidth 2\nmap\n..\n..\n"), "small.scen:2");
}

TEST_F(BadInputTest, Scenarios) {
  expect_refused(with_scen("0\tm\t4\t3\t1\t1\t0\t0\t1\n", "1"), "bad.scen:2");  // on an obstacle
  expect_refused(with_scen("0\tm\t4\t3\t0\t0\t1\t1\t1\n", "1"), "bad.scen:2");
  expect_refused(with_scen("0\tm\t4\t3\t4\t0\t0\t0\t1\n", "1"), "bad.scen:2");  // outside
  expect_refused(with_scen("0\tm\t4\t3\t0\t0\t1\t0\t1\n0\tm\t4\t3\t0\t0\t2\t0\t1\n"), "bad.scen:3");
  expect_refused(with_scen("0\tm\t4\t3\t0\t0\t1\t0\t1\n0\tm\t4\t3\t2\t0\t1\t0\t1\n"), "bad.scen:3");
  expect_refused(with_scen("0\tm\t4\t3\t0\t0\t1\t0\t1\n"), "not for 2");        // too few rows
  expect_refused(with_scen("0\tm\t4\t3\t0\t0\t1\n", "1"), "bad.scen:2");        // truncated
  expect_refused(with_scen("0\tm\t4\t3\t0\t0\t1\t0\tx\n", "1"), "bad.scen:2");  // no number
}

TEST_F(BadInputTest, Instances) {
  expect_refused({"solve", "--instance", write("i.json", "{")}, "i.json");
  expect_refused({"solve", "--instance", write("i.json", "{\"quadrille\": \"plan\"}")}, "i.json:1");
  expect_refused({"solve", "--instance", write("i.yaml", "map: [")}, "i.yaml");
  expect_refused({"solve", "--instance",
                  write("i.yaml",
                        "map: {dimensions: [2, 2], obstacles: []}\n"
                        "agents: [{name: a, start: [0, 0], goal: [5, 0]}]\n")},
                 "i.yaml:2");
  expect_refused({"info", "--instance", write("noname", "{}")}, "noname");
}

TEST_F(BadInputTest, Plans) {
  expect_refused(small("verify", {write("p", R"({"status": "unknown", "plan": null})")}),
                 "there is no plan");
  expect_refused(small("verify", {write("p", "{}")}), "p:1");
  expect_refused(small("verify", {write("p", "Agent 0: (0,0)->(1,1)->\n")}), "p:1");
  expect_refused(small("verify", {"--plan-format", "visualizer", write("p", "{}")}), "p:1");
  // A known plan has to be one.
  expect_refused(small("solve", {"--known-plan", write("p", "Agent 0: (0,0)->(0,1)->\n")}),
                 "not a valid plan");
}

TEST_F(BadInputTest, AFormatThatNeedsAGridIsRefusedBeforeTheSearch) {
  const std::string graph =
      write("g.json",
            "{\"quadrille\": \"instance\", \"version\": 1, \"graph\": {\"vertices\": 3, "
            "\"edges\": [[0, 1], [1, 2]]}, \"agents\": [{\"start\": 0, \"goal\": 2}]}");
  EXPECT_EQ(run({"solve", "--instance", graph}).code, 0) << run({"solve", "--instance", graph}).err;
  expect_refused({"solve", "--instance", graph, "--plan", path("p"), "--plan-format", "cbsh2"},
                 "grid");
  EXPECT_FALSE(exists("p"));
}

TEST_F(BadInputTest, NothingIsWrittenForBadInput) {
  write("old.json", "old");
  EXPECT_EQ(run({"solve", "--map", path("none"), "--scen", path("small.scen"), "--agents", "1",
                 "--json", path("old.json"), "--plan", path("new")})
                .code,
            65);
  EXPECT_EQ(read("old.json"), "old");
  EXPECT_FALSE(exists("new"));
}

TEST_F(BadInputTest, GraphsThatAreTooLargeForTheSolver) {
  expect_refused({"solve", "--instance", write("large.json", R"({"quadrille": "instance",
    "version": 1, "graph": {"vertices": 8388609, "edges": []},
    "agents": [{"start": 0, "goal": 0}]})"),
                  "--quiet"},
                 "/graph/vertices: 8388609 is not between 0 and 8388608");
}

}  // namespace
}  // namespace quadrille::cli::test
