// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "support/random.hpp"

namespace quadrille::dispatch::test {

/// Crossings 1,000 length units apart, moved about by up to `jitter`; roads between neighbours take
/// as many ticks as they are long, in tens.
inline std::shared_ptr<const continuous::Roadmap> grid(std::size_t columns, std::size_t rows,
                                                       std::int64_t jitter, std::uint64_t seed) {
  support::Random random(seed);
  const auto off = [&] {
    return jitter == 0
               ? std::int64_t{0}
               : static_cast<std::int64_t>(random.below(static_cast<std::size_t>(2 * jitter + 1))) -
                     jitter;
  };
  std::vector<continuous::Point> points;
  std::vector<continuous::Edge> edges;
  for (std::size_t v = 0; v < columns * rows; ++v)
    points.push_back({continuous::Length(1000 * static_cast<std::int64_t>(v % columns) + off()),
                      continuous::Length(1000 * static_cast<std::int64_t>(v / columns) + off())});
  const auto road = [&](std::size_t v, std::size_t w) {
    edges.push_back({VertexId(v), VertexId(w), {}});
    edges.push_back({VertexId(w), VertexId(v), {}});
  };
  for (std::size_t v = 0; v < columns * rows; ++v) {
    if (v % columns + 1 < columns) road(v, v + 1);
    if (v + columns < columns * rows) road(v, v + columns);
  }
  return std::make_shared<const continuous::Roadmap>(
      continuous::Roadmap::make(std::move(points), std::move(edges)).value());
}

/// At the first vertices in some order, two kinds.
inline std::vector<continuous::Agent> robots_on(const continuous::Roadmap& roadmap,
                                                std::size_t count, std::uint64_t seed,
                                                continuous::Length radius = 300) {
  support::Random random(seed);
  std::vector<VertexId> places;
  for (std::size_t v = 0; v < roadmap.num_vertices(); ++v) places.emplace_back(v);
  random.shuffle(places);
  std::vector<continuous::Agent> robots;
  for (std::size_t i = 0; i < count; ++i) {
    continuous::Agent robot{places[i], places[i],
                            continuous::Disc{i % 2 == 0 ? radius : radius - 50}};
    robot.speed = 100'000'000;
    if (i % 3 == 0) robot.speed = 80'000'000;
    robots.push_back(robot);
  }
  return robots;
}

}  // namespace quadrille::dispatch::test
