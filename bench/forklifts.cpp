// SPDX-License-Identifier: MIT
// What it brings that outlines turn with their robots: forklifts of 1.2 m x 0.8 m in parallel
// aisles between two ways across, as rectangles and as the discs around them. Prints a table by the
// distance of the aisles: random instances of each that have a plan of least cost, and what these
// plans cost together where both have one.
#include <cstddef>
#include <iostream>
#include <optional>
#include <quadrille/core/random.hpp>
#include <quadrille/fleet/pose_builder.hpp>
#include <quadrille/fleet/solver.hpp>
#include <vector>

using namespace quadrille;
using namespace quadrille::fleet;
using namespace quadrille::units;

namespace {

constexpr std::size_t kAisles = 4, kPlaces = 5, kRobots = 5, kInstances = 20;

Roadmap make_aisles(Metres apart) {
  RoadmapBuilder roads({.length = 1_mm, .time = 100_ms});
  for (std::size_t a = 0; a < kAisles; ++a)
    for (std::size_t k = 0; k < kPlaces; ++k)
      roads.vertex(2_m * static_cast<double>(k), apart * static_cast<double>(a));
  const auto place = [](std::size_t a, std::size_t k) { return VertexId(a * kPlaces + k); };
  for (std::size_t a = 0; a < kAisles; ++a)
    for (std::size_t k = 0; k + 1 < kPlaces; ++k) roads.road(place(a, k), place(a, k + 1));
  for (std::size_t a = 0; a + 1 < kAisles; ++a)
    for (const std::size_t k : {std::size_t{0}, kPlaces - 1})
      roads.road(place(a, k), place(a + 1, k));
  return roads.build().value();
}

/// Nullopt if there is no plan of least cost within the limit, or starts or goals overlap.
std::optional<Seconds> cost(const PoseRoadmap& poses, const Body& body, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::size_t> starts, goals;
  for (std::size_t place = 0; place < poses.num_places(); ++place) {
    starts.push_back(place);
    goals.push_back(place);
  }
  random.shuffle_front(starts, kRobots);
  random.shuffle_front(goals, kRobots);
  Fleet fleet(poses.roadmap());
  for (std::size_t i = 0; i < kRobots; ++i)
    fleet.robot({.body = body, .speed = 1_mps})
        .from(poses.facing(VertexId(starts[i]), random.below(2) == 0 ? 0_deg : 180_deg))
        .to_any(poses.any_heading(VertexId(goals[i])));
  SolveOptions options;
  options.limits.cpu = 10_s;
  const auto outcome = solve(fleet, options);
  if (!outcome || outcome->status != Status::optimal) return std::nullopt;
  return outcome->cost;
}

}  // namespace

int main() {
  const Body rectangle =
      Polygon({{-0.6_m, -0.4_m}, {0.6_m, -0.4_m}, {0.6_m, 0.4_m}, {-0.6_m, 0.4_m}});
  const Body disc = Disc(0.722_m);
  std::cout << "| aisles apart | rectangles: solved | discs: solved | cost, rectangles | discs |\n"
               "|--:|--:|--:|--:|--:|\n";
  for (const Metres apart : {0.9_m, 1_m, 1.2_m, 1.4_m, 1.5_m, 1.6_m, 2_m}) {
    const auto poses = PoseBuilder(make_aisles(apart), 90_degps).build().value();
    std::size_t rectangles = 0, discs = 0, both = 0;
    Seconds cost_of_rectangles{}, cost_of_discs{};
    for (std::uint64_t seed = 0; seed < kInstances; ++seed) {
      const auto a = cost(poses, rectangle, seed), b = cost(poses, disc, seed);
      rectangles += a ? 1 : 0;
      discs += b ? 1 : 0;
      if (!a || !b) continue;
      ++both;
      cost_of_rectangles = cost_of_rectangles + *a;
      cost_of_discs = cost_of_discs + *b;
    }
    std::cout << "| " << to_string(apart) << " | " << rectangles << " | " << discs << " | ";
    if (both > 0)
      std::cout << to_string(cost_of_rectangles) << " | " << to_string(cost_of_discs) << " |\n";
    else
      std::cout << "- | - |\n";
    std::cout.flush();
  }
}
