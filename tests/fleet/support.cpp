// SPDX-License-Identifier: MIT
#include "fleet/support.hpp"

#include <vector>

#include "support/random.hpp"

namespace quadrille::fleet::test {
namespace {

using quadrille::support::Random;

/// 4 x 4 vertices about two metres apart, near ones joined.
Roadmap random_roadmap(Random& random) {
  constexpr std::size_t kSide = 4;
  const auto shift = [&] { return Metres(static_cast<double>(random.below(800)) / 1000); };
  RoadmapBuilder roads({.length = 1_mm, .time = random.percent(50) ? 10_ms : 50_ms});
  for (std::size_t i = 0; i < kSide * kSide; ++i)
    roads.vertex(static_cast<double>(i % kSide) * 2_m + shift(),
                 static_cast<double>(i / kSide) * 2_m + shift());
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    const bool has_right = i % kSide + 1 < kSide, has_below = i + kSide < kSide * kSide;
    if (has_right) roads.road(VertexId(i), VertexId(i + 1));
    if (has_below) roads.road(VertexId(i), VertexId(i + kSide));
    if (has_right && has_below && random.percent(40))
      roads.lane(VertexId(i), VertexId(i + kSide + 1));
  }
  return roads.build().value();
}

Body random_body(Random& random) {
  if (random.percent(60)) return Disc(random.percent(50) ? 0.35_m : 0.2_m);
  return Polygon({{-0.3_m, -0.2_m}, {0.3_m, -0.2_m}, {0.3_m, 0.2_m}, {-0.3_m, 0.2_m}});
}

}  // namespace

Roadmap line(std::size_t num_vertices, Resolution resolution) {
  RoadmapBuilder roads(resolution);
  for (std::size_t i = 0; i < num_vertices; ++i) {
    const VertexId v = roads.vertex(Metres(static_cast<double>(i)), 0_m,
                                    std::string(1, static_cast<char>('a' + i)));
    if (i > 0) roads.road(VertexId(i - 1), v);
  }
  return roads.build().value();
}

Fleet random_fleet(std::uint32_t seed, std::size_t num_robots) {
  Random random(seed);
  Fleet fleet(random_roadmap(random));
  std::vector<VertexId> starts, goals;
  for (const VertexId v : fleet.roadmap().vertex_ids()) starts.push_back(v);
  goals = starts;
  random.shuffle(starts);
  random.shuffle(goals);
  const std::vector<MetresPerSecond> speeds{0.5_mps, 0.8_mps, 1.2_mps};
  for (std::size_t i = 0; i < num_robots; ++i)
    fleet.robot({.name = {}, .body = random_body(random), .speed = random.pick(speeds)})
        .from(starts[i])
        .to(goals[i]);
  return fleet;
}

}  // namespace quadrille::fleet::test
