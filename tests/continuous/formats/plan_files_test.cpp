// SPDX-License-Identifier: MIT
#include "quadrille/continuous/plan_files.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <sstream>

#include "continuous/formats/file_support.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous {
namespace {

const Instance& discs() {
  static const Instance instance = read_instance_json(test::data("discs.json")).value();
  return instance;
}

auto read_discs(std::istream& in) { return read_plan(in, "f", discs()); }

TEST(TimedPlanFiles, TheExamplesAreOnePlan) {
  const PlanFile json = read_plan(test::data("discs-plan.json"), discs()).value();
  const PlanFile log = read_plan(test::data("discs-log.xml"), discs()).value();
  EXPECT_EQ(json.plan, log.plan);
  EXPECT_EQ(json.stated.sum_of_costs, std::nullopt);
  const VerifyReport report = verify(discs(), json.plan);
  EXPECT_TRUE(report.valid());
  EXPECT_EQ(report.sum_of_costs, 5015);
}

TEST(TimedPlanFiles, RefusesWrongJson) {
  const std::vector<test::Fault> faults = {
      {"", "{}", "f:1: the key 'resolution' is missing"},
      {"", "", "f:1: not valid JSON"},
      {"\"plan\",", "\"instance\",", "f:2: /quadrille: expected 'plan' or 'result'"},
      {"\"version\": 1,", "", "f:1: the key 'version' is missing"},
      {"\"version\": 1", "\"version\": 3", "f:3: /version: 3 is not between"},
      {"0.001", "0.01", "f:4: /resolution: the resolution of the instance is 0.001"},
      {"0.001,", "0.001, \"objective\": \"speed\",", "f:4: /objective: expected 'sum-of-costs'"},
      {"0.001,", "0.001, \"cost\": 5,", "f:4: /cost: a cost needs the key 'cost_ticks'"},
      {"0.001,", "0.001, \"cost_ticks\": 5,", "f:4: /cost_ticks: a cost needs the key 'objective'"},
      {"0.001,", "0.001, \"objective\": \"makespan\", \"cost\": 2, \"cost_ticks\": 2900,",
       "f:4: /cost: this is not 2900 times the resolution"},
      {"0.001,", "0.001, \"status\": \"good\",", "f:4: /status: expected 'optimal', 'feasible'"},
      {"0.001,", "0.001, \"lower_bound\": 5,",
       "f:4: /lower_bound: a lower bound needs the key 'lower_bound_ticks'"},
      {"0.001,", "0.001, \"lower_bound_ticks\": 5,",
       "f:4: /lower_bound_ticks: a lower bound needs the key 'objective'"},
      {"0.001,",
       "0.001, \"objective\": \"makespan\", \"lower_bound\": 2, \"lower_bound_ticks\": 2900,",
       "f:4: /lower_bound: this is not 2900 times the resolution"},
      {"0.001,", "0.001, \"agents\": 3,", "f:4: /agents: 3 agents, but 2 paths"},
      {"{\"vertex\": 0, \"at\"", "{\"vertex\": 4, \"at\"",
       "f:6: /plan/0/0/vertex: there is no vertex 4 among 4"},
      {"{\"vertex\": 0, \"at\"", "{\"vertex\": -1, \"at\"", "f:6: /plan/0/0/vertex: -1 is not"},
      {"{\"vertex\": 0, \"at\"", "{\"vertex\": 1, \"at\"", "f:6: /plan/0/0/at/0: this is not 1000"},
      {"{\"vertex\": 0, \"at\"", "{\"at\"", "f:6: /plan/0/0: the key 'vertex' is missing"},
      {"\"depart\": 0.115", "\"depart\": 0.116", "f:6: /plan/0/0/depart: this is not 115 times"},
      {"\"depart\": 0.115, \"depart_ticks\": 115", "\"depart\": 0.115",
       "f:6: /plan/0/0: the key 'depart_ticks' is missing"},
      {"\"depart_ticks\": 115}", "\"depart_ticks\": 115.5}",
       "f:6: /plan/0/0/depart_ticks: expected"},
      {"\"depart_ticks\": 115}", "\"depart_ticks\": 9e18}",
       "f:6: /plan/0/0/depart_ticks: expected"},
      {"\"depart_ticks\": 115}", "\"depart_ticks\": 9223372036854775807}",
       "f:6: /plan/0/0/depart_ticks: 9223372036854775807 is not between"},
      {"\"arrive_ticks\": 2115}", "\"arrive_ticks\": 2115, \"depart_ticks\": 2116}",
       "f:6: /plan/0/2/depart_ticks: an agent stays at its last stop for ever"},
      {"\"plan\": [", "\"plan\": [[],", "f:5: /plan/0: the path is empty"},
      {"", "{\"status\": \"unknown\", \"resolution\": 0.001, \"plan\": null}",
       "f:1: /plan: there is no plan"},
  };
  test::expect_refused(test::contents(test::data("discs-plan.json")), faults, read_discs);
}

TEST(TimedPlanFiles, RefusesWrongLogs) {
  const std::vector<test::Fault> faults = {
      {"", "<log/>", "f:1: there is no <log> in <root>"},
      {"", "<root/>", "f:1: there is no <log> in <root>"},
      {"", "<root><log/></root>", "f:1: there is no plan"},
      {"<agent number=\"1\">", "<agent number=\"2\">", "f:12: agent '2' where 1 is due"},
      {"<agent number=\"1\">", "<agent>", "f:12: agent '' where 1 is due"},
      {"</log>", "<agent number=\"2\"/></log>", "f:20: agent 2, but the instance has 2 agents"},
      {"start_id=\"3\"", "start_id=\"4\"", "f:16: the start of a section is no vertex"},
      {"start_id=\"3\"", "start_id=\"2\"", "f:16: the section does not begin where"},
      {"start_id=\"3\"", "start_id=\"x\"", "f:16: a <section> has start_id"},
      {"start_id=\"3\"", "start_i=\"0\" start_j=\"3\"",
       "f:16: the start of a section, (0, 3), is no vertex"},
      {"\"1.5\"", "\"-1.5\"", "f:16: the duration is '-1.5', not a time"},
      {"\"1.5\"", "\"nan\"", "f:16: the duration is 'nan', not a time"},
      {"\"1.5\"", "\"inf\"", "f:16: the duration is 'inf', not a time"},
      {"\"1.5\"", "\"1e30\"", "f:16: the duration is '1e30', not a time"},
      {"\"1.5\"", "\"\"", "f:16: the duration is '', not a time"},
      {"</log>", "</log>\n<log/>", "f:21: there is a second <log>"},
      {"", "<root><map/><agent start_id=\"1\" goal_id=\"2\"/><x><log/></x></root>",
       "f:1: <log> outside of <root>"},
      {"<agent number=\"1\">", "<agent number=\"1\"><path/>", "f:13: there is a second <path>"},
      {"<path duration=\"2.9\">",
       "<section start_id=\"2\" goal_id=\"2\" duration=\"1\"/><path duration=\"2.9\">",
       "f:13: <section> outside of <path>"},
      {"<path duration=\"2.9\">",
       "<path duration=\"2.9\"><x><section start_id=\"2\" goal_id=\"2\" duration=\"1\"/></x>",
       "f:13: <section> outside of <path>"},
      {"</log>", "</log><section/>", "f:20: <section> outside of <path>"},
      {"</log>", "<agent number=\"2\"><path/></agent></log>", "f:20: agent 2, but the instance"},
      {"\"1.5\"", "\"1.5\" duration=\"1.5\"",
       "f:16: not well-formed XML: the attribute 'duration' is given twice"},
      {"\"1.5\"", "\"1.5&nbsp;\"", "f:16: not well-formed XML: '&nbsp;' is no character"},
      {"", "<root><log><agent number=\"0\">\n<path/></agent></log></root>",
       "f:2: the path is empty"},
      {"", "<root><log><agent number=\"0\">\n<path><x/></path></agent></log></root>",
       "f:2: the path is empty"},
  };
  test::expect_refused(test::contents(test::data("discs-log.xml")), faults, read_discs);
}

TEST(TimedPlanFiles, LogsOfOtherProgramsMayDifferByTheirRounding) {
  const std::string log = test::contents(test::data("discs-log.xml"));
  const Plan exact = read_plan(test::data("discs-log.xml"), discs()).value().plan;
  for (const char* duration : {"1.4985", "1.50194"}) {
    std::istringstream in(
        test::with_fault(log, {"\"1.5\"", '"' + std::string(duration) + '"', ""}));
    EXPECT_EQ(read_discs(in).value().plan, exact) << duration;
  }
  std::istringstream in(test::with_fault(log, {"\"1.5\"", "\"1.503\"", ""}));
  const Plan longer = read_discs(in).value().plan;
  EXPECT_NE(longer, exact);
  EXPECT_FALSE(verify(discs(), longer).valid());
}

TEST(TimedPlanFiles, TheSummaryOfALogIsItsStatement) {
  const std::string log = test::contents(test::data("discs-log.xml"));
  const auto stated = [&](const std::string& summary) {
    std::istringstream in(
        test::with_fault(log, {"flowtime=\"5.015\" makespan=\"2.9\"", summary, ""}));
    return read_discs(in).value().stated;
  };
  // As exactly as it is written, and give or take the rounding of each section.
  for (const char* flowtime :
       {"5.015", "5.0150", "5.014999", "5.036", "5.02", "5.0", "5", "0.5e1", "50.15E-1"}) {
    const StatedOutcome file = stated("flowtime=\"" + std::string(flowtime) + "\"");
    EXPECT_EQ(file.sum_of_costs, 5015) << flowtime;
    EXPECT_EQ(file.makespan, std::nullopt);
  }
  EXPECT_EQ(stated("flowtime=\"5.100\"").sum_of_costs, 5100);
  EXPECT_EQ(stated("flowtime=\"7\"").sum_of_costs, 7000);
  EXPECT_EQ(stated("makespan=\"2.9\"").makespan, 2900);
  EXPECT_EQ(stated("makespan=\"2.80\"").makespan, 2800);
  const std::vector<test::Fault> faults = {
      {"\"5.015\"", "\"long\"", "f:4: the flowtime is 'long', not a time"},
      {"\"5.015\"", "\"-1\"", "f:4: the flowtime is '-1', not a time"},
      {"makespan=\"2.9\"", "makespan=\"1e300\"", "f:4: the makespan is '1e300', not a time"},
      {"<agent number=\"0\">", "<summary/><agent number=\"0\">",
       "f:5: there is a second <summary>"},
      {"</log>", "</log><summary/>", "f:20: <summary> outside of <log>"},
  };
  test::expect_refused(log, faults, read_discs);
}

TEST(TimedPlanFiles, WhatIsWrittenIsReadBack) {
  std::mt19937_64 random(5);
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = test::random_instance(seed, {});
    Plan plan;
    for (const AgentId i : instance.agent_ids()) {
      // Any walk along edges, with waits.
      Path path{{instance.agent(i).start, 0, 0}};
      for (std::size_t moves = random() % 5; moves > 0; --moves) {
        const auto edges = instance.out_edges(instance.class_of(i), path.back().vertex);
        if (edges.empty()) break;
        const EdgeId e = edges[random() % edges.size()];
        path.back().depart += static_cast<Ticks>(random() % 3 * 1000);
        const Ticks arrive = path.back().depart + instance.duration(instance.class_of(i), e);
        path.push_back({instance.roadmap().edge(e).to, arrive, arrive});
      }
      plan.paths.push_back(std::move(path));
    }
    for (const PlanFormat format : {PlanFormat::json, PlanFormat::ccbs}) {
      std::stringstream file;
      ASSERT_EQ(write_plan(file, "out", instance, plan, format), std::nullopt);
      const auto again = read_plan(file, "out", instance);
      ASSERT_TRUE(again.has_value()) << again.error().to_string() << '\n' << file.str();
      EXPECT_EQ(again->plan, plan) << file.str();
    }
  }
}

