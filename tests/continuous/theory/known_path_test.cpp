// SPDX-License-Identifier: MIT
#include "theory/known_path.hpp"

#include <gtest/gtest.h>

#include "continuous/support/roads.hpp"

namespace quadrille::continuous::test {
namespace {

// One agent, who goes along a road of length 1000 after a wait.
TEST(KnownPath, KnowsWhatFollowsFromAPath) {
  const Instance instance =
      Instance::make(roadmap({{0, 0}, {1000, 0}}, {{0, 1}}), {agent(0, 1, 3)}).value();
  const TimedPath path{{{EdgeId(0), 5}}, 1005};
  const KnownPathRef known = known_path(instance, AgentId(0), path, 7);
  EXPECT_EQ(known->path, path);
  EXPECT_EQ(known->version, 7u);
  EXPECT_TRUE(known->uses.breaks(Ban::start(EdgeId(0), {5, 6})));
  EXPECT_FALSE(known->uses.breaks(Ban::start(EdgeId(0), {6, kForever})));
  ASSERT_EQ(known->steps.size(), 3u);  // the wait, the move, and the stay at the goal
  EXPECT_EQ(known->steps[1].begin, Ticks{5});
  EXPECT_EQ(known->steps[2].begin, Ticks{1005});
}

}  // namespace
}  // namespace quadrille::continuous::test
