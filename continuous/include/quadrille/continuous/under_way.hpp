// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/continuous/roadmap.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// What a roadmap will be made of, with places of agents in the middle of moves.
struct RoadmapParts {
  std::vector<Point> vertices;
  std::vector<Edge> edges;
  std::vector<LanePlace> lane_places;
  std::vector<ShapeId> shapes;  ///< Of the vertices, or none.
  std::vector<VertexId> no_waiting;

  RoadmapParts() = default;
  explicit RoadmapParts(const Roadmap& roadmap)
      : vertices(roadmap.positions()),
        edges(roadmap.edges()),
        lane_places(roadmap.lane_places()),
        shapes(roadmap.shapes()),
        no_waiting(roadmap.no_waiting()) {}
  /// Roadmap::make.
  [[nodiscard]] Result<Roadmap> make() && {
    return Roadmap::make(std::move(vertices), std::move(edges), std::move(lane_places),
                         std::move(shapes), std::move(no_waiting));
  }
};

/// Appends the place of an agent in the middle of a move between the two vertices: a vertex to
/// which no edge leads, and an edge for the rest of the move, open to all. Returns the vertex. An
/// agent that starts there with Agent::under_way goes on at once, without it the agent may wait
/// there. The place is exact; its shape is that of the first edge between the two. Requires two of
/// the vertices, not in the middle of moves, and 0 <= behind < whole.
VertexId add_lane_place(RoadmapParts& parts, VertexId from, VertexId to, Ticks whole, Ticks behind);

/// So many whole ticks of a move that takes `whole` lie behind an agent that has `fraction` of it
/// behind it: rounded down, where a number that differs from a whole one by a billionth is meant to
/// be that, and at least one tick is left. Requires a fraction in [0, 1] and at least one tick.
[[nodiscard]] Ticks ticks_behind(double fraction, Ticks whole);

/// The point behind / whole of the way, to the nearest length unit in each coordinate.
[[nodiscard]] Point nearest_point(const Point& from, const Point& to, Ticks behind, Ticks whole);

}  // namespace quadrille::continuous

QUADRILLE_API_END
