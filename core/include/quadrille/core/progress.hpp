// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What a solve is doing. No solve comes to all of them; on graphs feasibility is first.
enum class Phase : std::uint8_t {
  set_up,        ///< How far the goals are, and what moving obstacles forbid.
  joint_search,  ///< A small instance: joint positions of all agents (continuous time).
  routes,        ///< Few agents: orders along whole routes (continuous time).
  first_plan,    ///< Some plan, whatever it costs.
  feasibility,   ///< Whether there is any plan.
  search,        ///< Raises the lower bound and makes plans cheaper.
};
[[nodiscard]] std::string_view to_string(
    Phase phase) noexcept;  ///< "set-up" | "joint-search" | ...

/// A look at a running solve. Costs are timesteps or ticks.
struct Progress {
  Phase phase = Phase::set_up;
  Cost lower_bound = 0;
  std::optional<Cost> cost;  ///< Of the best plan so far.
  double elapsed_s = 0;
  std::int64_t conflicts = 0;
};

/// Tells of a solve when a phase begins, and about once in an interval as long as its monitor is
/// asked; nothing more once the callback has thrown. To be used by the thread that made it.
class ProgressReporter {
 public:
  /// `callback` may be empty. As long as this lives it is the pulse of `limits`, and so whatever
  /// `callback` throws comes out of whoever asks these. The arguments outlive this.
  ProgressReporter(const std::function<void(const Progress&)>& callback, double interval_s,
                   LimitMonitor& limits);
  ~ProgressReporter();
  ProgressReporter(const ProgressReporter&) = delete;
  ProgressReporter& operator=(const ProgressReporter&) = delete;

  /// Tells it at once.
  void enter(Phase phase);
  /// To be told from now on.
  void know(Cost lower_bound, std::optional<Cost> cost) noexcept {
    lower_bound_ = lower_bound;
    cost_ = cost;
  }
  /// To be called where the monitor is asked too rarely.
  void tell_if_due();

 private:
  void tell();

  const std::function<void(const Progress&)>& callback_;
  const double interval_s_;
  LimitMonitor& limits_;
  Phase phase_ = Phase::set_up;
  Cost lower_bound_ = 0;
  std::optional<Cost> cost_;
  double next_s_ = 0;
  bool is_told_ = false;  // now
};

}  // namespace quadrille

QUADRILLE_API_END
