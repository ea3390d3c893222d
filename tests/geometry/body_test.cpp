// SPDX-License-Identifier: MIT
#include "quadrille/geometry/body.hpp"

#include <gtest/gtest.h>

namespace quadrille::geometry {
namespace {

ErrorCode refused(std::vector<Point> vertices) {
  const auto polygon = ConvexPolygon::make(std::move(vertices));
  EXPECT_FALSE(polygon.has_value());
  return polygon ? ErrorCode::internal : polygon.error().code;
}

TEST(ConvexPolygon, IsKeptCounterClockwise) {
  const std::vector<Point> corners{{0, 0}, {4, 0}, {4, 3}};
  EXPECT_EQ(ConvexPolygon::make(corners).value().vertices(), corners);
  EXPECT_EQ(ConvexPolygon::make({{0, 0}, {4, 3}, {4, 0}}).value().vertices(), corners);
}

TEST(ConvexPolygon, RefusesWhatIsNone) {
  using enum ErrorCode;
  EXPECT_EQ(refused({}), invalid_instance);
  EXPECT_EQ(refused({{0, 0}, {1, 0}}), invalid_instance);
  EXPECT_EQ(refused({{0, 0}, {1, 0}, {2, 0}}), invalid_instance);          // A line.
  EXPECT_EQ(refused({{0, 0}, {2, 0}, {4, 0}, {2, 3}}), invalid_instance);  // Straight.
  EXPECT_EQ(refused({{0, 0}, {4, 0}, {4, 0}, {2, 3}}), invalid_instance);  // Repeats.
  EXPECT_EQ(refused({{0, 0}, {4, 0}, {1, 1}, {0, 4}}), invalid_instance);  // Notch.
  EXPECT_EQ(refused({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), invalid_instance);  // Bow tie.
  EXPECT_EQ(refused({{0, 10}, {6, -8}, {-10, 3}, {10, 3}, {-6, -8}}), invalid_instance);  // Star.
  EXPECT_EQ(refused({{0, 0}, {4, 0}, {2, 3}, {0, 0}, {4, 0}, {2, 3}}), invalid_instance);
  EXPECT_EQ(refused({{0, 0}, {kMaxLength + 1, 0}, {2, 3}}), out_of_range);
  std::vector<Point> many;
  for (std::int64_t i = 0; i <= 64; ++i) many.push_back({Length(i), Length(i * i)});
  EXPECT_EQ(refused(many), out_of_range);
  many.pop_back();
  EXPECT_TRUE(ConvexPolygon::make(many).has_value());
}

TEST(EnclosingRadius, IsTheFarthestCornerRoundedUp) {
  const auto of = [](std::vector<Point> corners) {
    return enclosing_radius(ConvexPolygon::make(std::move(corners)).value());
  };
  EXPECT_EQ(enclosing_radius(Disc{7}), Length{7});
  EXPECT_EQ(of({{3, 4}, {-1, 0}, {0, -1}}), Length{5});
  EXPECT_EQ(of({{3, 5}, {-1, 0}, {0, -1}}), Length{6});  // 5.83
  EXPECT_EQ(of({{1, 1}, {-1, 0}, {0, -1}}), Length{2});  // 1.41
  const Length far = kMaxLength;
  EXPECT_EQ(of({{far, 0}, {0, far}, {0, 0}}), far);
  EXPECT_EQ(of({{far, 1}, {0, far}, {0, 0}}), Length(far + 1));
  EXPECT_EQ(of({{far, far}, {0, 1}, {0, 0}}), Length(1'554'944'255'988));  // sqrt(2) 2^40, up
}

}  // namespace
}  // namespace quadrille::geometry
