// SPDX-License-Identifier: MIT
#include "quadrille/geometry/tick_interval.hpp"

#include <gtest/gtest.h>

#include <set>

namespace quadrille::geometry {
namespace {

constexpr Ticks kFar = 6;

/// By its definition.
std::set<Ticks> ticks_of(const TickInterval& interval) {
  std::set<Ticks> ticks;
  for (Ticks t = -4 * kFar; t <= 4 * kFar; ++t)
    if (interval.begin <= t && t < interval.end) ticks.insert(t);
  return ticks;
}

template <class Check>
void for_all(const Check& check) {
  for (Ticks begin = -kFar; begin <= kFar; ++begin)
    for (Ticks end = begin - 1; end <= kFar; ++end) {
      SCOPED_TRACE(testing::Message() << '[' << begin << ", " << end << ')');
      check(TickInterval{begin, end});
    }
}

TEST(TickIntervals, AreSetsOfTicks) {
  for_all([](const TickInterval& interval) {
    const std::set<Ticks> ticks = ticks_of(interval);
    EXPECT_EQ(interval.is_empty(), ticks.empty());
    EXPECT_EQ(interval.length(), Ticks(std::ssize(ticks)));
    for (Ticks t = -kFar - 1; t <= kFar + 1; ++t)
      EXPECT_EQ(interval.contains(t), ticks.count(t) == 1) << t;
    if (ticks.empty()) return;
    EXPECT_EQ(interval.first(), *ticks.begin());
    EXPECT_EQ(interval.last(), *ticks.rbegin());
    EXPECT_EQ(TickInterval::closed(interval.first(), interval.last()), interval);
  });
}

TEST(TickIntervals, AreShiftedAndMirroredTickByTick) {
  for_all([](const TickInterval& interval) {
    std::set<Ticks> shifted, mirrored;
    for (const Ticks t : ticks_of(interval)) {
      shifted.insert(t + 5);
      mirrored.insert(-t);
    }
    EXPECT_EQ(ticks_of(interval.shifted(5)), shifted);
    EXPECT_EQ(ticks_of(interval.mirrored()), mirrored);
    EXPECT_EQ(interval.mirrored().mirrored(), interval);
  });
}

TEST(TickIntervals, OverlapIfTheyShareATick) {
  for_all([](const TickInterval& a) {
    for_all([&](const TickInterval& b) {
      bool shares = false;
      for (const Ticks t : ticks_of(a)) shares = shares || b.contains(t);
      EXPECT_EQ(a.overlaps(b), shares);
    });
  });
}

/// Moments are looked at in quarters of a tick: whatever ends at whole ticks is met there or not
/// at all.
TEST(TickIntervals, AreStretchesOfTime) {
  for_all([](const TickInterval& stretch) {
    if (stretch.is_empty()) return;
    for (Ticks arrive = -kFar - 1; arrive <= kFar + 1; ++arrive)
      for (Ticks leave = arrive; leave <= kFar + 1; ++leave) {
        bool is_met = false;
        for (Ticks quarter = 4 * arrive; quarter <= 4 * leave; ++quarter)
          is_met = is_met || (4 * stretch.begin < quarter && quarter < 4 * stretch.end);
        EXPECT_EQ(stretch.meets(arrive, leave), is_met) << arrive << ".." << leave;
      }
    for (Ticks t = -kFar - 1; t <= kFar + 1; ++t)
      EXPECT_EQ(stretch.inner_ticks().contains(t), stretch.meets(t, t)) << t;
  });
}

}  // namespace
}  // namespace quadrille::geometry
