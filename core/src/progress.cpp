// SPDX-License-Identifier: MIT
#include "quadrille/core/progress.hpp"

#include <algorithm>

namespace quadrille {

std::string_view to_string(Phase phase) noexcept {
  switch (phase) {
    case Phase::set_up:
      return "set-up";
    case Phase::joint_search:
      return "joint-search";
    case Phase::routes:
      return "routes";
    case Phase::first_plan:
      return "first-plan";
    case Phase::feasibility:
      return "feasibility";
    case Phase::search:
      return "search";
  }
  return "?";
}

ProgressReporter::ProgressReporter(const std::function<void(const Progress&)>& callback,
                                   double interval_s, LimitMonitor& limits)
    : callback_(callback), interval_s_(interval_s), limits_(limits) {
  if (callback_) limits_.set_pulse([this] { tell_if_due(); });
}

ProgressReporter::~ProgressReporter() {
  if (callback_) limits_.set_pulse({});
}

void ProgressReporter::enter(Phase phase) {
  phase_ = phase;
  if (callback_) tell();
}

void ProgressReporter::tell_if_due() {
  if (callback_ && limits_.elapsed_wall() >= next_s_) tell();
}

void ProgressReporter::tell() {
  if (is_told_) return;
  const double now = limits_.elapsed_wall();
  next_s_ = now + interval_s_;
  is_told_ = true;  // not again, if it throws
  // A bound that the user gave wrongly may be above the cost of a plan, for a moment.
  const Cost lower_bound = cost_ ? std::min(lower_bound_, *cost_) : lower_bound_;
  callback_({phase_, lower_bound, cost_, now, limits_.conflicts()});
  is_told_ = false;
}

}  // namespace quadrille
