// SPDX-License-Identifier: MIT
#include "quadrille/discrete/movingai.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "discrete/formats/io_support.hpp"

namespace quadrille::discrete {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Result<GridMap> map_of(const std::string& rows, const MapOptions& options = {}) {
  const auto width = rows.find('\n');
  const auto height = std::count(rows.begin(), rows.end(), '\n');
  std::istringstream in("type octile\nheight " + std::to_string(height) + "\nwidth " +
                        std::to_string(width) + "\nmap\n" + rows);
  return read_map(in, "test.map", options);
}

TEST(MovingAiMap, ReadsCellsRowByRow) {
  const GridMap map = read_map(testing::data("valid/small.map")).value();
  EXPECT_EQ(map.width, 4);
  EXPECT_EQ(map.height, 3);
  EXPECT_EQ(map.num_passable(), 10);
  EXPECT_FALSE(map.is_passable({1, 1}));
  EXPECT_FALSE(map.is_passable({2, 1}));
  EXPECT_TRUE(map.is_passable({3, 1}));
  EXPECT_TRUE(map.other_letters.empty());
  EXPECT_EQ(map.graph().layout()->vertex_at({0, 2}), VertexId(6));
}

TEST(MovingAiMap, LineEndsMakeNoDifference) {
  const GridMap map = read_map(testing::data("valid/small.map")).value();
  EXPECT_EQ(read_map(testing::data("valid/small-crlf.map")).value(), map);
  EXPECT_EQ(read_map(testing::data("valid/no-last-newline.map")).value(), map);
  EXPECT_EQ(read_map(testing::data("valid/trailing-empty-line.map")).value(), map);
}

TEST(MovingAiMap, ReportsUnusualLettersByLetter) {
  const GridMap map = map_of(".GO\nG@T\n").value();
  EXPECT_THAT(map.other_letters,
              ElementsAre(LetterCount{'G', true, 2}, LetterCount{'O', false, 1}));
  EXPECT_EQ(map.num_passable(), 3);
}

TEST(MovingAiMap, OptionsNameLetters) {
  EXPECT_FALSE(map_of(".S\n").has_value());
  EXPECT_FALSE(map_of(".W\n").has_value());
  EXPECT_FALSE(map_of(".x\n").has_value());
  EXPECT_EQ(map_of("S.W\n", {"S", "W"}).value().passable, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(map_of("T.G\n", {"T", "G"}).value().passable, (std::vector<bool>{true, true, false}));
  EXPECT_THAT(map_of("S\n", {"S", ""}).value().other_letters,
              ElementsAre(LetterCount{'S', true, 1}));
}

TEST(MovingAiMap, RefusesContradictoryOptions) {
  for (const MapOptions& options :
       {MapOptions{"S", "S"}, MapOptions{"\n", ""}, MapOptions{"", " "}, MapOptions{"\xe9", ""}}) {
    const auto map = map_of(".\n", options);
    ASSERT_FALSE(map.has_value());
    EXPECT_EQ(map.error().code, ErrorCode::out_of_range);
  }
}

TEST(MovingAiMap, ReadsFromAPipe) {
  const std::string name = ::testing::TempDir() + "quadrille_pipe_" + std::to_string(getpid());
  ASSERT_EQ(mkfifo(name.c_str(), 0600), 0);
  std::thread writer(
      [&] { std::ofstream(name) << testing::text_of(testing::data("valid/small.map")); });
  const auto map = read_map(std::filesystem::path(name));
  writer.join();
  unlink(name.c_str());
  ASSERT_TRUE(map.has_value()) << map.error().to_string();
  EXPECT_EQ(*map, read_map(testing::data("valid/small.map")).value());
}

TEST(MovingAiMap, AFailedStreamIsAnIoError) {
  std::istringstream in("type octile\n");
  in.setstate(std::ios::badbit);
  EXPECT_EQ(read_map(in, "test.map").error().code, ErrorCode::io);
}

TEST(MovingAiMap, WhatIsWrittenIsReadBack) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto side = static_cast<std::int32_t>(1 + seed % 9);
    const GridMap map = random_map(side, 10 - side, 0.4, seed).value();
    std::stringstream file;
    ASSERT_EQ(write_map(file, "out", map), std::nullopt);
    const auto again = read_map(file, "out");
    ASSERT_TRUE(again.has_value()) << again.error().to_string();
    EXPECT_EQ(*again, map);
  }
}

