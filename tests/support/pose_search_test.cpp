// SPDX-License-Identifier: MIT
#include "support/pose_search.hpp"

#include <gtest/gtest.h>

#include <string>

namespace quadrille::support {
namespace {

enum : std::size_t { kEast, kSouth, kWest, kNorth };

/// Rows of '.' and '@', all as long as the first.
TurningTask on_map(const std::vector<std::string>& rows, int turn = 1) {
  TurningTask task{rows[0].size(), rows.size(), {}, turn, {}};
  for (const std::string& row : rows)
    for (const char letter : row) task.passable.push_back(letter == '.');
  return task;
}

void expect_costs(const TurningTask& task, Cost sum_of_costs, Cost makespan) {
  const TurningAnswer sum = search_poses(task, Objective::sum_of_costs);
  const TurningAnswer most = search_poses(task, Objective::makespan);
  ASSERT_EQ(sum.status, Status::optimal);
  ASSERT_EQ(most.status, Status::optimal);
  EXPECT_EQ(sum.cost, sum_of_costs);
  EXPECT_EQ(most.cost, makespan);
}

TEST(PoseSearch, OneRobotTurnsWhereItIs) {
  TurningTask task = on_map({"...", "..."});
  task.robots = {{0, kEast, 2}};
  expect_costs(task, 2, 2);
  task.robots = {{0, kWest, 2}};
  expect_costs(task, 4, 4);
  task.robots = {{0, kSouth, 5}};  // one down, a turn, two to the right
  expect_costs(task, 4, 4);
  task.robots = {{4, kNorth, 4}};
  expect_costs(task, 0, 0);
  task.turn = 3;
  task.robots = {{0, kSouth, 5}};
  expect_costs(task, 6, 6);
  task.robots = {{0, kWest, 1}};
  expect_costs(task, 7, 7);
}

TEST(PoseSearch, FollowsAndGoesRoundInASquare) {
  TurningTask task = on_map({"...."});
  task.robots = {{0, kEast, 1}, {1, kEast, 2}, {2, kEast, 3}};
  expect_costs(task, 3, 1);
  task = on_map({"..", ".."});
  task.robots = {{0, kEast, 1}, {1, kSouth, 3}, {3, kWest, 2}, {2, kNorth, 0}};
  expect_costs(task, 4, 1);
}

// Robots that face each other do not pass; with a bay one of them turns into it, waits for the
// other, and turns back.
TEST(PoseSearch, DoesNotSwap) {
  TurningTask task = on_map({"...", "@@@"});
  task.robots = {{0, kEast, 2}, {2, kWest, 0}};
  EXPECT_EQ(search_poses(task, Objective::sum_of_costs).status, Status::infeasible);
  EXPECT_EQ(search_poses(task, Objective::makespan).status, Status::infeasible);
  task = on_map({"...", "@.@"});
  task.robots = {{0, kEast, 2}, {2, kWest, 0}};
  // The first: ahead, right, ahead, 2 turns, ahead, right, ahead. The second passes the bay as soon
  // as the first is in it, at the timesteps 3 and 4.
  expect_costs(task, 12, 8);
}

TEST(PoseSearch, TwoRobotsWithOneGoalHaveNoPlan) {
  TurningTask task = on_map({"..."});
  task.robots = {{0, kEast, 1}, {2, kWest, 1}};
  EXPECT_EQ(search_poses(task, Objective::sum_of_costs).status, Status::infeasible);
}

TEST(PoseSearch, GivesUpOnManyStates) {
  TurningTask task = on_map({"..."});
  task.robots = {{0, kEast, 1}};
  EXPECT_EQ(search_poses(task, Objective::makespan, 11).status, Status::unknown);
  EXPECT_EQ(search_poses(task, Objective::makespan, 12).status, Status::optimal);
}

}  // namespace
}  // namespace quadrille::support
