// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "asked/track_recorder.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/simulation.hpp"
#include "quadrille/input/roadmap.hpp"
#include "roadmap/dispatch_report.hpp"
#include "roadmap/dispatch_roadmap.hpp"

namespace quadrille::cli {

/// Lets a fleet work.
class DispatchRun {
 public:
  /// Keeps references to both.
  DispatchRun(const DispatchArguments& arguments, const input::RoadmapInput& input);

  /// Errors: those of dispatch::Dispatcher, for a fleet or a task that it does not take.
  [[nodiscard]] std::optional<Error> run();
  /// Of a run.
  [[nodiscard]] const DispatchReport& report() const noexcept { return report_; }
  /// What everybody did, if `--view` asks for it.
  [[nodiscard]] const std::vector<view::Track>& tracks() const noexcept {
    return recorder_.tracks();
  }

 private:
  using Ticks = dispatch::Ticks;
  /// Of a robot: what is left of its task, and since when it has it.
  struct Work {
    std::size_t errands = 0;
    Ticks since = 0;
  };

  [[nodiscard]] double units(Ticks ticks) const;
  [[nodiscard]] std::optional<Error> assign_own_tasks(dispatch::Dispatcher& dispatcher) const;
  /// Of the tasks that are known, the nearest one to the robot.
  [[nodiscard]] std::vector<dispatch::Task> next_task(const dispatch::Dispatcher& dispatcher,
                                                      AgentId robot, Ticks now);
  void add(const dispatch::News& news, double seconds, Ticks now);
  void serve(AgentId robot, Ticks now);

  const DispatchArguments& arguments_;
  const input::RoadmapInput& input_;
  const continuous::Instance& instance_;
  dispatch::SimulationOptions options_;
  std::vector<std::size_t> open_;  // Tasks that nobody has, in order.
  std::vector<Work> work_;         // By robot.
  DispatchReport report_;
  TrackRecorder recorder_;
};

}  // namespace quadrille::cli