// Logs have times as numbers in seconds, whose last bit is 128 s here.
TEST(TimedPlanFiles, TheLatestTickIsReadBackAndNoLaterOne) {
  const Instance instance =
      Instance::make(test::roadmap({{0, 0}, {1024, 0}}, {{0, 1}}), {test::agent(0, 1, 1)}, 1)
          .value();
  const auto late = [&](Ticks end) {
    Plan plan;
    plan.paths.push_back(
        {{VertexId(0), 0, end - instance.duration(instance.class_of(AgentId(0)), EdgeId(0))},
         {VertexId(1), end, end}});
    return plan;
  };
  for (const PlanFormat format : {PlanFormat::json, PlanFormat::ccbs}) {
    std::stringstream file;
    ASSERT_EQ(write_plan(file, "out", instance, late(kMaxTick), format), std::nullopt);
    const auto again = read_plan(file, "out", instance);
    ASSERT_TRUE(again.has_value()) << again.error().to_string() << '\n' << file.str();
    EXPECT_EQ(again->plan, late(kMaxTick)) << file.str();
    EXPECT_TRUE(verify(instance, again->plan).valid());
    std::stringstream later;
    ASSERT_EQ(write_plan(later, "out", instance, late(kMaxTick + 1024), format), std::nullopt);
    EXPECT_FALSE(read_plan(later, "out", instance).has_value()) << later.str();
  }
  EXPECT_FALSE(verify(instance, late(kMaxTick + 1)).valid());
}

