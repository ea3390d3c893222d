// SPDX-License-Identifier: MIT
#include "quadrille/core/progress.hpp"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

TEST(Progress, PhasesHaveNames) {
  EXPECT_EQ(to_string(Phase::set_up), "set-up");
  EXPECT_EQ(to_string(Phase::joint_search), "joint-search");
  EXPECT_EQ(to_string(Phase::routes), "routes");
  EXPECT_EQ(to_string(Phase::first_plan), "first-plan");
  EXPECT_EQ(to_string(Phase::feasibility), "feasibility");
  EXPECT_EQ(to_string(Phase::search), "search");
}

}  // namespace
}  // namespace quadrille
