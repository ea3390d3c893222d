// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "asked/track_recorder.hpp"
#include "fleets/dispatch.hpp"
#include "fleets/dispatch_report.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/task_feed.hpp"

namespace quadrille::cli {

/// What a fleet has to do, and where.
struct DispatchWork {
  std::vector<dispatch::Task> own;  ///< Goals and deadline of each robot.
  /// Besides: the places to go to, one after the other; so many of them per robot are known.
  std::vector<std::vector<Goals>> tasks;
  double num_revealed = 1;
  bool is_on_grid = false;
  double tick_size = 1;  ///< In the unit of the input.
  /// Of a vertex, in any unit.
  std::function<std::array<double, 2>(VertexId)> position;
};

/// Lets a fleet work, and takes note.
class DispatchRun {
 public:
  using Ticks = dispatch::Ticks;

  /// Keeps a reference to the arguments.
  DispatchRun(const DispatchArguments& arguments, DispatchWork work);

  /// Of a dispatcher that is simulated.
  struct Fleet {
    dispatch::TaskFeed::Assign assign;
    std::function<VertexId(AgentId)> end;  ///< Where the robot will be free.
    /// Begins the simulation. A call of the dispatcher; what has become of it all.
    std::function<void(const dispatch::SimulationOptions&)> begin;
    std::function<dispatch::News(const Limits&)> step;
    std::function<std::size_t()> num_contacts;
    std::function<std::vector<Ticks>()> service_times;
  };
  /// Errors: those of the dispatcher, for a task that it does not take.
  [[nodiscard]] std::optional<Error> run(const Fleet& fleet);

  /// Of a run.
  [[nodiscard]] const DispatchReport& report() const noexcept { return report_; }
  /// What everybody did, if `--view` asks for it; in its places and ticks.
  [[nodiscard]] const std::vector<view::Track>& tracks() const noexcept {
    return recorder_.tracks();
  }

 private:
  /// Of a robot: what is left of its task, and since when it has it.
  struct Errands {
    std::size_t left = 0;
    Ticks since = 0;
  };

  [[nodiscard]] double units(Ticks ticks) const {
    return static_cast<double>(ticks.value()) * work_.tick_size;
  }
  [[nodiscard]] std::optional<Error> assign_own_tasks(const Fleet& fleet) const;
  /// Of the tasks that are known, the nearest one to the robot.
  [[nodiscard]] std::vector<dispatch::Task> next_task(AgentId robot, VertexId here, Ticks now);
  void add(const dispatch::News& news, double seconds, Ticks now);
  void serve(AgentId robot, Ticks now);

  const DispatchArguments& arguments_;
  const DispatchWork work_;
  dispatch::SimulationOptions options_;
  std::vector<std::size_t> open_;  // Tasks that nobody has, in order.
  std::vector<Errands> errands_;   // By robot.
  DispatchReport report_;
  TrackRecorder recorder_;
};

}  // namespace quadrille::cli
