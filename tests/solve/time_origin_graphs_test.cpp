// SPDX-License-Identifier: MIT
// See time_origin.hpp.
#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/discrete/primal.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/timed_plan.hpp"
#include "quadrille/discrete/verify.hpp"
#include "solve/time_origin.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"

namespace quadrille {
namespace {

using support::expect_same;
using support::options_for;
using support::Random;
using support::scaled;

discrete::Instance drawn(std::uint32_t seed) {
  Random random(seed);
  discrete::Instance instance = random.percent(50) ? discrete::support::random_grid(random, {})
                                                   : discrete::support::random_graph(random, 8, 4);
  return random.percent(25) ? discrete::support::with_more_goals(random, instance) : instance;
}

Timestep drawn_now(std::uint32_t seed) {
  Random random(seed + 1000);
  return random.percent(10) ? discrete::kMaxNow : static_cast<Timestep>(1 + random.below(5000));
}

TEST(TimeOriginDiscrete, AnswersAreThoseFrom0ButForTheTimes) {
  int solved = 0;
  for (std::uint32_t seed = 0; seed < scaled(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const discrete::Instance from_0 = drawn(seed);
    const Timestep now = drawn_now(seed);
    const discrete::Instance later = from_0.with_now(now).value();
    auto options = options_for<discrete::SolveOptions>(seed);
    options.first_plan = seed % 5 != 0;
    const auto expected = discrete::solve(from_0, options).value();
    std::vector<Timestep> told;
    options.on_plan = [&](const discrete::Plan& plan) { told.push_back(plan.now); };
    options.plan_interval_s = 0;
    const auto outcome = discrete::solve(later, options).value();
    expect_same(expected, outcome, now);
    for (const Timestep begin : told) EXPECT_EQ(begin, now);
    if (!outcome.plan) continue;
    ++solved;
    EXPECT_EQ(outcome.plan->now, now);
    EXPECT_EQ(outcome.plan->paths, expected.plan->paths);
    EXPECT_TRUE(discrete::verify(later, *outcome.plan).valid());
    EXPECT_FALSE(discrete::verify(later, *expected.plan).valid());
    EXPECT_FALSE(discrete::verify(from_0, *outcome.plan).valid());
    EXPECT_EQ(discrete::verify(later, *outcome.plan).sum_of_costs,
              discrete::verify(from_0, *expected.plan).sum_of_costs);
    const auto timed = discrete::TimedPlan::make(later, *outcome.plan).value();
    EXPECT_EQ(timed.sum_of_costs(), outcome.plan->cost(Objective::sum_of_costs));
    for (const AgentId i : timed.agent_ids()) {
      EXPECT_EQ(timed[i].stops().front().arrive, now);
      EXPECT_EQ(timed[i].samples(2).front().time, now);
      EXPECT_EQ(timed[i].cost(), discrete::arrival(outcome.plan->paths[i]));
    }
    // Given back, it is taken.
    options.initial_plan = options.debug.known_plan = outcome.plan;
    EXPECT_EQ(discrete::solve(later, options).value().cost, outcome.cost);
    options.debug.known_plan.reset();
    options.initial_plan = expected.plan;
    EXPECT_EQ(discrete::solve(later, options).error().code, ErrorCode::invalid_plan);
  }
  EXPECT_GE(solved, static_cast<int>(scaled(400) / 4));
}

TEST(TimeOriginDiscrete, PlansWithoutProofBeginThen) {
  LimitMonitor limits{Limits{}};
  int found = 0;
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const discrete::Instance later = drawn(seed).with_now(77).value();
    const auto plan = discrete::find_plan(later, limits, 0);
    if (!plan) continue;
    ++found;
    EXPECT_TRUE(discrete::verify(later, *plan).valid()) << seed;
  }
  EXPECT_GT(found, 10);
}

TEST(TimeOriginDiscrete, FilesSayIt) {
  const auto later = drawn(3).with_now(12).value();
  std::stringstream file;
  ASSERT_FALSE(discrete::write_instance_json(file, "i.json", later));
  EXPECT_NE(file.str().find("\"now\": 12"), std::string::npos);
  EXPECT_EQ(discrete::read_instance_json(file, "i.json").value().now(), 12);

  LimitMonitor limits{Limits{}};
  const auto grid = discrete::Instance::make(discrete::Graph::grid(3, 1, {true, true, true}),
                                             {{VertexId(0), VertexId(2)}}, 12);
  const auto plan = discrete::find_plan(*grid, limits, 0).value();
  std::stringstream text;
  ASSERT_FALSE(
      discrete::write_plan(text, "p.json", grid->graph(), plan, discrete::PlanFormat::json));
  EXPECT_EQ(discrete::read_plan(text, "p.json", grid->graph()).value().plan, plan);
  for (const auto format : discrete::kPlanFormats) {
    if (format == discrete::PlanFormat::json) continue;
    const auto error = discrete::write_plan(text, "p", grid->graph(), plan, format);
    ASSERT_TRUE(error);
    EXPECT_NE(error->message.find("begin at timestep 0, and this one at 12"), std::string::npos);
  }
  EXPECT_TRUE(discrete::write_instance_yaml(text, "i.yaml", *grid));
}

TEST(TimeOriginDiscrete, WhatIsOutOfRangeIsRefused) {
  const auto from_0 = drawn(3);
  for (const Timestep now : {-1, discrete::kMaxNow + 1})
    EXPECT_EQ(from_0.with_now(now).error().code, ErrorCode::out_of_range);
  std::stringstream file(
      "{\n\"quadrille\": \"instance\", \"version\": 1,\n\"now\": -3,\n"
      "\"graph\": {\"vertices\": 1, \"edges\": []}, \"agents\": []}");
  const auto read = discrete::read_instance_json(file, "i.json");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where.line, 3);
  // No plan is too broken.
  discrete::Plan plan{{}, INT32_MAX};
  plan.paths.push_back({VertexId(0), VertexId(0), VertexId(0)});
  EXPECT_FALSE(discrete::verify(from_0, plan).valid());
}

}  // namespace
}  // namespace quadrille