TEST(MovingAiMap, WritersReportAFullDisk) {
  const GridMap map = empty_map(3, 3).value();
  testing::expect_reports_full_disk([&](std::ostream& out) { return write_map(out, "out", map); });
  testing::expect_reports_full_disk([&](std::ostream& out) {
    return write_scenario(out, "out", random_scenario(map, 3, 1).value());
  });
}

TEST(MovingAiScenario, ReadsEveryField) {
  const Scenario scenario = read_scenario(testing::data("valid/small.scen")).value();
  ASSERT_EQ(scenario.rows.size(), 3u);
  const ScenarioRow& row = scenario.rows[1];
  EXPECT_EQ(row.map, "small.map");
  EXPECT_EQ(row.bucket, 0);
  EXPECT_EQ(row.width, 4);
  EXPECT_EQ(row.height, 3);
  EXPECT_EQ(row.start, (Cell{3, 0}));
  EXPECT_EQ(row.goal, (Cell{0, 0}));
  EXPECT_EQ(row.optimal, 3);
  EXPECT_EQ(row.line, 3);
}

TEST(MovingAiScenario, SeparatorsVersionAndLineEndsMakeNoDifference) {
  const auto graph =
      std::make_shared<const Graph>(read_map(testing::data("valid/small.map")).value().graph());
  const auto instance_of = [&](const char* name, std::size_t agents) {
    return make_instance(graph, read_scenario(testing::data(name)).value(), agents).value();
  };
  const Instance instance = instance_of("valid/small.scen", 3);
  EXPECT_EQ(instance.num_agents(), 3u);
  EXPECT_EQ(instance.agents()[AgentId(2)].goal(), *graph->layout()->vertex_at({3, 2}));
  EXPECT_TRUE(testing::equal(instance_of("valid/small-crlf.scen", 3), instance));
  EXPECT_TRUE(testing::equal(instance_of("valid/blanks.scen", 3), instance));
  EXPECT_EQ(instance_of("valid/small.scen", 0).num_agents(), 0u);
}

TEST(MovingAiScenario, ChecksCellsOfTheChosenRowsOnly) {
  const auto graph =
      std::make_shared<const Graph>(read_map(testing::data("valid/small.map")).value().graph());
  const auto scenario = read_scenario(testing::data("malformed/blocked-start.scen"));
  ASSERT_TRUE(scenario.has_value());
  EXPECT_TRUE(make_instance(graph, *scenario, 1).has_value());
  EXPECT_FALSE(make_instance(graph, *scenario, 2).has_value());
}

TEST(MovingAiScenario, GeneratedRowsHaveNoLinesInMessages) {
  const GridMap map = empty_map(2, 1).value();
  Scenario scenario = random_scenario(map, 2, 0).value();
  scenario.rows[1].start = scenario.rows[0].start;
  const auto graph = std::make_shared<const Graph>(map.graph());
  const auto error = make_instance(graph, scenario, 2).error();
  EXPECT_THAT(error.to_string(), ::testing::StartsWith("agents 0 and 1 have the same start ("));
  EXPECT_THAT(error.message, ::testing::Not(HasSubstr("line")));
}

TEST(MovingAiScenario, WhatIsWrittenIsReadBack) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const GridMap map = random_map(8, 6, 0.3, seed).value();
    const Scenario scenario = random_scenario(map, 10, seed).value();
    std::stringstream file;
    ASSERT_EQ(write_scenario(file, "out", scenario), std::nullopt);
    const auto again = read_scenario(file, "out");
    ASSERT_TRUE(again.has_value()) << again.error().to_string();
    ASSERT_EQ(again->rows.size(), scenario.rows.size());
    for (std::size_t i = 0; i < scenario.rows.size(); ++i) {
      const ScenarioRow &a = scenario.rows[i], &b = again->rows[i];
      EXPECT_EQ(std::tie(a.bucket, a.map, a.width, a.height, a.start, a.goal),
                std::tie(b.bucket, b.map, b.width, b.height, b.start, b.goal));
      EXPECT_NEAR(a.optimal, b.optimal, 0.5e-8);
      EXPECT_EQ(b.line, static_cast<long>(i) + 2);
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete
