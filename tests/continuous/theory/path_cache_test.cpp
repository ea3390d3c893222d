// SPDX-License-Identifier: MIT
#include "theory/path_cache.hpp"

#include <gtest/gtest.h>

#include "continuous/support/roads.hpp"

namespace quadrille::continuous::test {
namespace {

bool any(const KnownPathRef& /*known*/) { return true; }

/// One agent, who goes along a road of length 1000 after a wait.
class ContinuousPathCache : public testing::Test {
 protected:
  static TimedPath after(Ticks wait) { return {{{EdgeId(0), wait}}, wait + 1000}; }
  KnownPathRef remember(Ticks wait) {
    return cache_.remember(instance_, AgentId(0), after(wait), last_version_);
  }

  const Instance instance_ =
      Instance::make(roadmap({{0, 0}, {1000, 0}}, {{0, 1}}), {agent(0, 1, 3)}).value();
  PathCache cache_;
  std::uint64_t last_version_ = 0;
};

TEST_F(ContinuousPathCache, KnowsWhatFollowsFromAPath) {
  const KnownPathRef known = remember(5);
  EXPECT_EQ(known->path, after(5));
  EXPECT_TRUE(known->uses.breaks(Ban::start(EdgeId(0), {5, 6})));
  EXPECT_FALSE(known->uses.breaks(Ban::start(EdgeId(0), {6, kForever})));
  ASSERT_EQ(known->steps.size(), 3u);  // the wait, the move, and the stay at the goal
  EXPECT_EQ(known->steps[1].begin, Ticks{5});
  EXPECT_EQ(known->steps[2].begin, Ticks{1005});
}

TEST_F(ContinuousPathCache, EqualPathsAreOneAndOthersHaveVersionsOfTheirOwn) {
  const KnownPathRef first = remember(5);
  const KnownPathRef second = remember(6);
  EXPECT_EQ(remember(5), first);
  EXPECT_EQ(remember(6), second);
  EXPECT_NE(first->version, second->version);
  EXPECT_EQ(last_version_, 2u);
}

TEST_F(ContinuousPathCache, FindsACheapestPathThatKeepsTheCap) {
  EXPECT_EQ(cache_.cheapest(kAnyCost, any), nullptr);
  for (const Ticks wait : {Ticks{7}, Ticks{3}, Ticks{5}}) static_cast<void>(remember(wait));
  EXPECT_EQ(cache_.cheapest(kAnyCost, any)->path, after(3));
  EXPECT_EQ(cache_.cheapest(1003, any)->path, after(3));
  EXPECT_EQ(cache_.cheapest(1002, any), nullptr);
}

TEST_F(ContinuousPathCache, ReturnsNoPathThatBreaksABan) {
  for (const Ticks wait : {Ticks{7}, Ticks{3}, Ticks{5}}) static_cast<void>(remember(wait));
  const auto obeys = [](Ticks end) {
    return [=](const KnownPathRef& known) {
      return !known->uses.breaks(Ban::start(EdgeId(0), {0, end}));
    };
  };
  EXPECT_EQ(cache_.cheapest(kAnyCost, obeys(4))->path, after(5));
  EXPECT_EQ(cache_.cheapest(1006, obeys(6)), nullptr);
  EXPECT_EQ(cache_.cheapest(kAnyCost, obeys(6))->path, after(7));
  EXPECT_EQ(cache_.cheapest(kAnyCost, obeys(8)), nullptr);
}

TEST_F(ContinuousPathCache, ForgetsWhatWasUsedLongestAgo) {
  const auto size = Ticks(std::int64_t{PathCache::kCapacity});
  for (Ticks wait = 0; wait < size; ++wait) static_cast<void>(remember(wait));
  EXPECT_EQ(cache_.cheapest(kAnyCost, any)->path, after(0));
  static_cast<void>(remember(0));  // now it is 1 that comes next
  static_cast<void>(remember(size));
  EXPECT_EQ(cache_.cheapest(1000, any)->path, after(0));
  const auto not_first = [](const KnownPathRef& known) { return known->path.arrival > 1000; };
  EXPECT_EQ(cache_.cheapest(kAnyCost, not_first)->path, after(2));
  EXPECT_EQ(cache_.cheapest(1001, not_first), nullptr);
}

}  // namespace
}  // namespace quadrille::continuous::test
