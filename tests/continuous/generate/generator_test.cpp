// SPDX-License-Identifier: MIT
#include "quadrille/continuous/generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace quadrille::continuous {
namespace {

double number(Length length) { return static_cast<double>(length.value()); }

double distance(const Point& p, const Point& a, const Point& b) {
  const double x = number(b.x - a.x), y = number(b.y - a.y);
  const double px = number(p.x - a.x), py = number(p.y - a.y);
  const double share = std::clamp((px * x + py * y) / (x * x + y * y), 0.0, 1.0);
  return std::hypot(px - share * x, py - share * y);
}

/// Twice the signed area of a triangle.
double turn(const Point& a, const Point& b, const Point& c) {
  return number(b.x - a.x) * number(c.y - a.y) - number(b.y - a.y) * number(c.x - a.x);
}

TEST(RandomRoadmap, KeepsItsPromises) {
  int polygons = 0, discs = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    RandomInstanceOptions options;
    options.num_vertices = 5 + 9 * static_cast<std::size_t>(seed);
    options.num_agents = 5;
    options.width = 15'000'000;
    options.height = 12'000'000;
    options.mixed = seed % 2 == 1;
    const Instance instance = random_instance(options, seed).value();
    const Roadmap& roadmap = instance.roadmap();
    ASSERT_EQ(roadmap.num_vertices(), options.num_vertices);
    ASSERT_EQ(instance.num_agents(), options.num_agents);
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (const Edge& e : roadmap.edges()) edges.emplace(e.from.index(), e.to.index());
    EXPECT_EQ(edges.size(), roadmap.num_edges());
    const auto reach = number(2 * options.radius);
    for (const auto& [u, v] : edges) {
      EXPECT_TRUE(edges.contains({v, u}));
      const Point &a = roadmap.positions()[u], &b = roadmap.positions()[v];
      for (std::size_t w = 0; w < roadmap.num_vertices(); ++w) {
        if (w == u || w == v) continue;
        EXPECT_GE(distance(roadmap.positions()[w], a, b), reach) << u << " " << v << " " << w;
      }
      for (const auto& [s, t] : edges) {
        const Point &c = roadmap.positions()[s], &d = roadmap.positions()[t];
        const bool crosses = turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
        EXPECT_FALSE(crosses && s != u && s != v && t != u && t != v);
      }
    }
    for (const Agent& agent : instance.agents()) {
      const Length radius = geometry::enclosing_radius(agent.body);
      EXPECT_LE(radius, options.radius);
      // The corners of polygons are rounded.
      EXPECT_GE(2 * radius + 4, options.mixed ? options.radius : 2 * options.radius);
      if (const auto* polygon = std::get_if<ConvexPolygon>(&agent.body)) {
        EXPECT_TRUE(options.mixed);
        EXPECT_GE(polygon->vertices().size(), 4u);
        EXPECT_LE(polygon->vertices().size(), 8u);
        ++polygons;
      } else {
        ++discs;
      }
      EXPECT_LE(agent.speed, kUnitSpeed);
      EXPECT_GE(2 * agent.speed, kUnitSpeed);
    }
  }
  EXPECT_GT(polygons, 5);
  EXPECT_GT(discs, 5 + polygons);
}

TEST(RandomRoadmap, InSpace) {
  const auto distance3 = [](const Point& p, const Point& q) {
    return std::hypot(number(p.x - q.x), number(p.y - q.y), number(p.z - q.z));
  };
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    RandomInstanceOptions options;
    options.num_vertices = 40;
    options.num_agents = 12;
    options.width = options.height = 5'000'000;
    options.altitude = 4'000'000;
    options.mixed = true;
    if (seed % 2 == 1) options.reach = Length{3'000'000};
    const auto drawn = random_instance(options, seed);
    if (!drawn && options.reach) continue;  // It fell apart.
    const Roadmap& roadmap = drawn.value().roadmap();
    const auto& places = roadmap.positions();
    EXPECT_FALSE(roadmap.is_flat());
    std::set<std::pair<std::size_t, std::size_t>> edges, expected;
    for (const Edge& e : roadmap.edges()) edges.emplace(e.from.index(), e.to.index());
    for (std::size_t u = 0; u < places.size(); ++u)
      for (std::size_t v = 0; v < places.size(); ++v) {
        if (u == v) continue;
        EXPECT_GE(distance3(places[u], places[v]), std::sqrt(8) * number(options.radius) - 1);
        // Of the Gabriel graph: nobody is in the ball between the two.
        const auto is_between = [&](const Point& w) {
          return std::hypot(distance3(places[u], w), distance3(places[v], w)) <=
                 distance3(places[u], places[v]);
        };
        const auto num_between = std::count_if(places.begin(), places.end(), is_between);
        if (options.reach ? distance3(places[u], places[v]) <= number(*options.reach)
                          : num_between == 2)  // The two themselves.
          expected.emplace(u, v);
      }
    EXPECT_EQ(edges, expected);
    for (const Agent& agent : drawn->agents())
      EXPECT_TRUE(std::holds_alternative<Disc>(agent.body));
    Length highest = 0;
    for (const Point& p : places) {
      EXPECT_GE(p.z, Length{0});
      highest = std::max(highest, p.z);
    }
    EXPECT_LE(highest, options.altitude);
    EXPECT_GT(2 * highest, options.altitude);
  }
}

