// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/progress.hpp"
#include "quadrille/core/request.hpp"
#include "quadrille/solve/knowledge.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::solve {

/// Tells of a solve when a phase begins, and about once in an interval as long as its monitor is
/// asked outside of the SAT solver; nothing more once the callback has thrown. To be used by the
/// thread that made it.
class ProgressReporter {
 public:
  /// `callback` may be empty. As long as this lives it is the pulse of `limits`, and so whatever
  /// `callback` throws comes out of whoever asks these. The arguments outlive this.
  ProgressReporter(const std::function<void(const Progress&)>& callback, double interval_s,
                   LimitMonitor& limits, const Facts& known);
  ~ProgressReporter();
  ProgressReporter(const ProgressReporter&) = delete;
  ProgressReporter& operator=(const ProgressReporter&) = delete;

  /// Tells it at once.
  void enter(Phase phase);
  /// To be called where the monitor is asked too rarely.
  void tell_if_due();

 private:
  void tell();

  const std::function<void(const Progress&)>& callback_;
  const double interval_s_;
  LimitMonitor& limits_;
  const Facts& known_;
  Phase phase_ = Phase::set_up;
  double next_s_ = 0;
  bool is_told_ = false;  // now
};

/// What a solve does beside its search, at yield points only: tells the user how far it is and of
/// better plans, and stops when what is known is as good as was asked for. Callbacks run between
/// phases, between two calls of the SAT solver, and where a search without a SAT solver asks its
/// limits.
template <class Plan>
class Pulse {
 public:
  /// All outlive it. `is_told`: whether the user hears of this search. `is_enough`, unless empty,
  /// is asked at yield points whether the search has to stop for another reason than its own gap.
  Pulse(const Request<Plan>& request, LimitMonitor& limits, const Knowledge<Plan>& known,
        bool is_told, std::function<bool()> is_enough = {})
      : request_(request),
        limits_(limits),
        known_(known),
        is_told_(is_told),
        is_enough_(std::move(is_enough)),
        progress_(is_told ? request.on_progress : kNobody, request.progress_interval_s, limits,
                  known) {}

  /// Tells it at once.
  void enter(Phase phase) { progress_.enter(phase); }
  /// A yield point. What callbacks throw comes out.
  void beat() {
    consider_stop();
    progress_.tell_if_due();
    tell_plan();
  }
  /// Ends the search when the bounds meet, or are as close as was asked for.
  void consider_stop() {
    const bool is_close =
        known_.cost && (*known_.cost <= known_.lower() ||
                        is_within_gap(request_.gap_percent, *known_.cost, known_.lower()));
    if (is_close || (is_enough_ && is_enough_())) limits_.stop(StopReason::gap);
  }

  /// Of a cheaper plan than at the last call, when that is due.
  void tell_plan() {
    if (!is_told_ || !request_.on_plan || !known_.plan || known_.cost == told_cost_) return;
    const double now = limits_.elapsed_wall();
    if (now < next_plan_s_) return;
    request_.on_plan(*known_.plan);
    told_cost_ = known_.cost;
    next_plan_s_ = now + request_.plan_interval_s;
  }

 private:
  inline static const std::function<void(const Progress&)> kNobody = {};

  const Request<Plan>& request_;
  LimitMonitor& limits_;
  const Knowledge<Plan>& known_;
  const bool is_told_;
  const std::function<bool()> is_enough_;
  ProgressReporter progress_;
  std::optional<Cost> told_cost_;
  double next_plan_s_ = 0;
};

}  // namespace quadrille::solve

QUADRILLE_API_END
