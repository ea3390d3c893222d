// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "quadrille/core/outcome.hpp"

namespace quadrille::support {

/// Robots that turn on a grid, as the League of Robot Runners has them.
struct TurningTask {
  std::size_t width = 0, height = 0;
  std::vector<bool> passable;  ///< Row by row.
  int turn = 1;                ///< Timesteps of a quarter turn.
  struct Robot {
    std::size_t start = 0, heading = 0;  ///< A cell, row by row; 0 east, 1 south, 2 west, 3 north.
    std::size_t goal = 0;                ///< With any heading.
  };
  std::vector<Robot> robots;
};

/// What the joint search found out.
struct TurningAnswer {
  Status status = Status::unknown;  ///< optimal | infeasible | unknown (too many states).
  Cost cost = 0;                    ///< When optimal; in timesteps.
};

/// The oracle of the tests for robots that turn: best-first search over the joint states of all. In
/// each timestep each robot waits, goes to the cell ahead, or begins a quarter turn, which it then
/// finishes. No two may be in one cell, or change places. The cost of a robot is the time from
/// which on it rests at its goal. Shares nothing with the library. Gives up if there are more than
/// `max_states` states.
[[nodiscard]] TurningAnswer search_poses(const TurningTask& task, Objective objective,
                                         std::size_t max_states = 4'000'000);

/// A small one at random, of one to four robots; now and then two of them have one goal.
[[nodiscard]] TurningTask random_turning_task(std::uint64_t seed);
[[nodiscard]] std::string describe(const TurningTask& task);

}  // namespace quadrille::support