TEST(RandomRoadmap, HasAllEdgesWithinTheReach) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomInstanceOptions options;
    options.num_vertices = 60;
    options.num_agents = 0;  // Not all vertices can be reached with a small reach.
    options.width = 12'000'000;
    options.height = 17'000'000;
    options.reach = Length(500'000 + 1'500'000 * static_cast<std::int64_t>(seed));
    const Instance instance = random_instance(options, seed).value();
    const auto& positions = instance.roadmap().positions();
    std::vector<Edge> expected;
    for (std::size_t u = 0; u < positions.size(); ++u)
      for (std::size_t v = 0; v < positions.size(); ++v)
        if (u != v && std::hypot(number(positions[u].x - positions[v].x),
                                 number(positions[u].y - positions[v].y)) <= number(*options.reach))
          expected.push_back({VertexId(u), VertexId(v), std::nullopt});
    EXPECT_EQ(instance.roadmap().edges(), expected);
    options.reach.reset();
    EXPECT_EQ(random_instance(options, seed).value().roadmap().positions(), positions);
  }
}

TEST(RandomRoadmap, TheSeedDecides) {
  const auto make = [](std::uint64_t seed) { return random_instance({}, seed).value(); };
  EXPECT_EQ(make(3).roadmap().positions(), make(3).roadmap().positions());
  EXPECT_EQ(make(3).agents(), make(3).agents());
  EXPECT_NE(make(3).roadmap().positions(), make(4).roadmap().positions());
}

TEST(RandomRoadmap, RefusesWhatCannotBe) {
  const auto refused = [](auto change) {
    RandomInstanceOptions options;
    change(options);
    const auto made = random_instance(options, 1);
    return !made.has_value() && made.error().code == ErrorCode::out_of_range;
  };
  EXPECT_TRUE(refused([](auto& o) { o.num_vertices = 0; }));
  EXPECT_TRUE(refused([](auto& o) { o.num_vertices = kMaxRandomVertices + 1; }));
  EXPECT_TRUE(refused([](auto& o) { o.num_agents = 101; }));
  EXPECT_TRUE(refused([](auto& o) { o.width = 0; }));
  EXPECT_TRUE(refused([](auto& o) { o.height = geometry::kMaxLength + 1; }));
  EXPECT_TRUE(refused([](auto& o) { o.altitude = -1; }));
  EXPECT_TRUE(refused([](auto& o) { o.altitude = geometry::kMaxLength + 1; }));
  EXPECT_TRUE(refused([](auto& o) { o.radius = 0; }));
  EXPECT_TRUE(refused([](auto& o) { o.radius = geometry::kMaxLength; }));
  EXPECT_TRUE(refused([](auto& o) { o.radius = 4'000'000; }));  // they do not fit
  EXPECT_TRUE(refused([](auto& o) { o.reach = Length(0); }));
  EXPECT_TRUE(refused([](auto& o) { o.reach = geometry::kMaxLength + 1; }));
  EXPECT_TRUE(refused([](auto& o) {
    o.num_vertices = 3000;
    o.width = o.height = 100'000'000;
    o.reach = geometry::kMaxLength;
  }));
  EXPECT_TRUE(refused([](auto& o) { o.speed = 0; }));
  EXPECT_TRUE(refused([](auto& o) { o.resolution = 0; }));
}

}  // namespace
}  // namespace quadrille::continuous
