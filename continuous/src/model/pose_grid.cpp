// SPDX-License-Identifier: MIT
#include "quadrille/continuous/pose_grid.hpp"

#include <utility>
#include <vector>

#include "quadrille/geometry/motion.hpp"

namespace quadrille::continuous {
namespace {

/// Moves without diagonals.
constexpr int kNeighbourhood = 2;

}  // namespace

Result<PoseGrid> PoseGrid::make(const OccupancyGrid& grid, Ticks turn) {
  if (turn < 1 || turn > geometry::kMaxDuration)
    return Error{ErrorCode::out_of_range, "a turn takes one timestep or more", {}};
  auto cells = GridRoadmap::make(grid, kNeighbourhood, kRadius, kResolution);
  if (!cells) return cells.error();
  PoseGrid result(std::move(cells).value(), turn);
  const Roadmap& roads = *result.cells_.roadmap();

  std::vector<Point> places;
  std::vector<Edge> edges;
  places.reserve(kHeadings.size() * roads.num_vertices());
  edges.reserve(2 * kHeadings.size() * roads.num_vertices() + roads.num_edges());
  for (const VertexId v : IdRange<VertexId>(roads.num_vertices()))
    for (const Heading heading : kHeadings) {
      places.push_back(roads.position(v));
      for (const Heading next : {left_of(heading), right_of(heading)})
        edges.push_back({facing(v, heading), facing(v, next), turn});
    }
  for (const Edge& road : roads.edges()) {
    const Cell from = result.cells_.cell(road.from), to = result.cells_.cell(road.to);
    const Heading heading = heading_of_move(to.x - from.x, to.y - from.y);
    edges.push_back({facing(road.from, heading), facing(road.to, heading), Ticks(1)});
  }
  auto roadmap = Roadmap::make(std::move(places), std::move(edges));
  if (!roadmap) return roadmap.error();
  result.roadmap_ = std::make_shared<const Roadmap>(std::move(roadmap).value());
  return result;
}

std::optional<VertexId> PoseGrid::vertex(const Pose& pose) const {
  const auto cell = cells_.vertex(pose.cell);
  if (!cell) return std::nullopt;
  return facing(*cell, pose.heading);
}

std::optional<Goals> PoseGrid::any_heading(Cell cell) const {
  const auto v = cells_.vertex(cell);
  if (!v) return std::nullopt;
  std::vector<VertexId> vertices;
  for (const Heading heading : kHeadings) vertices.push_back(facing(*v, heading));
  return Goals(std::move(vertices));
}

}  // namespace quadrille::continuous
