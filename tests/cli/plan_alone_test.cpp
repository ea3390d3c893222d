// SPDX-License-Identifier: MIT
//
// Roadmaps and plans alone: the plan says where its agents begin and end.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;

class PlanAloneTest : public RoadmapCliTest {
 protected:
  PlanAloneTest() {
    EXPECT_EQ(run(xml("solve", {"--quiet", "--plan", path("plan.json")})).code, 0);
  }
  /// With the roadmap of `xml`.
  [[nodiscard]] Finished alone(const std::string& command, const std::vector<std::string>& more,
                               const std::string& radius = "0.3") const {
    return run(std::vector<std::string>{command, "--roadmap", path("map.xml"), "--radius", radius} +
               more);
  }
};

TEST_F(PlanAloneTest, IsVerifiedAndShownAsWithItsTask) {
  const Finished verified = alone("verify", {path("plan.json")});
  EXPECT_EQ(verified.code, 0) << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("agents     2 from " + path("plan.json") + ", radius 0.3"));
  EXPECT_THAT(verified.out, HasSubstr("no violations"));
  EXPECT_EQ(alone("verify", {"--check-with", "fcl", "--quiet", path("plan.json")}).code, 0);

  ASSERT_EQ(run(xml("view",
                    {"--output", path("task.html"), "--svg", path("task.svg"), path("plan.json")}))
                .code,
            0);
  const Finished viewed = alone(
      "view", {"--output", path("alone.html"), "--svg", path("alone.svg"), path("plan.json")});
  ASSERT_EQ(viewed.code, 0) << viewed.err;
  EXPECT_EQ(read("alone.html"), read("task.html"));
  EXPECT_EQ(read("alone.svg"), read("task.svg"));
}

TEST_F(PlanAloneTest, LogsOfCcbsAreReadAsWithTheirTask) {
  ASSERT_EQ(
      run(xml("convert", {"--to", "ccbs", "--output", path("log.xml"), path("plan.json")})).code,
      0);
  const Finished verified = alone("verify", {path("log.xml")});
  EXPECT_EQ(verified.code, 0) << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("agents     2 from " + path("log.xml")));
  EXPECT_THAT(verified.out, HasSubstr("no violations"));
  EXPECT_EQ(alone("view", {"--output", path("log.html"), path("log.xml")}).code, 0);
  EXPECT_TRUE(exists("log.html"));
  EXPECT_EQ(alone("verify", {path("log.xml")}, "0.6").code, 1);
  // As CCBS writes it: places instead of vertices.
  std::string places = read("log.xml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = places.find(from); at != std::string::npos; at = places.find(from))
      places.replace(at, from.size(), to);
  };
  for (const std::string end : {"start", "goal"}) {
    const char* const xy[] = {"0\"%_j=\"0", "2\"%_j=\"0", "1\"%_j=\"-1", "1\"%_j=\"1"};
    for (int v = 0; v < 4; ++v) {
      std::string at = xy[v];
      at.replace(at.find('%'), 1, " " + end);
      replace(end + "_id=\"" + std::to_string(v) + "\"", end + "_i=\"" + at + "\"");
    }
  }
  write("places.xml", places);
  EXPECT_EQ(alone("verify", {path("places.xml")}).code, 0)
      << alone("verify", {path("places.xml")}).err;
}

TEST_F(PlanAloneTest, BreaksRulesAsWithItsTask) {
  // Where discs of radius 0.3 pass each other, larger ones collide.
  const Finished large = alone("verify", {path("plan.json")}, "0.6");
  EXPECT_EQ(large.code, 1) << large.err;
  EXPECT_THAT(large.out, HasSubstr("collide"));
  // They cannot even begin there.
  const Finished overlapping = alone("verify", {path("plan.json")}, "0.9");
  EXPECT_EQ(overlapping.code, 65);
  EXPECT_THAT(overlapping.err, HasSubstr("plan.json: "));
  EXPECT_THAT(overlapping.err, HasSubstr("overlap"));
  EXPECT_EQ(alone("view", {"--output", path("x.html"), path("plan.json")}, "0.9").code, 65);
  EXPECT_FALSE(exists("x.html"));
  // Slower than the plan says.
  EXPECT_EQ(alone("verify", {"--speed", "0.5", path("plan.json")}).code, 1);
}

TEST_F(PlanAloneTest, MayBeginLater) {
  write("late.json", R"({"quadrille": "plan", "version": 1, "resolution": 0.000001, "plan": [[
    {"vertex": 0, "arrive_ticks": 5000000, "depart_ticks": 5000000},
    {"vertex": 1, "arrive_ticks": 7000000}]]})");
  const Finished verified = alone("verify", {path("late.json")});
  EXPECT_EQ(verified.code, 0) << verified.err << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("sum of costs 2"));
}

TEST_F(PlanAloneTest, OfRobotsThatTurn) {
  ASSERT_EQ(run(small("solve", {"--headings", "4", "--quiet", "--plan", path("poses.json")})).code,
            0);
  const std::vector<std::string> map{"--map", path("small.map"), "--headings", "4"};
  const Finished verified =
      run(std::vector<std::string>{"verify"} + map + std::vector<std::string>{path("poses.json")});
  EXPECT_EQ(verified.code, 0) << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("no violations"));
  EXPECT_EQ(run(std::vector<std::string>{"view", "--output", path("poses.html")} + map +
                std::vector<std::string>{path("poses.json")})
                .code,
            0);
  EXPECT_EQ(run(std::vector<std::string>{"verify", "--turn", "2"} + map +
                std::vector<std::string>{path("poses.json")})
                .code,
            1);
}

TEST_F(PlanAloneTest, NothingElseDoesWithoutTheTask) {
  const auto refuses = [](const Finished& finished, int code, const std::string& why) {
    EXPECT_EQ(finished.code, code);
    EXPECT_THAT(finished.err, HasSubstr(why));
  };
  refuses(alone("verify", {"--agents", "2", path("plan.json")}), 64, "--task is missing");
  refuses(alone("solve", {}), 64, "--task is missing");
  refuses(alone("execute-check", {path("plan.json")}), 64, "--task is missing");
  refuses(alone("export", {"--to", "csv", path("plan.json")}), 64, "--task is missing");
  refuses(alone("view", {path("none")}), 65, "none");
}

}  // namespace
}  // namespace quadrille::cli::test
