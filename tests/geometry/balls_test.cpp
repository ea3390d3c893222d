// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include "exact/exact_balls.hpp"
#include "geometry/cases.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

using boost::multiprecision::cpp_rational;
using Offsets = std::optional<TickInterval>;

TEST(Balls, KnownOffsets) {
  const Motion up{{0, 0, -100}, {0, 0, 100}, 200};
  const Motion east{{-100, 0, 0}, {100, 0, 0}, 200};
  // As two discs that cross at a right angle: |d| / sqrt(2) < 20.
  EXPECT_EQ(unsafe_offsets(Disc{10}, up, Disc{10}, east), Offsets(TickInterval::closed(-28, 28)));
  // Passing 12 beside it: |d| / sqrt(2) < 16.
  EXPECT_EQ(unsafe_offsets(Disc{10}, up, Disc{10}, {{-100, 12, 0}, {100, 12, 0}, 200}),
            Offsets(TickInterval::closed(-22, 22)));
  EXPECT_EQ(unsafe_offsets(Disc{10}, up, Disc{10}, {{-100, 20, 0}, {100, 20, 0}, 200}),
            std::nullopt);
  // One above the other: in the plane they would meet.
  EXPECT_EQ(unsafe_offsets(Disc{10}, east, Disc{10}, {{0, -100, 20}, {0, 100, 20}, 200}),
            std::nullopt);
  EXPECT_NE(unsafe_offsets(Disc{10}, east, Disc{10}, {{0, -100, 19}, {0, 100, 19}, 200}),
            std::nullopt);
  EXPECT_EQ(unsafe_offsets(Disc{10}, east, Disc{10}, {{0, -100, -20}, {0, 100, -20}, 200}),
            std::nullopt);
}

TEST(Balls, KnownWindows) {
  const BodyPair pair(Disc{10}, Disc{10});
  const Motion climb{{0, 0, -100}, {0, 0, 100}, 200};
  EXPECT_EQ(pair.contact_window(climb, {0, 0, 0}), Offsets({80, 120}));
  EXPECT_EQ(pair.contact_window(climb, {12, 0, 0}), Offsets({84, 116}));
  EXPECT_EQ(pair.contact_window(climb, {12, 16, 0}), std::nullopt);
  EXPECT_EQ(pair.contact_window(climb, {0, 0, 100}), Offsets({180, 201}));
}

TEST(Balls, TouchingIsNoOverlap) {
  EXPECT_FALSE(bodies_overlap(Disc{2}, {0, 0, 0}, Disc{1}, {1, 2, 2}));
  EXPECT_TRUE(bodies_overlap(Disc{2}, {0, 0, 0}, Disc{2}, {1, 2, 2}));
  const Length far = kMaxLength;
  EXPECT_FALSE(bodies_overlap(Disc{far}, {0, 0, -far}, Disc{far}, {1, 0, far}));
  EXPECT_TRUE(bodies_overlap(Disc{far}, {0, 0, -far}, Disc{far}, {1, 0, far - 1}));
}

// Two bodies of one height are as good as in the plane, whatever that height is; so are polygons.
TEST(Balls, AtOneHeightThereAreDiscsAndPolygons) {
  for (int seed = 0; seed < 1000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = small_bodies(random);
    const Length height = draw(random, -50, 50);
    const auto raised = [&](Motion motion) {
      motion.from.z = motion.to.z = height;
      return motion;
    };
    const BodyPair pair(c.body_a, c.body_b);
    EXPECT_EQ(pair.unsafe_offsets(raised(c.a), raised(c.b)), pair.unsafe_offsets(c.a, c.b)) << c;
  }
}

TEST(Balls, PolygonsDoNotClimb) {
  const auto square = ConvexPolygon::make({{0, 0}, {4, 0}, {4, 4}, {0, 4}}).value();
  EXPECT_FALSE(ConvexPolygon::make({{0, 0}, {4, 0}, {4, 4, 1}, {0, 4}}));
  const Motion climb{{0, 0, 0}, {0, 0, 9}, 9};
  EXPECT_DEATH(static_cast<void>(unsafe_offsets(square, climb, Disc{1}, climb)), "one height");
}

