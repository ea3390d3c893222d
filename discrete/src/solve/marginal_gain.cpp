// SPDX-License-Identifier: MIT
#include "solve/marginal_gain.hpp"

#include <algorithm>

namespace quadrille::discrete {

void MarginalGain::add(Lately& side, Effort effort, Cost gain) const {
  side.effort += effort;
  side.gain += gain;
  const Effort memory = Effort::microseconds(settings_.plans_memory);
  for (; side.effort > memory; side.effort = side.effort / 2) side.gain /= 2;
}

void MarginalGain::count_plans(Effort effort, Cost gain, double gap_percent) {
  add(plans_, effort, gain);
  // Close to the end it is as a rule the proof that is missing.
  const double small = in_percent(settings_.plans_small_gap);
  const double large = in_percent(settings_.plans_large_gap);
  const double room = std::clamp((gap_percent - small) / std::max(large - small, 0.1), 0.0, 1.0);
  const auto largest =
      kFirst + static_cast<std::int64_t>(room * static_cast<double>(kLargest - kFirst));
  const auto rate = [](const Lately& side) {
    return static_cast<double>(side.gain) /
           static_cast<double>(std::max<std::int64_t>(1, side.effort.count()));
  };
  const bool is_better = rate(plans_) > rate(search_);
  share_ = std::clamp(is_better ? 2 * share_ : share_ / 2, kLeast, largest);
}

}  // namespace quadrille::discrete