TEST(TimedPlanFiles, LengthsAndTimesMayHaveResolutionsOfTheirOwn) {
  for (const Resolution resolution :
       {Resolution(0.001, 0.01), Resolution(0.01, 0.001), Resolution(7, 1.0 / 3)}) {
    const Instance instance = Instance::make(test::roadmap({{0, 0}, {2000, 350}}, {{0, 1}}),
                                             {test::agent(0, 1, 300)}, resolution)
                                  .value();
    const Ticks arrive = 5 + instance.duration(instance.class_of(AgentId(0)), EdgeId(0));
    Plan plan;
    plan.paths.push_back({{VertexId(0), 0, 5}, {VertexId(1), arrive, arrive}});
    std::stringstream file;
    ASSERT_EQ(write_plan(file, "out", instance, plan, PlanFormat::json), std::nullopt);
    const std::string text = file.str();
    const auto again = read_plan(file, "out", instance);
    ASSERT_TRUE(again.has_value()) << again.error().to_string() << text;
    EXPECT_EQ(again->plan, plan);
    // A coordinate is held against length units, not against ticks.
    const auto at = text.find("[0, 0]");
    ASSERT_NE(at, std::string::npos);
    std::istringstream moved(std::string(text).replace(at, 6, "[0, 99]"));
    const auto refused = read_plan(moved, "f", instance);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().message, "/plan/0/0/at/1: this is not 0 times the resolution");
  }
}

