// SPDX-License-Identifier: MIT
#include "grown_shape.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "lattice_hull.hpp"
#include "planar.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::geometry {
namespace {

Body draw_body(Random& random, std::int64_t size) {
  if (random.below(10) == 0) return Disc{1};
  while (true) {
    std::vector<Point> points;
    for (std::uint64_t k = 3 + random.below(10); k > 0; --k) {
      const auto part = [&] {
        const auto width = static_cast<std::uint64_t>(2 * size + 1);
        return Length(static_cast<std::int64_t>(random.below(width)) - size);
      };
      points.push_back({part(), part()});
    }
    auto made = ConvexPolygon::make(convex_hull(points));
    if (made) return *std::move(made);
  }
}

std::vector<Point> corners_of(const Body& body) {
  if (std::holds_alternative<Disc>(body)) return {Point{}};
  return std::get<ConvexPolygon>(body).vertices();
}

// Small numbers, so that many sides are parallel.
TEST(GrownCorners, AreTheHullOfAllDifferences) {
  Random random(3);
  for (int round = 0; round < 3'000; ++round) {
    const std::int64_t size = round % 3 == 0 ? 3 : round % 3 == 1 ? 20 : std::int64_t{1} << 39;
    const Body a = draw_body(random, size), b = draw_body(random, size);
    std::vector<Point> differences;
    for (const Point& u : corners_of(a))
      for (const Point& w : corners_of(b)) differences.push_back(u - w);
    EXPECT_EQ(grown_corners(a, b), convex_hull(differences)) << round;
  }
}

}  // namespace
}  // namespace quadrille::geometry
