// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/dispatch/grid_dispatcher.hpp"
#include "quadrille/dispatch/task_feed.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

/// Robots on a grid or graph that obey a dispatcher, are held up at random, and get tasks at
/// random. All that is drawn is the same on every platform. One thread at a time.
class GridSimulation {
 public:
  /// `graph`: of the dispatcher, which is new and outlives this. Requires a step of 1.
  GridSimulation(GridDispatcher& dispatcher, std::shared_ptr<const discrete::Graph> graph,
                 const SimulationOptions& options);

  /// A call of the dispatcher: one timestep.
  News step(const Limits& limits = {});

  /// Timesteps between assignment and end of each task that is done, in order.
  [[nodiscard]] const std::vector<Ticks>& service_times() const noexcept {
    return feed_.service_times();
  }
  /// Robots that were in one vertex, changed places, went where no edge leads or went on while held
  /// up, by their places alone. Anything but 0 is a defect.
  [[nodiscard]] std::size_t num_contacts() const noexcept { return num_contacts_; }
  /// The most timesteps in which some robot has not moved and had something to do elsewhere, was
  /// not held up and has not been served.
  [[nodiscard]] Timestep longest_stay() const noexcept { return longest_stay_; }
  /// Timesteps since it began.
  [[nodiscard]] Ticks time() const noexcept { return Ticks(std::int64_t{dispatcher_.now()}); }

 private:
  void draw_pauses();
  void show() const;
  void look(const std::vector<VertexId>& before);

  GridDispatcher& dispatcher_;
  const std::shared_ptr<const discrete::Graph> graph_;
  const SimulationOptions options_;
  Random random_;
  TaskFeed feed_;
  std::vector<Timestep> paused_until_, still_since_;
  std::vector<AgentId> held_;  // in this step
  std::size_t num_contacts_ = 0;
  Timestep longest_stay_ = 0;
};

}  // namespace quadrille::dispatch

QUADRILLE_API_END
