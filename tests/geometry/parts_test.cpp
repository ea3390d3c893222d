// SPDX-License-Identifier: MIT
//
// Parts of motions, and places on the way, which need not have whole coordinates: the same as in
// length units so small that all of them are whole.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/geometry/body_pair.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::geometry {
namespace {

class Draw {
 public:
  explicit Draw(std::uint32_t seed) : random_(seed) {}
  std::int64_t number(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_.below(static_cast<std::size_t>(high - low + 1)));
  }
  Length length(std::int64_t low, std::int64_t high) { return Length(number(low, high)); }
  Ticks ticks(std::int64_t low, std::int64_t high) { return Ticks(number(low, high)); }
  Point point(bool has_heights) {
    const Length x = length(-12, 12), y = length(-12, 12);
    return {x, y, has_heights ? length(-3, 3) : Length(0)};
  }
  Body body(bool is_polygon) {
    if (!is_polygon) return Disc{length(1, 5)};
    const Length w = length(1, 4), h = length(1, 4), x = length(-2, 2);
    return ConvexPolygon::make({{x - w, -h}, {x + w, -h}, {x, h + 1}}).value();
  }

 private:
  support::Random random_;
};

Point times(std::int64_t scale, const Point& p) { return {scale * p.x, scale * p.y, scale * p.z}; }

Body times(std::int64_t scale, const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body)) return Disc{scale * disc->radius};
  std::vector<Point> corners;
  for (const Point& p : std::get<ConvexPolygon>(body).vertices())
    corners.push_back(times(scale, p));
  return ConvexPolygon::make(std::move(corners)).value();
}

/// Where a motion is after s ticks, in units of which `scale` are one; `scale` is a multiple of its
/// length.
Point at(const Motion& m, Ticks s, std::int64_t scale) {
  const std::int64_t share = scale / m.whole().value() * m.done(s).value();
  const auto between = [&](Length a, Length b) {
    return Length(scale * a.value() + share * (b - a).value());
  };
  return {between(m.from.x, m.to.x), between(m.from.y, m.to.y), between(m.from.z, m.to.z)};
}
Motion whole(const Motion& m, std::int64_t scale) {
  return {at(m, 0, scale), at(m, m.duration, scale), m.duration};
}

TEST(Parts, AreAsExactAsWholeMotions) {
  std::size_t num_meet = 0, num_apart = 0, num_shorter = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(20'000); ++seed) {
    Draw draw(seed);
    const bool in_space = draw.number(0, 4) == 0;
    const Body body_a = draw.body(!in_space && draw.number(0, 2) == 0);
    const Body body_b = draw.body(!in_space && draw.number(0, 2) == 0);
    const auto motion = [&] {
      const Point from = draw.point(in_space), to = draw.point(in_space);
      const Ticks all = draw.ticks(1, 9);
      const Ticks behind = draw.ticks(0, all.value() - 1);
      if (draw.number(0, 3) == 0) return rest(Place(from, to, behind, all), draw.ticks(0, 5));
      if (from == to) return Motion{from, to, all};
      return Motion{from, to, all - behind, behind};
    };
    const Motion a = motion(), b = motion();
    const std::int64_t scale = a.whole().value() * b.whole().value();
    const BodyPair bodies(body_a, body_b);
    const BodyPair fine(times(scale, body_a), times(scale, body_b));
    const auto found = bodies.unsafe_offsets(a, b);
    ASSERT_EQ(found, fine.unsafe_offsets(whole(a, scale), whole(b, scale))) << seed;
    (found ? num_meet : num_apart) += 1;
    const Motion all_of_a{a.from, a.to, a.behind + a.duration};
    if (!a.is_rest() && bodies.unsafe_offsets(all_of_a, b) != found) ++num_shorter;
    for (Ticks d = -b.duration - 1; d <= a.duration + 1; d += 1) {
      ASSERT_EQ(bodies.collide(a, b, d), found && found->contains(d)) << seed;
      const auto gap = bodies.gap(a, b, d);
      const auto fine_gap = fine.gap(whole(a, scale), whole(b, scale), d);
      ASSERT_EQ(gap.has_value(), fine_gap.has_value()) << seed;
      if (!gap) continue;
      ASSERT_LE(gap->at_least * static_cast<double>(scale), fine_gap->at_most + 1e-9) << seed;
      ASSERT_LE(fine_gap->at_least, gap->at_most * static_cast<double>(scale) + 1e-9) << seed;
    }
    if (fine.can_meet(whole(a, scale), whole(b, scale))) {
      ASSERT_TRUE(bodies.can_meet(a, b)) << seed;
    }
    const Place place(draw.point(in_space), draw.point(in_space), draw.ticks(0, 3), 4);
    const std::int64_t twice = 4 * scale;
    const BodyPair finer(times(twice, body_a), times(twice, body_b));
    const Point there = at(rest(place, 0), 0, twice);
    if (!a.is_rest()) {
      ASSERT_EQ(bodies.contact_window(a, place), finer.contact_window(whole(a, twice), there))
          << seed;
    }
    const Place here(a.from, a.to, a.behind, a.whole());
    if (a.behind <= a.whole()) {
      ASSERT_EQ(bodies.overlap(here, place), finer.overlap(at(rest(here, 0), 0, twice), there))
          << seed;
    }
  }
  for (const std::size_t count : {num_meet, num_apart, num_shorter})
    EXPECT_GT(count, support::scaled(1'000));
}

TEST(Parts, TouchExactly) {
  // From 10/3 to 40/3 it is 10, from there to 13 it is less.
  const BodyPair bodies(Disc{3}, Disc{7});
  const Place third({0, 0}, {10, 0}, 1, 3);
  EXPECT_FALSE(bodies.overlap(third, Place({0, 0}, {40, 0}, 1, 3)));
  EXPECT_TRUE(bodies.overlap(third, Place({0, 0}, {39, 0}, 1, 3)));
}

}  // namespace
}  // namespace quadrille::geometry
