// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/course.hpp"

#include <gtest/gtest.h>

namespace quadrille::dispatch {
namespace {

const VertexId kA(0), kB(1), kC(2);

/// Until 5 at a, at b from 15 to 20, at c from 24 on.
Course example() { return {{kA, 0, 5}, {kB, 15, 20}, {kC, 24, 24}}; }

TEST(Course, KnowsWhereOneIs) {
  const Course course = example();
  EXPECT_EQ(spot_at(course, -3), Spot(kA));
  EXPECT_EQ(spot_at(course, 5), Spot(kA));
  EXPECT_EQ(spot_at(course, 6), Spot(kA, kB, 1, 10));
  EXPECT_EQ(spot_at(course, 15), Spot(kB));
  EXPECT_EQ(spot_at(course, 23), Spot(kB, kC, 3, 4));
  EXPECT_EQ(spot_at(course, 99), Spot(kC));
  EXPECT_TRUE(stands_at(course, 4));
  EXPECT_FALSE(stands_at(course, 5));
  EXPECT_FALSE(stands_at(course, 14));
  EXPECT_TRUE(stands_at(course, 24));
}

TEST(Course, IsCutAndJoinedAgainAtAnyTime) {
  const Course course = example();
  for (Ticks t = 0; t <= 30; t += 1) {
    const Course first = until(course, t), second = since(course, t);
    EXPECT_EQ(first.back().spot, second.front().spot);
    EXPECT_EQ(second.front().arrive, t);
    const Course whole = joined(first, second);
    for (Ticks s = 0; s <= 30; s += 1) EXPECT_EQ(spot_at(whole, s), spot_at(course, s)) << t;
    EXPECT_EQ(whole.size(), course.size()) << t;
  }
}

TEST(Course, StopsWithinALane) {
  Course course = joined(until(example(), 8), shifted(since(example(), 8), 0));
  EXPECT_EQ(course, example());
  Course later = shifted(since(example(), 8), 7);
  later.front().arrive = 8;
  course = joined(until(example(), 8), later);
  EXPECT_EQ(spot_at(course, 12), Spot(kA, kB, 3, 10));
  EXPECT_TRUE(stands_at(course, 12));
  EXPECT_EQ(spot_at(course, 16), Spot(kA, kB, 4, 10));
  EXPECT_EQ(spot_at(course, 22), Spot(kB));
  EXPECT_EQ(end_of(course), Ticks(31));
  // And again on the same lane.
  const Course rest = since(course, 17);
  EXPECT_EQ(rest.front().spot, Spot(kA, kB, 5, 10));
  EXPECT_EQ(joined(until(course, 17), rest), course);
}

}  // namespace
}  // namespace quadrille::dispatch
