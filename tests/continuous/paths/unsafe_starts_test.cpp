// SPDX-License-Identifier: MIT
#include "paths/unsafe_starts.hpp"

#include <gtest/gtest.h>

namespace quadrille::continuous::test {
namespace {

constexpr Ticks kFar = 5;

template <class Check>
void for_all(const Check& check) {
  for (Ticks begin = -kFar; begin < kFar; ++begin)
    for (Ticks end = begin + 1; end <= kFar; ++end) {
      SCOPED_TRACE(testing::Message() << '[' << begin << ", " << end << ')');
      check(TickInterval{begin, end});
    }
}

TEST(UnsafeStarts, OfTwoMoves) {
  for_all([](const TickInterval& offsets) {
    for (Ticks s = -kFar; s <= kFar; ++s)
      for (Ticks t = -3 * kFar; t <= 3 * kFar; ++t) {
        const bool collide = offsets.contains(t - s);
        EXPECT_EQ(starts_against(offsets, s).contains(t), collide) << s << ' ' << t;
        EXPECT_EQ(starts_before(offsets, t).contains(s), collide) << s << ' ' << t;
      }
  });
}

TEST(UnsafeStarts, AgainstAllOfSome) {
  for_all([](const TickInterval& offsets) {
    for_all([&](const TickInterval& starts) {
      for (Ticks t = -3 * kFar; t <= 3 * kFar; ++t) {
        bool collides = true;
        for (Ticks s = starts.first(); s <= starts.last(); ++s)
          collides = collides && offsets.contains(t - s);
        EXPECT_EQ(starts_against_all(offsets, starts).contains(t), collides) << t;
      }
    });
  });
}

TEST(UnsafeStarts, AgainstAStay) {
  for_all([](const TickInterval& contact) {
    for (Ticks arrive = -kFar; arrive <= kFar; ++arrive)
      for (Ticks leave = arrive; leave <= kFar; ++leave)
        for (Ticks s = -3 * kFar; s <= 3 * kFar; ++s)
          EXPECT_EQ(starts_meeting(contact, arrive, leave).contains(s),
                    contact.shifted(s).meets(arrive, leave))
              << arrive << ".." << leave << ' ' << s;
    const TickInterval for_good = starts_meeting(contact, 3, kForever);
    EXPECT_EQ(for_good.end, kForever);
    for (Ticks s = -3 * kFar; s <= 3 * kFar; ++s)
      EXPECT_EQ(for_good.contains(s), contact.shifted(s).meets(3, kForever)) << s;
  });
}

/// Exactly those starts for which the contact covers the stretch; each stay that meets it collides.
TEST(UnsafeStarts, AgainstAllStaysThatMeetAStretch) {
  for_all([](const TickInterval& contact) {
    for_all([&](const TickInterval& stretch) {
      for (Ticks s = -3 * kFar; s <= 3 * kFar; ++s) {
        bool all_collide = true;
        for (Ticks arrive = -kFar - 1; arrive <= kFar + 1; ++arrive)
          for (Ticks leave = arrive; leave <= kFar + 1; ++leave)
            if (stretch.meets(arrive, leave) && !contact.shifted(s).meets(arrive, leave))
              all_collide = false;
        EXPECT_EQ(starts_meeting_all(contact, stretch).contains(s), all_collide) << s;
      }
    });
  });
}

}  // namespace
}  // namespace quadrille::continuous::test
