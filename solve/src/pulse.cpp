// SPDX-License-Identifier: MIT
#include "quadrille/solve/pulse.hpp"

#include <algorithm>

namespace quadrille::solve {

ProgressReporter::ProgressReporter(const std::function<void(const Progress&)>& callback,
                                   double interval_s, LimitMonitor& limits, const Facts& known)
    : callback_(callback), interval_s_(interval_s), limits_(limits), known_(known) {
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
  const Cost lower = known_.lower();
  callback_({phase_, known_.cost ? std::min(lower, *known_.cost) : lower, known_.cost, now,
             limits_.conflicts()});
  is_told_ = false;
}

}  // namespace quadrille::solve
