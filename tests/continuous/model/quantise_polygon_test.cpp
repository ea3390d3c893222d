// SPDX-License-Identifier: MIT
#include "quadrille/continuous/quantise_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace quadrille::continuous {
namespace {

using Corners = std::vector<std::pair<double, double>>;

std::vector<std::pair<std::int64_t, std::int64_t>> rounded(const Corners& corners) {
  std::vector<std::pair<std::int64_t, std::int64_t>> points;
  const auto polygon = quantise_polygon_up(corners, 1e-3);
  if (!polygon) return points;
  for (const Point& at : polygon->vertices()) points.emplace_back(at.x.value(), at.y.value());
  std::sort(points.begin(), points.end());
  return points;
}

TEST(QuantisePolygon, IsNeverSmallerThanGiven) {
  const decltype(rounded({})) square{{-301, -201}, {-301, 201}, {301, -201}, {301, 201}};
  EXPECT_EQ(rounded({{-0.3001, -0.2009}, {0.3001, -0.2009}, {0.3001, 0.2001}, {-0.3009, 0.2001}}),
            square);
}

TEST(QuantisePolygon, KeepsWhatIsMeantToBeWhole) {
  const Corners corners{{0.3, 0.35}, {-0.3, 0.35}, {-0.3, -0.7}};
  const auto polygon = quantise_polygon_up(corners, 1e-3).value();
  EXPECT_EQ(polygon.vertices().front(), (Point{300, 350}));
  EXPECT_EQ(rounded(corners), (decltype(rounded({})){{-300, -700}, {-300, 350}, {300, 350}}));
}

/// By how much `at`, in thousandths, is outside of the polygon.
double outside(const ConvexPolygon& polygon, double x, double y) {
  double worst = 0;
  const auto& corners = polygon.vertices();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const auto dx = static_cast<double>((b.x - a.x).value());
    const auto dy = static_cast<double>((b.y - a.y).value());
    const double cross =
        dx * (y - static_cast<double>(a.y.value())) - dy * (x - static_cast<double>(a.x.value()));
    worst = std::max(worst, -cross / std::hypot(dx, dy));
  }
  return worst;
}

TEST(QuantisePolygon, ContainsTheGivenOneAndIsHardlyLarger) {
  std::mt19937 random(7);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::size_t most = 0;
  for (int round = 0; round < 2000; ++round) {
    const int n = 3 + static_cast<int>(random() % 30);
    const double turned = draw(0, 7), wide = draw(0.2, 2), high = draw(0.2, 2);
    Corners corners;
    for (int k = 0; k < n; ++k)
      corners.emplace_back(wide * std::cos(turned + 2 * M_PI * k / n) + 0.01,
                           high * std::sin(turned + 2 * M_PI * k / n));
    const auto polygon = quantise_polygon_up(corners, 1e-3);
    ASSERT_TRUE(polygon) << polygon.error().message;
    for (const auto& [x, y] : corners) EXPECT_LT(outside(*polygon, 1000 * x, 1000 * y), 1e-6);
    for (const Point& at : polygon->vertices())
      EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [&](const auto& corner) {
        return std::abs(1000 * corner.first - static_cast<double>(at.x.value())) < 1 &&
               std::abs(1000 * corner.second - static_cast<double>(at.y.value())) < 1;
      }));
    most = std::max(most, polygon->vertices().size() - static_cast<std::size_t>(n));
  }
  EXPECT_LE(most, 16U);
}

TEST(QuantisePolygon, RefusesWhatIsNone) {
  EXPECT_EQ(quantise_polygon_up(Corners{{0, 0}, {1, 0}, {2, 0}}, 1e-3).error().code,
            ErrorCode::invalid_instance);
  EXPECT_EQ(quantise_polygon_up(Corners{{0, 0}, {1, 0}, {NAN, 1}}, 1e-3).error().code,
            ErrorCode::out_of_range);
  EXPECT_EQ(quantise_polygon_up(Corners{{0.1004, 0}, {0.1004, 0.1}, {-1, 0.05}, {1, 0.05}}, 1e-3)
                .error()
                .code,
            ErrorCode::invalid_instance);
}

}  // namespace
}  // namespace quadrille::continuous
