// SPDX-License-Identifier: MIT
#include "support/case_text.hpp"

#include <gtest/gtest.h>

#include "support/generators.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

constexpr const char* kGridCase =
    "# why\n"
    "map\n"
    ".@.\n"
    "...\n"
    "task 0 0 -> 2 0\n"
    "task 2 0 -> 0 1\n"
    "expect sum-of-costs 9\n"
    "expect makespan 5\n"
    "options objective=makespan system=dpll-mdd check=1/3,2/3 seed=7 audit known-plan "
    "initial-plan\n";

TEST(CaseText, ReadsAGridWithOptions) {
  const auto read = parse_case(kGridCase, "case.txt");
  ASSERT_TRUE(read) << read.error().to_string();
  EXPECT_EQ(read->instance.graph().num_vertices(), 5U);
  EXPECT_EQ(read->instance.agents()[AgentId(1)], (Agent{VertexId(1), VertexId(2)}));
  EXPECT_EQ(read->sum_of_costs, 9);
  EXPECT_EQ(read->makespan, 5);
  EXPECT_FALSE(read->infeasible);
  ASSERT_TRUE(read->options);
  EXPECT_EQ(read->options->objective, Objective::makespan);
  EXPECT_EQ(read->options->system, System::dpll_mdd);
  EXPECT_EQ(to_string(read->options->mdd.check), "1/3,2/3");
  EXPECT_EQ(read->options->seed, 7U);
  EXPECT_TRUE(read->options->debug.audit);
  EXPECT_TRUE(read->known_plan);
  EXPECT_TRUE(read->initial_plan);
  EXPECT_EQ(options_text(*read->options),
            "options objective=makespan system=dpll-mdd check=1/3,2/3 seed=7 audit\n");
}

TEST(CaseText, SaysWhereItIsWrong) {
  const auto error = [](const std::string& text) {
    const auto read = parse_case(text, "case.txt");
    return read ? "read" : read.error().to_string();
  };
  EXPECT_EQ(error("map\n.\ntask 0 0 => 0 0\n"), "case.txt:3: expected 'task start -> goal'");
  EXPECT_EQ(error("nonsense\n"), "case.txt:1: unknown entry 'nonsense'");
  EXPECT_EQ(error("map\n..\n.\n"), "case.txt:3: map rows of different lengths");
  EXPECT_EQ(error("map\n@.\ntask 0 0 -> 1 0\n"),
            "case.txt:3: a task names a place that is no vertex");
  EXPECT_EQ(error("vertices 2\nedge 0\n"), "case.txt:2: numbers expected after 'edge'");
  EXPECT_EQ(error("vertices 2\nedge 0 2\n").substr(0, 11), "case.txt:2:");
  EXPECT_EQ(error("map\n.\noptions speed=3\n"), "case.txt:3: unknown option 'speed=3'");
  EXPECT_EQ(error("task 0 -> 1\n"), "case.txt:1: either a map or vertices expected");
}

TEST(CaseText, WritesWhatItReads) {
  Random random(7);
  for (int round = 0; round < 100; ++round) {
    const Instance instance = round % 2 == 0 ? random_grid(random, {}) : random_graph(random, 8, 4);
    const std::string text = instance_text(instance);
    const auto read = parse_case(text, "case.txt");
    ASSERT_TRUE(read) << read.error().to_string() << "\n" << text;
    EXPECT_EQ(read->instance.agents(), instance.agents());
    EXPECT_EQ(instance_text(read->instance), text);
  }
}

TEST(CaseText, WritesTheOptionsThatItReads) {
  Random random(7);
  for (int round = 0; round < 100; ++round) {
    const std::string grid = instance_text(random_grid(random, {}));
    for (TunedOptions& options : random_systems(random, Objective::sum_of_costs)) {
      options.debug.known_plan.reset();  // the reader leaves finding one to its user
      options.initial_plan.reset();
      const std::string text = options_text(options);
      const auto read = parse_case(grid + text, "case.txt");
      ASSERT_TRUE(read) << read.error().to_string() << "\n" << text;
      EXPECT_EQ(options_text(*read->options), text);
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete::support
