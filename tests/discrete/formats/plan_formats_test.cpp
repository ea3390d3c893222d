// SPDX-License-Identifier: MIT
#include "quadrille/discrete/plan_formats.hpp"

#include "discrete/formats/io_support.hpp"

namespace quadrille::discrete {
namespace {

Graph small_graph() { return read_map(testing::data("valid/small.map")).value().graph(); }

Plan small_plan() {
  const Graph graph = small_graph();
  const auto at = [&](std::int32_t x, std::int32_t y) {
    return *graph.layout()->vertex_at({x, y});
  };
  return Plan{{Path{at(0, 0), at(1, 0)}, Path{at(3, 0), at(3, 1)}}};
}

std::string written(const Graph& graph, const Plan& plan, PlanFormat format) {
  std::ostringstream out;
  EXPECT_EQ(write_plan(out, "out", graph, plan, format), std::nullopt);
  return out.str();
}

TEST(PlanFormats, HaveNames) {
  for (const PlanFormat format : kPlanFormats)
    EXPECT_EQ(parse_plan_format(to_string(format)), format);
  EXPECT_EQ(parse_plan_format("JSON"), std::nullopt);
}

TEST(PlanFormats, AreRecognisedByTheirFirstCharacters) {
  EXPECT_EQ(detect_plan_format("\r\n {\"plan\": []}"), PlanFormat::json);
  EXPECT_EQ(detect_plan_format("0:(1,2),"), PlanFormat::visualizer);
  EXPECT_EQ(detect_plan_format("Agent 0: "), PlanFormat::cbsh2);
  EXPECT_EQ(detect_plan_format("schedule:"), PlanFormat::yaml);
  EXPECT_EQ(detect_plan_format(""), PlanFormat::yaml);
  EXPECT_EQ(plan_format_of("a/b.json"), PlanFormat::json);
  EXPECT_EQ(plan_format_of("b.yml"), PlanFormat::yaml);
  EXPECT_EQ(plan_format_of("b.txt"), std::nullopt);
}

TEST(PlanFormats, OneCanBeReadAsAnother) {
  for (const auto& [from, to] : {std::pair(PlanFormat::cbsh2, PlanFormat::lns2),
                                 std::pair(PlanFormat::lns2, PlanFormat::cbsh2),
                                 std::pair(PlanFormat::lacam, PlanFormat::visualizer)}) {
    std::istringstream in(written(small_graph(), small_plan(), from));
    const auto again = read_plan(in, "f", small_graph(), to);
    ASSERT_TRUE(again.has_value()) << again.error().to_string();
    EXPECT_EQ(again->plan, small_plan());
  }
  // A result has a header.
  std::istringstream in(written(small_graph(), small_plan(), PlanFormat::visualizer));
  EXPECT_FALSE(read_plan(in, "f", small_graph(), PlanFormat::lacam).has_value());
  EXPECT_EQ(detect_plan_format(written(small_graph(), small_plan(), PlanFormat::lacam)),
            PlanFormat::lacam);
}

TEST(PlanFormats, APlanForNoAgentsIsReadBack) {
  for (const PlanFormat format : kPlanFormats) {
    const std::string text = written(small_graph(), {}, format);
    EXPECT_FALSE(text.empty());
    for (const std::optional<PlanFormat> named :
         {std::optional(format), std::optional<PlanFormat>()}) {
      std::istringstream in(text);
      const auto again = read_plan(in, "f", small_graph(), named);
      ASSERT_TRUE(again.has_value()) << to_string(format) << ": " << again.error().to_string();
      EXPECT_TRUE(again->plan.paths.empty());
    }
  }
  // A file that could not be written is no plan.
  std::istringstream in("");
  EXPECT_FALSE(read_plan(in, "f", small_graph()).has_value());
}

TEST(PlanFormats, AllFilesStateTheSamePlan) {
  for (const char* name :
       {"plan.json", "result.json", "plan.cbsh2", "plan.visualizer", "plan.yaml"}) {
    const auto file = read_plan(testing::data(std::string("valid/") + name), small_graph());
    ASSERT_TRUE(file.has_value()) << file.error().to_string();
    EXPECT_EQ(file->plan, small_plan()) << name;
  }
}

TEST(PlanFormats, StatedCostsAreHandedOn) {
  const auto plan = read_plan(testing::data("valid/plan.json"), small_graph()).value();
  EXPECT_EQ(plan.stated.sum_of_costs, 2);
  EXPECT_EQ(plan.stated.makespan, std::nullopt);
  const auto result = read_plan(testing::data("valid/result.json"), small_graph()).value();
  EXPECT_EQ(result.stated.sum_of_costs, std::nullopt);
  EXPECT_EQ(result.stated.makespan, 1);
  EXPECT_EQ(result.stated.status, Status::optimal);
  EXPECT_EQ(result.stated.lower_bound, 1);
  EXPECT_EQ(result.stated.objective, Objective::makespan);
  const auto yaml = read_plan(testing::data("valid/plan.yaml"), small_graph()).value();
  EXPECT_EQ(yaml.stated.sum_of_costs, 2);
  EXPECT_EQ(yaml.stated.makespan, 1);
}

TEST(PlanFormats, AnExplicitFormatWins) {
  const auto file =
      read_plan(testing::data("valid/plan.cbsh2"), small_graph(), PlanFormat::visualizer);
  ASSERT_FALSE(file.has_value());
  EXPECT_EQ(file.error().where.line, 1);
}

TEST(PlanFormats, AreWrittenAsDocumented) {
  const Graph graph = small_graph();
  EXPECT_EQ(written(graph, small_plan(), PlanFormat::cbsh2),
            testing::text_of(testing::data("valid/plan.cbsh2")));
  EXPECT_EQ(written(graph, small_plan(), PlanFormat::visualizer),
            testing::text_of(testing::data("valid/plan.visualizer")));
  EXPECT_EQ(written(graph, small_plan(), PlanFormat::lns2),
            "Agent 0:(0,0)->(0,1)->\nAgent 1:(0,3)->(1,3)->\n");
  EXPECT_EQ(written(graph, small_plan(), PlanFormat::lacam),
            "agents=2\nsolver=quadrille\nsolved=1\nsoc=2\nmakespan=1\n"
            "starts=(0,0),(3,0),\ngoals=(1,0),(3,1),\nsolution=\n" +
                testing::text_of(testing::data("valid/plan.visualizer")));
  EXPECT_EQ(written(graph, small_plan(), PlanFormat::json),
            testing::text_of(testing::data("valid/plan.json")));
  EXPECT_EQ(written(graph, {{Path{VertexId(1)}}}, PlanFormat::yaml),
            "statistics:\n  cost: 0\n  makespan: 0\nschedule:\n"
            "  agent0:\n    - x: 1\n      y: 0\n      t: 0\n");
  EXPECT_EQ(plan_to_json(graph, small_plan()), "[[[0, 0], [1, 0]], [[3, 0], [3, 1]]]");
}

TEST(PlanFormats, WhatIsWrittenIsReadBack) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Graph graph =
        seed % 4 == 0 ? Graph::make(5, {}).value() : random_map(5, 4, 0.3, seed).value().graph();
    const Plan plan = testing::random_plan(graph, seed % 5, seed);
    for (const PlanFormat format : kPlanFormats) {
      const bool has_header = format == PlanFormat::lacam;
      const bool is_stretched = has_header || format == PlanFormat::visualizer;
      const bool lines = format != PlanFormat::json && format != PlanFormat::yaml;
      std::stringstream file;
      const auto error = write_plan(file, "out", graph, plan, format);
      if (lines && !graph.layout()) {
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->code, ErrorCode::invalid_plan);
        continue;
      }
      ASSERT_EQ(error, std::nullopt);
      auto again = read_plan(file, "out", graph, format);
      ASSERT_TRUE(again.has_value()) << again.error().to_string() << '\n' << file.str();
      Plan expected = plan;
      if (is_stretched) {
        trim(expected);
        trim(again.value().plan);
      }
      EXPECT_EQ(again->plan, expected) << file.str();
      if (has_header || !lines) {
        EXPECT_EQ(again->stated.sum_of_costs, plan.cost(Objective::sum_of_costs));
      }
      if (has_header || format == PlanFormat::yaml) {
        EXPECT_EQ(again->stated.makespan, plan.cost(Objective::makespan));
      }
    }
  }
}

TEST(PlanFormats, PlansWithoutPlaceAreNotWritten) {
  for (const PlanFormat format : kPlanFormats)
    for (const Plan& plan : {Plan{{Path{}}}, Plan{{Path{VertexId(0), VertexId(10)}}}}) {
      std::ostringstream out;
      const auto error = write_plan(out, "out", small_graph(), plan, format);
      ASSERT_TRUE(error.has_value());
      EXPECT_EQ(error->code, ErrorCode::invalid_plan);
      EXPECT_EQ(out.str(), "");
    }
}

TEST(PlanFormats, LineFormatsNeedAGridToRead) {
  for (const char* name : {"valid/plan.cbsh2", "valid/plan.visualizer"}) {
    const auto file = read_plan(testing::data(name), Graph::make(9, {}).value());
    ASSERT_FALSE(file.has_value());
    EXPECT_EQ(file.error().code, ErrorCode::invalid_plan);
  }
}

TEST(PlanFormats, WritersReportAFullDisk) {
  for (const PlanFormat format : kPlanFormats)
    testing::expect_reports_full_disk([&](std::ostream& out) {
      return write_plan(out, "out", small_graph(), small_plan(), format);
    });
}

}  // namespace
}  // namespace quadrille::discrete
