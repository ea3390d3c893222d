// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "primal/lacam.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// Makes a long plan shorter: searches from where all agents are at one timestep to where they are
/// many timesteps later may get there sooner. Where a search finds nothing soon, the plan stays as
/// it is. One pass after the other, with shorter and shorter gains. One thread.
class Shortcuts {
 public:
  /// Requires a valid plan. `instance` outlives the object.
  Shortcuts(const Instance& instance, Plan plan, std::uint32_t seed);

  /// Goes on until `effort` more is spent, a limit is met or it is over.
  void advance(std::int64_t effort, LimitMonitor& limits);
  /// The last pass has hardly gained anything.
  [[nodiscard]] bool is_over() const noexcept { return is_over_; }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }  ///< Spent so far.
  /// What the passes so far have made of it; the plan of the beginning before the first one ends.
  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }

 private:
  void begin_pass();
  void end_pass();
  [[nodiscard]] std::optional<Plan> jump(Timestep from, Timestep to, LimitMonitor& limits);
  void append(const Plan& piece, Timestep from, Timestep to);

  const Instance& instance_;
  const std::uint32_t seed_;
  Plan plan_, shorter_;  // `shorter_`: of this pass, as far as it has come.
  Timestep length_ = 0;  // Of plan_.
  Timestep at_ = 0;      // In plan_, where this pass has come to.
  Timestep length_of_shorter_ = 0;
  Timestep reach_ = 0;  // Of the next jump.
  std::uint32_t num_passes_ = 0;
  bool is_over_ = false;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::discrete
