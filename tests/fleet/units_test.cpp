// SPDX-License-Identifier: MIT
#include "quadrille/fleet/units.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <type_traits>

#include "quadrille/fleet/solver.hpp"

namespace quadrille::units {
namespace {

static_assert(!std::is_convertible_v<double, Metres> && !std::is_convertible_v<int, Metres>);
static_assert(!std::is_convertible_v<Metres, double> && !std::is_convertible_v<Metres, Seconds>);
static_assert(!std::is_assignable_v<Metres&, double> && !std::is_assignable_v<Metres&, Seconds>);

template <class T>
concept IsATime = requires(const fleet::TimedPath& path, fleet::SolveOptions& options, T time) {
  path.at(time);
  options.limits.wall = time;
  Seconds(1) + time;
  Seconds(1) < time;
};
static_assert(IsATime<Seconds>);
static_assert(!IsATime<double> && !IsATime<int> && !IsATime<Metres> && !IsATime<Hertz>);

template <class T>
concept IsARate = requires(const fleet::TimedPath& path, T rate) {
  path.samples(rate);
};
static_assert(IsARate<Hertz> && !IsARate<double> && !IsARate<int> && !IsARate<Seconds>);

template <class T>
concept IsASpeed = requires(T speed) {
  fleet::RobotSpec{.name = {}, .speed = speed};
};
static_assert(IsASpeed<MetresPerSecond>);
static_assert(!IsASpeed<double> && !IsASpeed<int> && !IsASpeed<Metres>);

TEST(Units, LiteralsAreTheNearestDoubles) {
  EXPECT_EQ(350_mm, 0.35_m);
  EXPECT_EQ(35_cm, 0.35_m);
  EXPECT_EQ(0.1_mm, 0.0001_m);
  EXPECT_EQ(1_mm, Metres(0.001));
  EXPECT_EQ(7_mm, Metres(0.007));
  EXPECT_EQ(50_ms, 0.05_s);
  EXPECT_EQ(2.5_ms, 0.0025_s);
  EXPECT_EQ(3_s, Seconds(3));
  EXPECT_EQ((0.8_mps).value(), 0.8);
  EXPECT_EQ((20_Hz).value(), 20);
  EXPECT_EQ(180_deg, Radians(std::numbers::pi));
  EXPECT_EQ(22.5_deg, degrees(22.5));
  EXPECT_EQ(2_rad, 2.0_rad);
  EXPECT_EQ(90_degps, 90_deg / 1_s);
  EXPECT_EQ(0.5_radps, 1_rad / 2_s);
}

TEST(Units, Arithmetic) {
  EXPECT_EQ(1_m + 250_mm, 1.25_m);
  EXPECT_EQ(1_m - 2_m, -1_m);
  EXPECT_EQ(2 * 1.5_m, 3_m);
  EXPECT_EQ(1.5_m * 2, 3_m);
  EXPECT_EQ(3_m / 2, 1.5_m);
  EXPECT_EQ(3_m / 1.5_m, 2.0);
  EXPECT_EQ(3_m / 2_s, 1.5_mps);
  EXPECT_EQ(3_m / 1.5_mps, 2_s);
  EXPECT_EQ(1.5_mps * 2_s, 3_m);
  EXPECT_EQ(2_s * 1.5_mps, 3_m);
  EXPECT_EQ(90_deg / 45_degps, 2_s);
  EXPECT_EQ(in_degrees(90_deg), 90);
  EXPECT_LT(999_mm, 1_m);
  Metres sum;
  sum += 1_m;
  sum -= 3_m;
  EXPECT_EQ(sum, -2_m);
}

TEST(Units, Texts) {
  EXPECT_EQ(to_string(0.35_m), "0.35 m");
  EXPECT_EQ(to_string(3.2_s), "3.2 s");
  EXPECT_EQ(to_string(0.8_mps), "0.8 m/s");
  EXPECT_EQ(to_string(20_Hz), "20 Hz");
  EXPECT_EQ(to_string(-0.0_m), "0 m");
  for (const int angle : {0, 1, 30, 45, 60, 90, 100, 179, 360})
    EXPECT_EQ(to_string(degrees(angle)), std::to_string(angle) + " deg");
  EXPECT_EQ(to_string(22.5_degps), "22.5 deg/s");
}

}  // namespace
}  // namespace quadrille::units
