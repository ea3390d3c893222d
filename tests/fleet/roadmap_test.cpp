// SPDX-License-Identifier: MIT
#include "quadrille/fleet/roadmap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fleet/support.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;

std::string refused(const RoadmapBuilder& roads) {
  const auto made = roads.build();
  return made ? "made" : made.error().message;
}

TEST(FleetRoadmap, PlacesAreRoundedToTheResolution) {
  RoadmapBuilder roads({.length = 1_mm, .time = 10_ms});
  const VertexId a = roads.vertex(1.0004_m, -2.0006_m), b = roads.vertex({0.35_m, 7_mm}, "dock");
  roads.road(a, b);
  const Roadmap made = roads.build().value();
  EXPECT_EQ(made.position(a), (Point{1_m, -2.001_m}));
  EXPECT_EQ(made.position(b), (Point{0.35_m, 0.007_m}));
  EXPECT_EQ(made.in_units()->position(a), (continuous::Point{1000, -2001}));
  EXPECT_EQ(made.unit_sizes(), continuous::Resolution(0.001, 0.01));
  EXPECT_EQ(made.num_vertices(), 2u);
  EXPECT_EQ(made.num_lanes(), 2u);
}

TEST(FleetRoadmap, NamesAndPlaces) {
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(1.5_m, 2_m), b = roads.vertex(0_m, 0_m, "dock");
  const Roadmap made = roads.build().value();
  EXPECT_EQ(made.name(a), "(1.5 m, 2 m)");
  EXPECT_EQ(made.name(b), "dock");
  EXPECT_EQ(made.find("dock"), b);
  EXPECT_EQ(made.find("(1.5 m, 2 m)"), std::nullopt);
  EXPECT_EQ(made.find(""), std::nullopt);
}

TEST(FleetRoadmap, Heights) {
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(1_m, 2_m, 3.0004_m), b = roads.vertex(1_m, 2_m, 7_m, "mast");
  EXPECT_EQ(roads.road(a, b).build().value().num_lanes(), 2u);
  const Roadmap made = roads.build().value();
  EXPECT_EQ(made.position(a), (Point{1_m, 2_m, 3_m}));
  EXPECT_EQ(made.name(a), "(1 m, 2 m, 3 m)");
  EXPECT_EQ(made.nearest({1_m, 2_m, 6_m}), b);
  EXPECT_EQ(made.nearest({1_m, 2_m}), a);
  EXPECT_EQ(distance(made.position(a), {3_m, 5_m, 9_m}), 7_m);
  EXPECT_FALSE(made.in_units()->is_flat());
}

TEST(FleetRoadmap, RoadsAreASetThatCanBeClosed) {
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(0_m, 0_m), b = roads.vertex(1_m, 0_m), c = roads.vertex(2_m, 0_m);
  roads.road(a, b).road(b, a).lane(b, c).lane(b, c);
  EXPECT_EQ(roads.build().value().num_lanes(), 3u);
  RoadmapBuilder closed = roads;
  closed.close(b, a);
  EXPECT_EQ(closed.build().value().num_lanes(), 1u);
  EXPECT_EQ(roads.build().value().num_lanes(), 3u);
  EXPECT_EQ(closed.road(a, b).build().value().num_lanes(), 3u);
}

TEST(FleetRoadmap, NearestIsTheNearest) {
  support::Random random(7);
  for (int round = 0; round < 50; ++round) {
    const auto draw = [&] { return Metres(static_cast<double>(random.below(20)) / 2); };
    RoadmapBuilder roads;
    for (std::size_t i = 0; i <= random.below(12); ++i) roads.vertex(draw(), draw());
    const Roadmap made = roads.build().value();
    for (int query = 0; query < 20; ++query) {
      const Point place{draw(), draw()};
      const VertexId found = made.nearest(place);
      for (const VertexId v : made.vertex_ids()) {
        const Metres there = distance(made.position(v), place);
        const Metres here = distance(made.position(found), place);
        // Of equals the first one.
        EXPECT_TRUE(v < found ? here < there : here <= there);
      }
    }
  }
}

TEST(FleetRoadmap, BuilderRefusesWhatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(RoadmapBuilder({.length = 0_m, .time = 10_ms})),
            "the resolution is 0 m and 0.01 s; both have to be positive and finite");
  EXPECT_EQ(refused(RoadmapBuilder({.length = 1_mm, .time = -1_s})),
            "the resolution is 0.001 m and -1 s; both have to be positive and finite");
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(0.0004_m, 0_m);
  EXPECT_EQ(refused(roads), "made");
  const auto with = [&](const auto& change) {
    RoadmapBuilder changed = roads;
    change(changed);
    return refused(changed);
  };
  EXPECT_EQ(with([&](auto& r) { r.vertex(1_m, 1_m, "a"); }), "two vertices are called 'a'");
  EXPECT_EQ(with([&](auto& r) { r.vertex(Metres(nan), 1_m, "x"); }),
            "vertex 'x' at (nan m, 1 m) is too far away for a resolution of 0.001 m");
  EXPECT_EQ(with([&](auto& r) { r.vertex(1_m, Metres(1e12)); }),
            "vertex (1 m, 1e+12 m) at (1 m, 1e+12 m) is too far away for a resolution of 0.001 m");
  EXPECT_EQ(with([&](auto& r) { r.road(a, a); }),
            "a lane from 'a' to 'a': both are in the same place");
  EXPECT_EQ(with([&](auto& r) { r.lane(a, b); }),
            "a lane from 'a' to (0.0004 m, 0 m): both are in the same place at a resolution of "
            "0.001 m");
  EXPECT_EQ(with([&](auto& r) { r.lane(a, VertexId(2)); }),
            "a lane from 'a' to vertex 2: there are only 2 vertices");
}

}  // namespace
}  // namespace quadrille::fleet