TEST(TimedPlanFiles, AResultMayHaveASecondOpinion) {
  std::istringstream in(test::with_fault(
      test::contents(test::data("discs-plan.json")),
      {"\"resolution\"", "\"second_opinion\": {\"by\": \"fcl\"}, \"resolution\"", ""}));
  EXPECT_TRUE(read_discs(in).has_value());
  std::istringstream none(
      R"({"quadrille": "result", "status": "infeasible", "resolution": null, "plan": null})");
  EXPECT_EQ(read_discs(none).error().message, "/plan: there is no plan");
}

// Read again, the plan would be another one, perhaps one that breaks no rule.
TEST(TimedPlanFiles, WhatALogCannotSayIsNotWritten) {
  const Plan good = read_plan(test::data("discs-plan.json"), discs()).value().plan;
  const auto error = [&](const auto& change, PlanFormat format) {
    Plan plan = good;
    change(plan);
    std::ostringstream out;
    return write_plan(out, "out", discs(), plan, format);
  };
  const auto refused = [&](const auto& change, const std::string& why) {
    const auto found = error(change, PlanFormat::ccbs);
    ASSERT_TRUE(found.has_value()) << why;
    EXPECT_EQ(found->message.substr(found->message.find(": ") + 2), why);
    EXPECT_EQ(error(change, PlanFormat::json), std::nullopt) << why;
  };
  const AgentId first(0);
  refused([&](Plan& plan) { plan.paths[first][0].arrive = 1; },
          "the path does not begin at tick 0");
  refused([&](Plan& plan) { plan.paths[first][1].depart -= 1; }, "stop 1: time goes back");
  refused([&](Plan& plan) { plan.paths[first][1].arrive = 114; }, "stop 0: time goes back");
  refused([&](Plan& plan) { plan.paths[first][1].vertex = plan.paths[first][0].vertex; },
          "stop 0: a move that ends where it begins");
  refused([&](Plan& plan) { plan.paths[first][0].depart += 1; },
          "stop 0: the next move is by a tick or two not as long as its edge takes");
  refused([&](Plan& plan) { plan.paths.push_back(plan.paths[first]); }, "there are 2 agents");
  for (const PlanFormat format : {PlanFormat::json, PlanFormat::ccbs}) {
    EXPECT_TRUE(error([&](Plan& plan) { plan.paths[first].clear(); }, format).has_value());
    EXPECT_TRUE(
        error([&](Plan& plan) { plan.paths[first][0].vertex = VertexId(99); }, format).has_value());
  }
}

