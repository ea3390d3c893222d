// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/discrete/plan_improver.hpp"

namespace quadrille::discrete {

/// Makes a long plan shorter, window by window in time: what all agents do between two timesteps is
/// a plan of an instance of its own, from where they are at the one to where they are at the other,
/// and large-neighbourhood search makes it cheaper. Ways of single agents are short there, while in
/// the whole plan each has thousands of timesteps. After a pass over all windows, moves are made as
/// early as the order of visits allows, which is where most of the gain shows. Then another pass,
/// with other boundaries, until one gains little. One thread.
class TimeWindows {
 public:
  /// Requires a valid plan. `instance` outlives the object.
  TimeWindows(const Instance& instance, Plan plan, std::uint32_t seed);
  TimeWindows(const TimeWindows&) = delete;
  TimeWindows& operator=(const TimeWindows&) = delete;

  /// Goes on until `effort` more is spent, a limit is met or it is over.
  void advance(std::int64_t effort, LimitMonitor& limits);
  /// The last pass has hardly gained anything.
  [[nodiscard]] bool is_over() const noexcept { return is_over_; }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }  ///< Spent so far.
  /// What the passes so far have made of it; the plan of the beginning before the first one ends.
  /// Never one of a larger sum of costs than before.
  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
  [[nodiscard]] Cost cost() const noexcept { return cost_; }  ///< Its sum of costs.

 private:
  void begin_pass();
  bool begin_window(LimitMonitor& limits);
  void end_window();
  void end_pass(LimitMonitor& limits);

  const Instance& instance_;
  const std::uint32_t seed_;
  Plan plan_;
  Cost cost_ = 0;
  bool is_over_ = false;
  std::int64_t effort_ = 0;
  std::uint32_t num_passes_ = 0;

  // Of this pass.
  Plan next_;                   // As far as it has come.
  Timestep length_ = 0;         // Of plan_.
  Timestep from_ = 0, to_ = 0;  // Of the window, in plan_.
  std::optional<PlanImprover> window_;
  std::int64_t left_ = 0;  // Effort for the window.
};

}  // namespace quadrille::discrete
