// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/task.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

/// Where a robot is, in length units; on grids: column and row.
struct Place {
  double x = 0, y = 0, z = 0;
};

/// Of a fleet that is simulated. Times on grids and graphs are timesteps.
struct SimulationOptions {
  Ticks step = 1;                ///< Time from one call to the next; at least 1, on grids 1.
  double pause_chance = 0;       ///< That a robot which goes on pauses, per step; 0 .. 1.
  Ticks longest_pause = 1;       ///< At least 1; the shortest takes 1.
  Ticks service = 0;             ///< Of random tasks.
  bool has_random_tasks = true;  ///< Whoever has none gets another one, at any vertex.
  std::uint64_t seed = 0;
  /// Instead of random tasks: what somebody who has none has to do next, one after the other; an
  /// empty list: nothing now. Each has to be one that the dispatcher takes.
  std::function<std::vector<Task>(AgentId)> next_tasks = {};
  /// Hears, in order of time, where everybody is; between two calls all go straight and evenly. Not
  /// of graphs without places.
  std::function<void(Ticks, const std::vector<Place>&)> watch = {};
};

/// Gives tasks to robots that have none, and takes the time until they are done.
class TaskFeed {
 public:
  /// How a dispatcher takes a task, and how many a robot has.
  using Assign = std::function<std::optional<Error>(AgentId, const Task&)>;
  using Count = std::function<std::size_t(AgentId)>;

  /// Those that robots have already are theirs since `now`.
  TaskFeed(const SimulationOptions& options, std::size_t num_robots, std::size_t num_vertices,
           Assign assign, Count num_tasks, Ticks now);

  void feed(Ticks now, Random& random);
  void finish(std::span<const AgentId> served, Ticks now);
  /// Between assignment and end of each task that is done, in order.
  [[nodiscard]] const std::vector<Ticks>& service_times() const noexcept { return service_times_; }

 private:
  void ask(AgentId robot, Ticks now);
  void draw(AgentId robot, Ticks now, Random& random);

  const std::function<std::vector<Task>(AgentId)> next_tasks_;
  const bool is_random_;
  const Ticks service_;
  const std::size_t num_vertices_;
  const Assign assign_;
  const Count num_tasks_;
  std::vector<std::vector<Ticks>> since_;  // of the tasks of each robot, in order
  std::vector<Ticks> service_times_;
};

/// Draws 0 .. below - 1.
[[nodiscard]] inline Ticks drawn(Random& random, Ticks below) {
  return Ticks(static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(below.value()))));
}

}  // namespace quadrille::dispatch

QUADRILLE_API_END