// All answers about a case in the plane stay when the plane is turned.
TEST(Balls, TurnedCasesAreAnsweredAsThoseInThePlane) {
  int unsafe_cases = 0, far_cases = 0;
  for (int seed = 0; seed < 6000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case flat = seed % 2 == 0 ? small_discs(random) : hard_discs(random);
    const Case c = turned(flat, random.below(6));
    if (!is_valid(c.a) || !is_valid(c.b) || std::get<Disc>(c.body_a).radius > kMaxLength ||
        std::get<Disc>(c.body_b).radius > kMaxLength)
      continue;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    const BodyPair in_plane(flat.body_a, flat.body_b), in_space(c.body_a, c.body_b);
    const Offsets offsets = in_plane.unsafe_offsets(flat.a, flat.b);
    ++(offsets ? unsafe_cases : far_cases);
    ASSERT_EQ(in_space.unsafe_offsets(c.a, c.b), offsets);
    ASSERT_EQ(in_space.can_meet(c.a, c.b), in_plane.can_meet(flat.a, flat.b));
    ASSERT_EQ(in_space.contact_window(c.a, c.b.from), in_plane.contact_window(flat.a, flat.b.from));
    const Ticks offset = draw_ticks(random, -c.b.duration, c.a.duration);
    const auto gap = in_space.gap(c.a, c.b, offset), same = in_plane.gap(flat.a, flat.b, offset);
    ASSERT_EQ(gap.has_value(), same.has_value());
    if (!gap) continue;
    ASSERT_LE(gap->at_least, 3 * same->at_most * (1 + 1e-15));
    ASSERT_GE(gap->at_most, 3 * same->at_least * (1 - 1e-15));
  }
  EXPECT_GT(unsafe_cases, 1000);
  EXPECT_GT(far_cases, 1000);
}

// The least squared distance of the positions over all moments of both motions, in rational
// numbers: the value at every point at which some derivative is zero.
cpp_rational least_square(const Motion& a, const Motion& b) {
  using Vector = std::array<cpp_rational, 3>;
  const auto vector = [](const Point& p, const Point& q) {
    return Vector{(q.x - p.x).value(), (q.y - p.y).value(), (q.z - p.z).value()};
  };
  const auto dot = [](const Vector& p, const Vector& q) -> cpp_rational {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  const Vector apart = vector(a.from, b.from), u = vector(a.to, a.from), v = vector(b.from, b.to);
  const auto square = [&](const cpp_rational& p, const cpp_rational& q) -> cpp_rational {
    Vector at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = apart[k] + p * u[k] + q * v[k];
    return dot(at, at);
  };
  cpp_rational least = square(0, 0);
  const auto offer = [&](const cpp_rational& p, const cpp_rational& q) {
    if (0 <= p && p <= 1 && 0 <= q && q <= 1) least = std::min(least, square(p, q));
  };
  const cpp_rational uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), du = dot(apart, u),
                     dv = dot(apart, v), det = uu * vv - uv * uv;
  for (const int end : {0, 1}) {
    for (const int other : {0, 1}) offer(end, other);
    if (vv != 0) offer(end, -(dv + end * uv) / vv);
    if (uu != 0) offer(-(du + end * uv) / uu, end);
  }
  if (det != 0) offer((dv * uv - du * vv) / det, (du * uv - dv * uu) / det);
  return least;
}

TEST(Balls, CanMeetIsExact) {
  int meetings = 0, touches = 0;
  constexpr int kCases = 8000;
  for (int seed = 0; seed < kCases; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = seed % 2 == 0 ? small_balls(random) : hard_balls(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    const Length reach = std::get<Disc>(c.body_a).radius + std::get<Disc>(c.body_b).radius;
    const cpp_rational square = cpp_rational(reach.value()) * reach.value();
    const cpp_rational least = least_square(c.a, c.b);
    if (least < square) ++meetings;
    if (least == square) ++touches;
    ASSERT_EQ(BodyPair(c.body_a, c.body_b).can_meet(c.a, c.b), least < square);
    ASSERT_EQ(exact::ball_reaches(relative_places(c.a, c.b), reach), least < square);
  }
  EXPECT_GT(meetings, kCases / 8);
  EXPECT_LT(meetings, kCases - kCases / 8);
  EXPECT_GT(touches, kCases / 100);
}

TEST(Balls, ExactSearchFindsAnOffsetIfThereIsOne) {
  for (int seed = 0; seed < 2000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = hard_balls(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << c);
    const Length reach = std::get<Disc>(c.body_a).radius + std::get<Disc>(c.body_b).radius;
    const std::optional<Ticks> found = exact::find_balls_meeting(c.a, c.b, reach);
    const Offsets offsets = unsafe_offsets(c.body_a, c.a, c.body_b, c.b);
    ASSERT_EQ(found.has_value(), offsets.has_value());
    if (found) {
      ASSERT_TRUE(offsets->contains(*found));
    }
  }
}

}  // namespace
}  // namespace quadrille::geometry
