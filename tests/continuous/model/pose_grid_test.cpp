// SPDX-License-Identifier: MIT
#include "quadrille/continuous/pose_grid.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>

namespace quadrille::continuous::test {
namespace {

/// Three cells in an L: the one in the lower right corner is blocked.
OccupancyGrid corner() { return {2, 2, {true, true, true, false}}; }

TEST(PoseGrid, HasAVertexForEachCellAndHeading) {
  const auto grid = PoseGrid::make(corner(), 2).value();
  EXPECT_EQ(grid.turn(), Ticks(2));
  EXPECT_EQ(grid.cells().roadmap()->num_vertices(), 3U);
  ASSERT_EQ(grid.roadmap()->num_vertices(), 12U);
  std::set<VertexId> seen;
  for (const Cell cell : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}}) {
    const auto goals = grid.any_heading(cell);
    ASSERT_TRUE(goals);
    EXPECT_EQ(goals->size(), 4U);
    for (const Heading heading : kHeadings) {
      const Pose pose{cell, heading};
      const auto v = grid.vertex(pose);
      ASSERT_TRUE(v);
      EXPECT_EQ(grid.pose(*v), pose);
      EXPECT_TRUE(goals->contains(*v));
      EXPECT_TRUE(seen.insert(*v).second);
      EXPECT_EQ(grid.roadmap()->position(*v),
                (Point{std::int64_t{cell.x} * Length(100), std::int64_t{cell.y} * Length(100)}));
    }
  }
  EXPECT_FALSE(grid.vertex({{1, 1}, Heading::east}));
  EXPECT_FALSE(grid.vertex({{2, 0}, Heading::east}));
  EXPECT_FALSE(grid.any_heading({1, 1}));
  EXPECT_FALSE(grid.any_heading({0, -1}));
}

TEST(PoseGrid, MovesAheadAndTurnsByQuarters) {
  const auto grid = PoseGrid::make(corner(), 2).value();
  const Roadmap& roads = *grid.roadmap();
  std::set<std::pair<VertexId, VertexId>> moves;
  std::size_t num_turns = 0;
  for (const Edge& edge : roads.edges()) {
    const Pose from = grid.pose(edge.from), to = grid.pose(edge.to);
    if (from.cell == to.cell) {
      EXPECT_EQ(edge.duration, Ticks(2));
      EXPECT_TRUE(to.heading == left_of(from.heading) || to.heading == right_of(from.heading));
      ++num_turns;
    } else {
      EXPECT_EQ(edge.duration, Ticks(1));
      EXPECT_EQ(from.heading, to.heading);
      moves.insert({edge.from, edge.to});
    }
  }
  EXPECT_EQ(num_turns, 3U * 4 * 2);
  const auto at = [&](Cell cell, Heading heading) { return grid.vertex({cell, heading}).value(); };
  const std::set<std::pair<VertexId, VertexId>> expected{
      {at({0, 0}, Heading::east), at({1, 0}, Heading::east)},
      {at({1, 0}, Heading::west), at({0, 0}, Heading::west)},
      {at({0, 0}, Heading::south), at({0, 1}, Heading::south)},
      {at({0, 1}, Heading::north), at({0, 0}, Heading::north)}};
  EXPECT_EQ(moves, expected);
}

TEST(PoseGrid, NamesItsHeadingsClockwise) {
  EXPECT_EQ(to_string(Heading::east), "east");
  EXPECT_EQ(to_string(right_of(Heading::east)), "south");
  EXPECT_EQ(to_string(right_of(Heading::south)), "west");
  EXPECT_EQ(to_string(left_of(Heading::east)), "north");
  for (const Heading heading : kHeadings) EXPECT_EQ(left_of(right_of(heading)), heading);
}

TEST(PoseGrid, RefusesTurnsThatTakeNoTimeOrTooLong) {
  for (const Ticks turn : {Ticks(0), Ticks(-1), geometry::kMaxDuration + 1}) {
    const auto grid = PoseGrid::make(corner(), turn);
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::out_of_range);
  }
  EXPECT_TRUE(PoseGrid::make(corner(), geometry::kMaxDuration));
}

}  // namespace
}  // namespace quadrille::continuous::test
