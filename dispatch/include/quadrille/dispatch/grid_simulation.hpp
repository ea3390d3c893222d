// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/dispatch/grid_dispatcher.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

struct GridSimulationOptions {
  double pause_chance = 0;       ///< That a robot which does not pause begins to, per step; 0 .. 1.
  Timestep longest_pause = 1;    ///< At least 1; the shortest takes 1.
  Timestep service = 0;          ///< Of random tasks.
  bool has_random_tasks = true;  ///< Whoever has none gets another one, at any vertex.
  std::uint64_t seed = 0;
};

/// Robots on a grid or graph that obey a dispatcher, are held up at random, and get tasks at
/// random. All that is drawn is the same on every platform. One thread at a time.
class GridSimulation {
 public:
  /// `graph`: of the dispatcher, which outlives this.
  GridSimulation(GridDispatcher& dispatcher, std::shared_ptr<const discrete::Graph> graph,
                 const GridSimulationOptions& options);

  /// A call of the dispatcher: one timestep.
  News step(const Limits& limits = {});

  /// Timesteps between assignment and end of each task that is done, in order.
  [[nodiscard]] const std::vector<Timestep>& service_times() const noexcept {
    return service_times_;
  }
  /// Robots that were in one vertex, changed places, went where no edge leads or went on while held
  /// up, by their places alone. Anything but 0 is a defect.
  [[nodiscard]] std::size_t num_contacts() const noexcept { return num_contacts_; }
  /// The most timesteps in which some robot has not moved and had something to do elsewhere, was
  /// not held up and has not been served.
  [[nodiscard]] Timestep longest_stay() const noexcept { return longest_stay_; }

 private:
  void draw_tasks();
  void draw_pauses();
  void look(const std::vector<VertexId>& before);

  GridDispatcher& dispatcher_;
  const std::shared_ptr<const discrete::Graph> graph_;
  const GridSimulationOptions options_;
  Random random_;
  std::vector<Timestep> paused_until_, still_since_;
  std::vector<std::vector<Timestep>> since_;  // of the tasks of each robot, in order
  std::vector<AgentId> held_;                 // in this step
  std::vector<Timestep> service_times_;
  std::size_t num_contacts_ = 0;
  Timestep longest_stay_ = 0;
};

}  // namespace quadrille::dispatch

QUADRILLE_API_END
