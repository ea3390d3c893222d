// SPDX-License-Identifier: MIT
// Progress: which phases a solve goes through, and that the long ones show that they go on.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "continuous/support/roads.hpp"
#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/solver.hpp"

namespace quadrille::continuous::test {
namespace {

using enum Phase;

Instance discs(std::size_t num_vertices, std::size_t num_agents, std::uint64_t seed) {
  RandomInstanceOptions options;
  options.num_vertices = num_vertices;
  options.num_agents = num_agents;
  return random_instance(options, seed).value();
}

/// Two discs on a line that have to change places.
Instance deadlock() {
  return Instance::make(roadmap({{0, 0}, {10, 0}, {20, 0}}, {{0, 1}, {1, 2}}),
                        {agent(0, 2, 2), agent(2, 0, 2)})
      .value();
}

struct Told {
  std::vector<Phase> phases;  ///< As they began.
  std::map<Phase, int> num_times;
};

Told told_by(const Instance& instance, SolveOptions options) {
  Told told;
  options.on_progress = [&](const Progress& progress) {
    if (told.phases.empty()) {
      EXPECT_EQ(progress.lower_bound, 0);
      EXPECT_EQ(progress.conflicts, 0);
    }
    if (told.phases.empty() || told.phases.back() != progress.phase)
      told.phases.push_back(progress.phase);
    ++told.num_times[progress.phase];
  };
  static_cast<void>(solve(instance, options).value());
  return told;
}

TEST(Phases, EachIsToldWhenItBegins) {
  SolveOptions options;
  options.limits.conflicts = 10;
  options.progress_interval_s = 1000;
  using List = std::vector<Phase>;
  EXPECT_EQ(told_by(discs(40, 9, 1), options).phases, (List{set_up, first_plan, search}));
  options.threads = 2;
  EXPECT_EQ(told_by(discs(40, 9, 1), options).phases, (List{set_up, first_plan, search}));
  options.threads = 1;
  EXPECT_EQ(told_by(deadlock(), options).phases, (List{set_up, joint_search}));
  options.joint_work = 0;
  EXPECT_EQ(told_by(deadlock(), options).phases, (List{set_up, routes, first_plan, feasibility}));
  options.route_work = 0;
  EXPECT_EQ(told_by(deadlock(), options).phases, (List{set_up, first_plan, feasibility}));
  options.initial_plan = solve(discs(40, 9, 1), options).value().plan;
  ASSERT_TRUE(options.initial_plan);
  EXPECT_EQ(told_by(discs(40, 9, 1), options).phases, (List{set_up, search}));
}

TEST(Phases, LongOnesShowThatTheyGoOn) {
  SolveOptions options;
  options.limits.conflicts = 10;
  options.progress_interval_s = 0;
  Told told = told_by(discs(80, 25, 1), options);
  EXPECT_GE(told.num_times[set_up], 10);
  EXPECT_GE(told.num_times[first_plan], 10);
  EXPECT_GE(told.num_times[search], 10);
  told = told_by(discs(60, 6, 2), options);
  EXPECT_GE(told.num_times[routes], 10);
  told = told_by(discs(9, 4, 3), options);
  EXPECT_GE(told.num_times[joint_search], 2);
}
}  // namespace
}  // namespace quadrille::continuous::test
