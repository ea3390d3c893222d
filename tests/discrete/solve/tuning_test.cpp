// SPDX-License-Identifier: MIT
// What of the settings depends on the instance, and what they switch off.
#include "solve/tuning.hpp"

#include <gtest/gtest.h>

namespace quadrille::discrete {
namespace {

constexpr Features kOpen{true, 10}, kWalled{false, 10};

TEST(Tuning, OpenMapsHaveSharesOfTheirOwn) {
  const SolveOptions options;
  const Tuning open = choose_tuning(kOpen, options), walled = choose_tuning(kWalled, options);
  EXPECT_TRUE(open.cores.from_above && walled.cores.from_above);
  EXPECT_EQ(open.settings.above_share, options.settings.above_share_open);
  EXPECT_EQ(walled.settings.above_share, options.settings.above_share);
  EXPECT_EQ(open.settings.above_candidates_within, options.settings.above_candidates_within_open);
  EXPECT_EQ(open.explicit_paths.lemmas, options.settings.explicit_lemmas_open);
  EXPECT_EQ(walled.explicit_paths.lemmas, options.settings.explicit_lemmas);
}

TEST(Tuning, PartsAreSwitchedOff) {
  SolveOptions options;
  options.settings.above_share = 0;
  EXPECT_FALSE(choose_tuning(kWalled, options).cores.from_above);
  EXPECT_TRUE(choose_tuning(kOpen, options).cores.from_above);
  options.settings.above_share_open = 0;
  EXPECT_FALSE(choose_tuning(kOpen, options).cores.from_above);
  options.settings.explicit_variables = 0;
  options.settings.core_most_lift = 1;
  for (const Features& features : {kOpen, kWalled}) {
    EXPECT_EQ(choose_tuning(features, options).explicit_paths.variables, 0);
    EXPECT_FALSE(choose_tuning(features, options).cores.raise_cores);
  }
}

TEST(Tuning, ManyAgentsBacktrackChronologically) {
  SolveOptions options;
  options.settings.lazy_chronological_agents = 11;
  EXPECT_FALSE(choose_tuning(kOpen, options).chronological);
  options.settings.lazy_chronological_agents = 10;
  EXPECT_TRUE(choose_tuning(kOpen, options).chronological);
  options.lazy.chronological = false;
  EXPECT_FALSE(choose_tuning(kOpen, options).chronological);
}

TEST(Tuning, OtherSystemsSearchFromBelowAlone) {
  SolveOptions options;
  options.system = System::smt_cbs;
  EXPECT_FALSE(choose_tuning(kOpen, options).cores.from_above);
  options.system = System::dpll;
  options.first_plan = false;
  EXPECT_FALSE(choose_tuning(kOpen, options).cores.from_above);
}

}  // namespace
}  // namespace quadrille::discrete
