// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous::test {

/// Pairs of vertices.
using Roads = std::vector<std::pair<std::size_t, std::size_t>>;

[[nodiscard]] inline std::shared_ptr<const Roadmap> roadmap(std::vector<Point> points,
                                                            const Roads& both_ways,
                                                            const Roads& one_way = {}) {
  std::vector<Edge> edges;
  for (const auto& [u, v] : both_ways) {
    edges.push_back({VertexId(u), VertexId(v), std::nullopt});
    edges.push_back({VertexId(v), VertexId(u), std::nullopt});
  }
  for (const auto& [u, v] : one_way) edges.push_back({VertexId(u), VertexId(v), std::nullopt});
  return std::make_shared<const Roadmap>(
      Roadmap::make(std::move(points), std::move(edges)).value());
}

[[nodiscard]] inline Agent agent(std::size_t start, std::size_t goal, Length radius,
                                 Speed speed = kUnitSpeed) {
  return {VertexId(start), VertexId(goal), Disc{radius}, speed};
}

}  // namespace quadrille::continuous::test
