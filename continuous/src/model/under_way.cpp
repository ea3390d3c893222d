// SPDX-License-Identifier: MIT
#include "quadrille/continuous/under_way.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace quadrille::continuous {

Ticks ticks_behind(double fraction, Ticks whole) {
  QUADRILLE_REQUIRE(fraction >= 0 && fraction <= 1, "a part of the move");
  QUADRILLE_REQUIRE(whole >= 1, "a move that takes some time");
  const double ticks = fraction * static_cast<double>(whole.value());
  const double nearest = std::round(ticks);
  const bool is_meant = std::abs(ticks - nearest) <= 1e-9 * nearest;
  const auto behind = static_cast<std::int64_t>(is_meant ? nearest : std::floor(ticks));
  return Ticks(std::clamp<std::int64_t>(behind, 0, whole.value() - 1));
}

Point nearest_point(const Point& from, const Point& to, Ticks behind, Ticks whole) {
  const long double share =
      static_cast<long double>(behind.value()) / static_cast<long double>(whole.value());
  const auto between = [&](Length a, Length b) {
    return a + Length(static_cast<std::int64_t>(
                   std::round(static_cast<long double>((b - a).value()) * share)));
  };
  return {between(from.x, to.x), between(from.y, to.y), between(from.z, to.z)};
}

VertexId add_lane_place(RoadmapParts& parts, VertexId from, VertexId to, Ticks whole,
                        Ticks behind) {
  for (const VertexId v : {from, to})
    QUADRILLE_REQUIRE(v.index() < parts.vertices.size(), "a vertex of the roadmap");
  QUADRILLE_REQUIRE(0 <= behind && behind < whole, "a part of the move");
  const VertexId place(parts.vertices.size());
  parts.vertices.push_back(
      nearest_point(parts.vertices[from.index()], parts.vertices[to.index()], behind, whole));
  const auto lane = std::find_if(parts.edges.begin(), parts.edges.end(), [&](const Edge& edge) {
    return edge.from == from && edge.to == to;
  });
  const ShapeId shape = lane == parts.edges.end() ? ShapeId() : lane->shape;
  if (!parts.shapes.empty() || shape != ShapeId()) {
    parts.shapes.resize(parts.vertices.size());
    parts.shapes.back() = shape;
  }
  parts.edges.push_back({place, to, whole - behind, Groups::all(), shape});
  parts.lane_places.push_back({place, from, to, behind, whole});
  return place;
}

}  // namespace quadrille::continuous
