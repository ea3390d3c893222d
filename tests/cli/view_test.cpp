// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "cli/roadmap_support.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using ViewTest = CliTest;
using RoadmapViewTest = RoadmapCliTest;

/// The data of a page, as it holds them.
nlohmann::json data_of(const std::string& page) {
  const std::string begin = R"(<script type="application/json" id="data">)";
  const auto from = page.find(begin);
  EXPECT_NE(from, std::string::npos);
  if (from == std::string::npos) return {};
  const auto at = from + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST_F(ViewTest, SolveAndViewMakeThePageOfEachFormat) {
  ASSERT_EQ(
      run(small("solve", {"--quiet", "--plan", path("p.json"), "--view", path("s.html")})).code, 0);
  const auto solved = data_of(read("s.html"));
  EXPECT_EQ(solved["status"], "optimal");
  EXPECT_EQ(solved["sumOfCosts"], 8);
  EXPECT_EQ(solved["agents"].size(), 3u);
  for (const char* format : {"json", "cbsh2", "lns2", "visualizer", "lacam", "yaml"}) {
    SCOPED_TRACE(format);
    ASSERT_EQ(run(small("convert", {"--to", format, "--output", path("p"), path("p.json")})).code,
              0);
    const Finished shown = run(small("view", {path("p")}));
    EXPECT_EQ(shown.code, 0) << shown.err;
    EXPECT_THAT(shown.out, StartsWith("<!DOCTYPE html>"));
    EXPECT_EQ(data_of(shown.out)["agents"], solved["agents"]);
  }
}

TEST_F(ViewTest, APlanWithViolationsIsShownWithThem) {
  ASSERT_EQ(run(corridor("solve", {"--quiet"})).code, 20);
  const std::string plan = write("bad.txt",
                                 "Agent 0: (0,0)->(0,1)->(0,2)->\n"
                                 "Agent 1: (0,2)->(0,1)->(0,0)->\n");
  const Finished judged = run(corridor("verify", {plan}));
  ASSERT_EQ(judged.code, 1) << judged.out << judged.err;
  const Finished shown = run(corridor("view", {plan}));
  EXPECT_EQ(shown.code, 0) << shown.err;
  const auto violations = data_of(shown.out)["violations"];
  ASSERT_FALSE(violations.empty());
  for (const auto& violation : violations)
    EXPECT_THAT(judged.out, HasSubstr(violation["message"].get<std::string>()));
}

TEST_F(ViewTest, WithoutAPlanNothingIsWritten) {
  const Finished none =
      run(small("solve", {"--time-limit", "0", "--view", path("v.html"), "--svg", path("v.svg")}));
  EXPECT_EQ(none.code, 30);
  EXPECT_THAT(none.out, HasSubstr("v.html is not written"));
  EXPECT_FALSE(exists("v.html"));
  EXPECT_FALSE(exists("v.svg"));
  const Finished broken = run(small("view", {"--output", path("v.html"), write("p", "Agent x")}));
  EXPECT_EQ(broken.code, 65);
  EXPECT_THAT(broken.err, HasSubstr("/p:1: "));
  EXPECT_FALSE(exists("v.html"));
}

TEST_F(ViewTest, IfThereIsNoPlanThePageSaysWhy) {
  const Finished none = run(corridor("solve", {"--view", path("v.html"), "--svg", path("v.svg")}));
  EXPECT_EQ(none.code, 20);
  EXPECT_THAT(none.out, HasSubstr("v.svg is not written"));
  EXPECT_FALSE(exists("v.svg"));
  EXPECT_THAT(read("v.html"), HasSubstr("cannot pass each other"));
}

TEST_F(ViewTest, AnOutputThatFailsIs74) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  EXPECT_EQ(run(small("solve", {"--view", "/dev/full"})).code, 74);
  EXPECT_EQ(run(small("solve", {"--svg", "/dev/full"})).code, 74);
  EXPECT_EQ(run(small("view", {"--output", "/dev/full", path("p.json")})).code, 74);
  EXPECT_EQ(run(small("view", {"--svg", "/dev/full", path("p.json")})).code, 74);
}

TEST_F(ViewTest, PicturesAreSvg) {
  for (const char* kind : {"map", "space-time", "waits"}) {
    SCOPED_TRACE(kind);
    const Finished drawn =
        run(small("solve", {"--quiet", "--svg", "-", "--svg-kind", kind, "--svg-agents", "2,0"}));
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_THAT(drawn.out, StartsWith("<svg xmlns="));
    EXPECT_THAT(drawn.out, HasSubstr("</svg>\n"));
    // Numbers of those who are drawn, and of nobody else.
    EXPECT_THAT(drawn.out, HasSubstr(">2</text>"));
    if (std::string(kind) == "map") {
      EXPECT_THAT(drawn.out, Not(HasSubstr(">1</text>")));
    }
  }
  const Finished unknown = run(small("solve", {"--svg", path("x.svg"), "--svg-agents", "0,3"}));
  EXPECT_EQ(unknown.code, 65);
  EXPECT_THAT(unknown.err, HasSubstr("--svg-agents names agent 3, but there are 3 agents"));
  EXPECT_FALSE(exists("x.svg"));
}

TEST_F(ViewTest, TheSameInputGivesTheSameBytes) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  for (const char* output : {"--output", "--svg"}) {
    const Finished one = run(small("view", {output, "-", path("p.json")}));
    const Finished two = run(small("view", {output, "-", path("p.json")}));
    EXPECT_EQ(one.code, 0);
    EXPECT_FALSE(one.out.empty());
    EXPECT_EQ(one.out, two.out);
  }
}

TEST_F(RoadmapViewTest, RoadmapsInBothFormats) {
  ASSERT_EQ(
      run(discs("solve", {"--quiet", "--plan", path("p.json"), "--view", path("s.html")})).code, 0);
  const auto solved = data_of(read("s.html"));
  EXPECT_EQ(solved["continuous"], true);
  EXPECT_EQ(solved["agents"].size(), solved["nearest"].size() + 1);  // two
  ASSERT_EQ(run(discs("convert", {"--to", "ccbs", "--output", path("p.xml"), path("p.json")})).code,
            0);
  for (const char* plan : {"p.json", "p.xml"}) {
    const Finished shown = run(discs("view", {path(plan)}));
    EXPECT_EQ(shown.code, 0) << shown.err;
    EXPECT_EQ(data_of(shown.out)["agents"], solved["agents"]);
  }
  const Finished drawn = run(discs("view", {"--svg", "-", path("p.json")}));
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_THAT(drawn.out, StartsWith("<svg xmlns="));
}

}  // namespace
}  // namespace quadrille::cli::test
