// SPDX-License-Identifier: MIT
// What the shape of bodies has to do with the cost.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

Body rectangle(Length half_width, Length half_height) {
  return ConvexPolygon::make({{-half_width, -half_height},
                              {half_width, -half_height},
                              {half_width, half_height},
                              {-half_width, half_height}})
      .value();
}

/// A regular polygon inside of a disc of this radius, or around it; up to rounding, which keeps
/// both promises.
Body regular(Length radius, std::size_t corners, bool is_around) {
  const double half = std::numbers::pi / static_cast<double>(corners);
  const double size = is_around ? static_cast<double>(radius.value()) / std::cos(half) + 2
                                : static_cast<double>(radius.value());
  std::vector<Point> points;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2 * half * static_cast<double>(k);
    const auto coordinate = [&](double part) {
      return Length(static_cast<std::int64_t>(std::trunc(size * part)));
    };
    points.push_back({coordinate(std::cos(angle)), coordinate(std::sin(angle))});
  }
  return ConvexPolygon::make(std::move(points)).value();
}

TEST(ContinuousBodies, WhatFitsPastDependsOnTheShape) {
  // Two parallel roads 100 apart: flat bodies pass each other, high ones do not.
  const auto roads = roadmap({{0, 0}, {1000, 0}, {0, 100}, {1000, 100}}, {{0, 1}, {2, 3}});
  for (const auto& [half_height, fits] : {std::pair(Length{50}, true), {Length{51}, false}}) {
    std::vector<Agent> agents{{VertexId(0), VertexId(1), rectangle(400, 50), kUnitSpeed},
                              {VertexId(3), VertexId(2), rectangle(90, half_height), kUnitSpeed}};
    const auto instance = Instance::make(roads, agents);
    ASSERT_TRUE(instance.has_value());
    const SolveOutcome outcome = solve(*instance, {}).value();
    EXPECT_EQ(outcome.status, fits ? Status::optimal : Status::infeasible);
    if (fits) {
      EXPECT_EQ(outcome.cost, 2000);
    }
  }
  // Discs that contain them do not even fit at the starts: 403 + 103 > 100 only matters where they
  // pass, so it is the way that is too narrow.
  const auto discs = Instance::make(roads, {{VertexId(0), VertexId(1), Disc{404}, kUnitSpeed},
                                            {VertexId(3), VertexId(2), Disc{104}, kUnitSpeed}})
                         .value();
  EXPECT_EQ(solve(discs, {}).value().status, Status::infeasible);
}

TEST(ContinuousBodies, APolygonBesideItsPositionIsWhereItSays) {
  // The body trails 200 behind its position, so that the leader's position is what the follower has
  // to mind: it waits until its front no longer reaches the body.
  const auto line = roadmap({{0, 0}, {1000, 0}, {2000, 0}}, {{0, 1}, {1, 2}});
  const Body trailing =
      ConvexPolygon::make({{-300, -10}, {-200, -10}, {-200, 10}, {-300, 10}}).value();
  const Instance instance =
      Instance::make(line, {{VertexId(1), VertexId(2), trailing, kUnitSpeed},
                            {VertexId(0), VertexId(1), Disc{100}, 2 * kUnitSpeed}})
          .value();
  // The follower's front is at 2 (t - wait) + 100, the trailer's back at 1000 + t - 300. When the
  // follower arrives, 500 ticks after its start, these touch: 1100 = 700 + 500 + wait - 100 holds
  // without a wait.
  EXPECT_EQ(solve(instance, {}).value().cost, 1000 + 500);
  const Body longer =
      ConvexPolygon::make({{-450, -10}, {-200, -10}, {-200, 10}, {-450, 10}}).value();
  const Instance later =
      Instance::make(line, {{VertexId(1), VertexId(2), longer, kUnitSpeed},
                            {VertexId(0), VertexId(1), Disc{100}, 2 * kUnitSpeed}})
          .value();
  // Now the back is at 1050 after 500 ticks, and the front at 1100: 50 ticks more.
  EXPECT_EQ(solve(later, {}).value().cost, 1000 + 550);
}

TEST(ContinuousBodies, LargerBodiesCostNoLess) {
  int compared = 0, different = 0;
  for (std::uint64_t seed = 0; seed < support::scaled(24); ++seed) {
    SCOPED_TRACE(seed);
    RandomInstanceOptions options;
    options.num_vertices = 14;
    options.num_agents = 4 + seed % 3;
    options.width = 5'000 + Length(static_cast<std::int64_t>(seed % 4) * 500);
    options.height = 5'000;
    options.radius = 400;
    const Instance discs = random_instance(options, seed).value();
    const auto solved = [&](const auto& body_of) -> std::optional<SolveOutcome> {
      std::vector<Agent> agents = discs.agents().items();
      for (Agent& agent : agents) agent.body = body_of(std::get<Disc>(agent.body).radius);
      const auto instance = Instance::make(discs.shared_roadmap(), std::move(agents));
      if (!instance) return std::nullopt;
      SolveOptions solve_options;
      solve_options.limits.conflicts = 20'000;
      const SolveOutcome outcome = solve(*instance, solve_options).value();
      if (outcome.plan) {
        EXPECT_TRUE(verify(*instance, *outcome.plan).valid());
      }
      if (outcome.status != Status::optimal) return std::nullopt;
      return outcome;
    };
    const auto inside = solved([](Length radius) { return regular(radius, 64, false); });
    const auto disc = solved([](Length radius) { return Body(Disc{radius}); });
    const auto around = solved([](Length radius) { return regular(radius, 64, true); });
    const auto square = solved([](Length radius) { return rectangle(radius, radius); });
    if (inside && disc) {
      EXPECT_LE(*inside->cost, *disc->cost);
    }
    if (disc && around) {
      EXPECT_LE(*disc->cost, *around->cost);
    }
    if (disc && square) {
      EXPECT_LE(*disc->cost, *square->cost);
    }
    if (!inside || !disc || !around || !square) continue;
    ++compared;
    if (*square->cost > *disc->cost) ++different;
    // 64 corners are within 0.2 % of the disc: a unit or two, twice for each meeting.
    EXPECT_LE(*around->cost - *inside->cost, 200);
  }
  EXPECT_GT(compared, static_cast<int>(support::scaled(24)) / 3);
  EXPECT_GT(different, 0);
}

}  // namespace
}  // namespace quadrille::continuous::test
