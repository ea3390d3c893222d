// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/course.hpp"
#include "quadrille/dispatch/task.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::cli {

/// A dispatcher and what it drives on, as those see it who are served: a roadmap, a grid or a
/// graph. Times are ticks; on grids and graphs these are timesteps. Errors are those of the
/// dispatchers.
class LiveFleet {
 public:
  using Ticks = dispatch::Ticks;

  LiveFleet() = default;
  LiveFleet(const LiveFleet&) = delete;
  LiveFleet& operator=(const LiveFleet&) = delete;
  virtual ~LiveFleet() = default;

  [[nodiscard]] virtual std::size_t num_robots() const = 0;
  [[nodiscard]] virtual std::size_t num_vertices() const = 0;
  /// A tick, and a time, in the unit of the input.
  [[nodiscard]] virtual double tick_size() const = 0;
  [[nodiscard]] virtual double units(Ticks time) const = 0;
  /// In its unit of length; nothing on graphs without places.
  [[nodiscard]] virtual std::optional<std::array<double, 2>> position(
      const dispatch::Spot& spot) const = 0;
  /// How long the robot takes from the vertex to each vertex, alone; the largest number: no way.
  [[nodiscard]] virtual std::vector<Ticks> times_from(AgentId robot, VertexId start) const = 0;

  [[nodiscard]] virtual std::optional<Error> assign(AgentId robot, const dispatch::Task& task) = 0;
  [[nodiscard]] virtual std::optional<Error> cancel(AgentId robot) = 0;
  [[nodiscard]] virtual std::optional<Error> close(VertexId from, VertexId to) = 0;
  [[nodiscard]] virtual std::optional<Error> open(VertexId from, VertexId to) = 0;
  [[nodiscard]] virtual std::optional<Error> report(AgentId robot, Ticks clock) = 0;
  /// Also refuses: `held`, robots that do not take part, where robots have clocks of their own; and
  /// durations that are no timestep where they have not.
  [[nodiscard]] virtual Result<dispatch::News> tick(Ticks duration, std::span<const AgentId> held,
                                                    const Limits& limits) = 0;

  [[nodiscard]] virtual dispatch::Course course(AgentId robot) const = 0;
  [[nodiscard]] virtual Ticks clock(AgentId robot) const = 0;
  [[nodiscard]] virtual Ticks limit(AgentId robot) const = 0;
  [[nodiscard]] virtual Ticks now() const = 0;
  [[nodiscard]] virtual std::size_t num_tasks(AgentId robot) const = 0;
  /// In which moves follow each other; each ends where and when a stop of a course begins.
  [[nodiscard]] virtual execution::Precedences order() const = 0;

 protected:
  [[nodiscard]] static Error refused(const char* message) {
    return {ErrorCode::out_of_range, message, {}};
  }
};

}  // namespace quadrille::cli
