// SPDX-License-Identifier: MIT
#include "solve/marginal_gain.hpp"

#include <algorithm>

namespace quadrille::discrete {
namespace {

/// In steps for plans, a second: what is longer ago counts for less and less. The first bounds are
/// cheap. Measured with 8,000,000 instead: after two seconds random-32-32-20 with 400 agents 25,571
/// instead of 23,836, maze-32-32-4 with 100 5,308 instead of 5,203; with 500,000: after ten seconds
/// random-32-32-20 with 300 9,143 instead of 9,012, empty-48-48 with 600 19,534 instead of 19,485.
constexpr std::int64_t kMemory = 2'000'000;
/// Per cent. With a smaller gap it is as a rule the proof that is missing, and plans get a
/// thirtieth of the time at most; from kLargeGap on seven eighths. Measured with the first at 2.5:
/// den520d, 1,000 agents, random-2, after 10 s: gap 2.57 % instead of 0.72 %.
constexpr double kSmallGap = 0.5, kLargeGap = 12;

}  // namespace

void MarginalGain::Lately::add(std::int64_t more_effort, Cost more_gain) {
  effort += more_effort;
  gain += more_gain;
  for (; effort > kMemory; effort /= 2) gain /= 2;
}

void MarginalGain::count_plans(std::int64_t effort, Cost gain, double gap_percent) {
  plans_.add(effort, gain);
  // Close to the end it is as a rule the proof that is missing.
  const double room = std::clamp((gap_percent - kSmallGap) / (kLargeGap - kSmallGap), 0.0, 1.0);
  const auto largest =
      kFirst + static_cast<std::int64_t>(room * static_cast<double>(kLargest - kFirst));
  const auto per_step = [](const Lately& side) {
    return static_cast<double>(side.gain) /
           static_cast<double>(std::max<std::int64_t>(1, side.effort));
  };
  const bool is_better = per_step(plans_) > per_step(search_);
  share_ = std::clamp(is_better ? 2 * share_ : share_ / 2, kLeast, largest);
}

}  // namespace quadrille::discrete
