// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "geometry/cases.hpp"
#include "geometry/oracle.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

using Contact = std::optional<TickInterval>;

TEST(ContactWindow, DrivingThrough) {
  const BodyPair pair(Disc{10}, Disc{10});
  // In contact during the open interval (80, 120).
  const Motion through{{-100, 0}, {100, 0}, 200};
  EXPECT_EQ(pair.contact_window(through, {0, 0}), Contact({80, 120}));
  // (82.67.., 117.32..), so a stander that has left by 82 or comes at 118 is not in the way.
  EXPECT_EQ(pair.contact_window(through, {0, 10}), Contact({82, 118}));
  EXPECT_EQ(pair.contact_window(through, {0, 20}), std::nullopt);
  EXPECT_EQ(pair.contact_window(through, {0, 19}), Contact({93, 107}));
}

TEST(ContactWindow, OverlapAtTheEnds) {
  const BodyPair pair(Disc{10}, Disc{10});
  const Motion away{{0, 0}, {100, 0}, 100};
  EXPECT_EQ(pair.contact_window(away, {0, 0}), Contact({-1, 20}));
  EXPECT_EQ(pair.contact_window(away, {100, 0}), Contact({80, 101}));
  EXPECT_EQ(pair.contact_window(away, {-19, 0}), Contact({-1, 1}));
  EXPECT_EQ(pair.contact_window(away, {-20, 0}), std::nullopt);
  EXPECT_EQ(pair.contact_window(rest({0, 0}, 7), {5, 5}), Contact({-1, 8}));
  EXPECT_EQ(pair.contact_window(rest({0, 0}, 0), {5, 5}), Contact({-1, 1}));
  EXPECT_EQ(pair.contact_window(rest({0, 0}, 0), {25, 5}), std::nullopt);
}

TEST(ContactWindow, ShorterThanATick) {
  const BodyPair pair(Disc{10}, Disc{10});
  // 1000 a tick, at the place at time 1.5: nobody can come and go within the contact.
  EXPECT_EQ(pair.contact_window({{-1500, 0}, {500, 0}, 2}, {0, 0}), Contact({1, 2}));
}

TEST(ContactWindow, TellsExactlyWhichStandersCollide) {
  int contacts = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = random.percent(70) ? small_discs(random) : small_bodies(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    const Point place = c.b.from;
    const Contact contact = BodyPair(c.body_a, c.body_b).contact_window(c.a, place);
    if (contact) {
      ++contacts;
      EXPECT_LT(contact->begin, contact->end);
    }
    const Ticks longest = c.a.duration + 4;
    const oracle::Oracle<oracle::SmallInteger> oracle(c.body_a, c.a, c.body_b,
                                                      rest(place, longest));
    for (Ticks arrive = -2; arrive <= c.a.duration + 2; ++arrive)
      for (Ticks leave = arrive; leave <= c.a.duration + 2; ++leave) {
        const bool expected =
            oracle.collide(-2, std::max(Ticks{0}, arrive), std::min(c.a.duration, leave));
        ASSERT_EQ(contact && contact->meets(arrive, leave), expected) << arrive << ".." << leave;
      }
  }
  EXPECT_GT(contacts, 500);
}

TEST(Overlap, TouchingIsNoOverlap) {
  EXPECT_FALSE(bodies_overlap(Disc{2}, {0, 0}, Disc{3}, {3, 4}));
  EXPECT_TRUE(bodies_overlap(Disc{3}, {0, 0}, Disc{3}, {3, 4}));
  const Length far = kMaxLength;  // The distance is far * 2 to 12 digits, but not exactly.
  EXPECT_FALSE(bodies_overlap(Disc{far}, {-far, 0}, Disc{far}, {far, 1}));
  EXPECT_TRUE(bodies_overlap(Disc{far}, {-far, 0}, Disc{far}, {far - 1, 1}));
  const auto square = ConvexPolygon::make({{0, 0}, {4, 0}, {4, 4}, {0, 4}}).value();
  EXPECT_FALSE(bodies_overlap(square, {0, 0}, square, {4, 4}));
  EXPECT_FALSE(bodies_overlap(square, {0, 0}, square, {4, 1}));
  EXPECT_TRUE(bodies_overlap(square, {0, 0}, square, {3, 3}));
  EXPECT_TRUE(bodies_overlap(square, {0, 0}, square, {0, 0}));
  EXPECT_FALSE(bodies_overlap(square, {0, 0}, Disc{5}, {7, 8}));  // 3, 4 from the corner.
  EXPECT_TRUE(bodies_overlap(square, {0, 0}, Disc{5}, {7, 7}));
  EXPECT_TRUE(bodies_overlap(Disc{1}, {2, 2}, square, {0, 0}));
}

}  // namespace
}  // namespace quadrille::geometry
