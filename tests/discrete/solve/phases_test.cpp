// SPDX-License-Identifier: MIT
// Progress: which phases a solve goes through, and that the long ones show that they go on.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using enum Phase;

Instance crowd(std::size_t size, std::size_t num_agents) {
  Random random(1);
  return random_grid(random, {size, size, 0, num_agents, num_agents});
}

struct Told {
  std::vector<Phase> phases;  ///< As they began.
  std::map<Phase, int> num_times;
};

Told told_by(const Instance& instance, SolveOptions options) {
  Told told;
  options.on_progress = [&](const Progress& progress) {
    if (told.phases.empty() || told.phases.back() != progress.phase)
      told.phases.push_back(progress.phase);
    ++told.num_times[progress.phase];
  };
  static_cast<void>(solve(instance, options).value());
  return told;
}

TEST(Phases, EachIsToldWhenItBegins) {
  using List = std::vector<Phase>;
  SolveOptions options;
  options.limits.conflicts = 10;
  options.progress_interval_s = 1000;
  for (const std::size_t threads : {1U, 2U}) {
    options.threads = threads;
    EXPECT_EQ(told_by(crowd(12, 20), options).phases,
              (List{feasibility, set_up, first_plan, search}));
  }
  options.threads = 1;
  options.first_plan = false;
  EXPECT_EQ(told_by(crowd(12, 20), options).phases, (List{feasibility, set_up, search}));
  options.system = System::mdd_sat;
  EXPECT_EQ(told_by(crowd(8, 6), options).phases, (List{feasibility, set_up, search}));
}

TEST(Phases, LongOnesShowThatTheyGoOn) {
  SolveOptions options;
  options.limits.conflicts = 100;
  options.progress_interval_s = 0;
  Told told = told_by(crowd(32, 300), options);
  EXPECT_GE(told.num_times[set_up], 10);
  EXPECT_GE(told.num_times[first_plan], 2);
  EXPECT_GE(told.num_times[search], 10);
}

}  // namespace
}  // namespace quadrille::discrete::support
