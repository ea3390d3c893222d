// SPDX-License-Identifier: MIT
#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <cmath>

#include "advancement.hpp"
#include "geometry/cases.hpp"
#include "geometry/oracle.hpp"
#include "grown_shape.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

// Moderate numbers, so that FCL's closed form for two capsules is good to 1e-6 units.
constexpr double kTolerance = 1e-6;

double reach_of(const Case& c) {
  return static_cast<double>(
      (std::get<Disc>(c.body_a).radius + std::get<Disc>(c.body_b).radius).value());
}

// The disc of radius reach that goes along the relative path is a capsule; the bodies come as near
// as the capsule does to the origin, which stands in as a capsule of almost no size.
double fcl_gap(const RelativePath& path, double reach) {
  const Vec along = path.end - path.begin;
  const double length = norm(along);
  const double tiny = 1e-9;
  const fcl::Capsuled swept(reach, length);
  const fcl::Capsuled origin(tiny, tiny);
  fcl::Transform3d frame = fcl::Transform3d::Identity();
  if (length > 0) {
    const fcl::Vector3d axis(along.x / length, along.y / length, 0);
    frame.linear().col(1) = fcl::Vector3d(0, 0, 1);
    frame.linear().col(2) = axis;
    frame.linear().col(0) = frame.linear().col(1).cross(frame.linear().col(2));
  }
  const Vec middle = 0.5 * (path.begin + path.end);
  frame.translation() = fcl::Vector3d(middle.x, middle.y, 0);
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(&swept, frame, &origin, fcl::Transform3d::Identity(), request, result);
}

TEST(CrossCheck, DiscsAgreeWithFclAndWithSampling) {
  int hits = 0, misses = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = small_discs(random);
    const BodyPair pair(c.body_a, c.body_b);
    for (int i = 0; i < 4; ++i) {
      const Ticks offset = draw_ticks(random, -c.b.duration, c.a.duration);
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", offset " << offset << ": " << c);
      const Window window = *common_window(c.a, c.b, offset);
      const RelativePath path = relative_path(c.a, c.b, offset, window, 0);
      const bool collide = pair.collide(c.a, c.b, offset);
      const double gap = fcl_gap(path, reach_of(c));
      if (gap > kTolerance) {
        EXPECT_FALSE(collide) << gap;
      }
      if (gap < -kTolerance) {
        EXPECT_TRUE(collide) << gap;
      }

      double least = std::numeric_limits<double>::infinity();
      const double span = static_cast<double>((window.end - window.begin).value());
      for (int sample = 0; sample <= 500; ++sample) {
        const double time = static_cast<double>(window.begin.value()) + span * sample / 500;
        const auto at = [](const Motion& m, double t) {
          const double done = m.duration == 0 ? 0 : t / static_cast<double>(m.duration.value());
          return to_vec(m.from) + done * to_vec(m.to - m.from);
        };
        least = std::min(least,
                         norm(at(c.b, time - static_cast<double>(offset.value())) - at(c.a, time)));
      }
      // Samples are upper bounds of the least distance; it can only be less by half a step's way.
      const double way = norm(path.end - path.begin) / 1000;
      if (least < reach_of(c) - kTolerance) {
        EXPECT_TRUE(collide) << least;
      }
      if (least - way > reach_of(c) + kTolerance) {
        EXPECT_FALSE(collide) << least;
      }
      (collide ? hits : misses)++;
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(misses, 2000);
}

// What advancement proves is true, and it proves most of what is true.
TEST(Advancement, ProvesOnlyWhatTheOracleConfirms) {
  int proved = 0, apart = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = seed % 2 == 0 ? small_bodies(random) : hard_bodies(random);
    const Ticks offset = draw_ticks(random, -c.b.duration, c.a.duration);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", offset " << offset << ": " << c);
    const auto radius = [](const Body& body) {
      return std::holds_alternative<Disc>(body) ? std::get<Disc>(body).radius : Length{0};
    };
    const Length reach = radius(c.body_a) + radius(c.body_b);
    const std::vector<Point> shape = grown_corners(c.body_a, c.body_b);
    Length size = reach;
    for (const Point& corner : shape) size = std::max(size, reach + extent(corner));
    const Advancement advancement(c.body_a, c.body_b, shape, reach);
    const Window window = *common_window(c.a, c.b, offset);
    const bool collide =
        oracle::Oracle<oracle::BigInteger>(c.body_a, c.a, c.body_b, c.b).collide(offset);
    if (advancement.proves_apart(relative_path(c.a, c.b, offset, window, size))) {
      ++proved;
      ASSERT_FALSE(collide);
    }
    if (!collide) ++apart;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(proved, apart * 3 / 4);
}

}  // namespace
}  // namespace quadrille::geometry