TEST(TimedPlanFiles, APlanForNoAgentsIsReadBack) {
  const auto roadmap =
      std::make_shared<const Roadmap>(Roadmap::make({{0, 0}, {1000, 0}}, {}).value());
  const Instance instance = Instance::make(roadmap, {}).value();
  for (const PlanFormat format : {PlanFormat::json, PlanFormat::ccbs}) {
    std::stringstream file;
    ASSERT_EQ(write_plan(file, "out", instance, {}, format), std::nullopt);
    const auto again = read_plan(file, "out", instance);
    ASSERT_TRUE(again.has_value()) << again.error().to_string();
    EXPECT_TRUE(again->plan.paths.empty());
  }
}

TEST(TimedPlanFiles, LogsOnGridsNameCells) {
  const OccupancyGrid cells{2, 2, std::vector<bool>(4, true)};
  const GridRoadmap grid = GridRoadmap::make(cells, 3, 1000, 1e-6).value();
  const VertexId start = *grid.vertex({1, 0}), goal = *grid.vertex({1, 1});
  const Instance instance =
      Instance::make(grid.roadmap(), {{start, goal, Disc{1000}, kUnitSpeed}}).value();
  Plan plan;
  plan.paths.push_back({{start, 0, 7}, {goal, 1'000'007, 1'000'007}});
  std::stringstream file;
  ASSERT_EQ(write_plan(file, "out", instance, plan, PlanFormat::ccbs, &grid), std::nullopt);
  EXPECT_NE(file.str().find("start_i=\"0\" start_j=\"1\" goal_i=\"1\" goal_j=\"1\""),
            std::string::npos);
  EXPECT_EQ(read_plan(file, "out", instance, &grid).value().plan, plan);
}

}  // namespace
}  // namespace quadrille::continuous
