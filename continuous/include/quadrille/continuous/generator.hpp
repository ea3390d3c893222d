// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// Most vertices and edges that random_instance makes.
inline constexpr std::size_t kMaxRandomVertices = 20'000, kMaxRandomEdges = 5'000'000;

/// Lengths are in length units.
struct RandomInstanceOptions {
  std::size_t num_vertices = 100;  ///< 1 .. kMaxRandomVertices
  std::size_t num_agents = 10;     ///< At most num_vertices.
  Length width = 32'000'000;       ///< 1 .. geometry::kMaxLength
  Length height = 32'000'000;      ///< The same.
  /// How high the places are above the plane, at most: 0 .. kMaxLength. With 0 the roadmap is flat.
  Length altitude = 0;
  Length radius = 353'553;   ///< Of the largest agents; 1 .. kMaxLength / 4.
  Speed speed = kUnitSpeed;  ///< Of the fastest agents.
  /// Edges between all vertices that are no further apart, 1 .. kMaxLength; absent: those of the
  /// Gabriel graph.
  std::optional<Length> reach;
  /// Radii and speeds from half of these up; half of the agents are polygons, unless there are
  /// altitudes.
  bool mixed = false;
  double resolution = kDefaultResolution;
};

/// A random roadmap with random tasks. The vertices are at least 2 sqrt(2) radius apart; the edges,
/// in both directions, are those of their Gabriel graph: u and v are connected unless another
/// vertex lies in the disc (ball) that has the segment between them as diameter, or on its
/// boundary. So the roadmap is connected, in the plane no two edges cross, and no edge comes nearer
/// than 2 radius to a vertex that is not its end: an agent at rest is in the way of nobody but
/// those who pass its vertex. With a `reach` nothing of that holds: the roadmap is as dense as that
/// makes it, and may fall apart. Polygons of mixed fleets have four to eight corners on a circle of
/// the radius drawn. Starts are distinct, and so are goals; a start may be its own goal or another
/// agent's. The same options and seed give the same instance on every platform. Errors:
/// out_of_range for options outside the ranges above, for vertices that do not fit into the area,
/// and for more than kMaxRandomEdges; no_plan if a goal cannot be reached, which needs a small
/// reach. O(vertices^2 * log); with a reach O(edges * log).
[[nodiscard]] Result<Instance> random_instance(const RandomInstanceOptions& options,
                                               std::uint64_t seed);

}  // namespace quadrille::continuous

QUADRILLE_API_END
