// SPDX-License-Identifier: MIT
//
// Random zones against the list of their points in a box.
#include "joint/zone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "continuous/support/random_instance.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::size_t kSize = 4;
constexpr Ticks kBox = 3;
/// Variable 0 is 0: only differences matter.
using Point4 = std::array<Ticks, kSize>;
using Points = std::set<Point4>;

template <class Predicate>
Points all_points(const Predicate& belongs) {
  Points points;
  for (Ticks a = -kBox; a <= kBox; ++a)
    for (Ticks b = -kBox; b <= kBox; ++b)
      for (Ticks c = -kBox; c <= kBox; ++c)
        if (const Point4 p{0, a, b, c}; belongs(p)) points.insert(p);
  return points;
}

Points points_of(const Zone& zone) {
  return all_points([&](const Point4& p) {
    for (std::size_t x = 0; x < kSize; ++x)
      for (std::size_t y = 0; y < kSize; ++y)
        if (p[x] - p[y] > zone.most(x, y)) return false;
    return true;
  });
}

/// Back into the box. Of use before a zone is compared.
bool restrict_to_box(Zone& zone) {
  for (std::size_t x = 1; x < kSize; ++x)
    if (!zone.restrict(x, 0, kBox) || !zone.restrict(0, x, kBox)) return false;
  return true;
}

/// Whether each limit is met by some point, as the least ones are.
void expect_closed(const Zone& zone, const Points& points) {
  for (std::size_t x = 0; x < kSize; ++x)
    for (std::size_t y = 0; y < kSize; ++y) {
      Ticks largest = -kForever;
      for (const Point4& p : points) largest = std::max(largest, p[x] - p[y]);
      ASSERT_EQ(zone.most(x, y), largest);
    }
}

/// Random limits; the points that keep them. Nothing if there are none.
std::optional<std::pair<Zone, Points>> draw_zone(Draw& draw) {
  Zone zone(kSize);
  EXPECT_TRUE(restrict_to_box(zone));
  Points points = all_points([](const Point4&) { return true; });
  for (std::int64_t k = draw.number(0, 6); k > 0; --k) {
    const auto x = static_cast<std::size_t>(draw.number(0, 3));
    const auto y = (x + static_cast<std::size_t>(draw.number(1, 3))) % kSize;
    const Ticks limit = draw.ticks(-2, 4);
    std::erase_if(points, [&](const Point4& p) { return p[x] - p[y] > limit; });
    EXPECT_EQ(zone.restrict(x, y, limit), !points.empty());
    if (points.empty()) return std::nullopt;
  }
  return std::make_pair(zone, points);
}

TEST(Zone, IsTheSetOfItsPoints) {
  Draw draw(1);
  int nonempty = 0;
  for (std::size_t n = 0; n < support::scaled(2000); ++n) {
    const auto drawn = draw_zone(draw);
    if (!drawn) continue;
    ++nonempty;
    const auto& [zone, points] = *drawn;
    ASSERT_EQ(points_of(zone), points);
    expect_closed(zone, points);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(nonempty, 0);
}

TEST(Zone, IncludesAnotherIfThatHasNoOtherPoints) {
  Draw draw(2);
  int included = 0;
  for (std::size_t n = 0; n < support::scaled(4000); ++n) {
    const auto a = draw_zone(draw), b = draw_zone(draw);
    if (!a || !b) continue;
    const bool expected =
        std::includes(a->second.begin(), a->second.end(), b->second.begin(), b->second.end());
    ASSERT_EQ(a->first.includes(b->first), expected);
    included += expected ? 1 : 0;
  }
  EXPECT_GT(included, 0);
}

TEST(Zone, ForgetsRaisesAndAssigns) {
  Draw draw(3);
  for (std::size_t n = 0; n < support::scaled(1500); ++n) {
    const auto drawn = draw_zone(draw);
    if (!drawn) continue;
    const Points& points = drawn->second;
    const auto x = static_cast<std::size_t>(draw.number(1, 3));
    const std::size_t y = x == 3 ? 1 : x + 1;
    const int what = static_cast<int>(draw.number(0, 2));
    Zone zone = drawn->first;
    if (what == 0) zone.forget(x);
    if (what == 1) zone.free_above(x);
    if (what == 2) zone.assign(x, y);
    ASSERT_TRUE(restrict_to_box(zone));
    const Points expected = all_points([&](const Point4& p) {
      if (what == 2 && p[x] != p[y]) return false;
      for (Ticks t = -kBox; t <= (what == 1 ? p[x] : kBox); ++t) {
        Point4 before = p;
        before[x] = t;
        if (points.count(before) > 0) return true;
      }
      return false;
    });
    ASSERT_EQ(points_of(zone), expected) << "operation " << what;
    expect_closed(zone, expected);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
