// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/core/ids.hpp"
#include "quadrille/core/settings.hpp"

namespace quadrille::discrete {

/// How much effort the strategies for plans get beside the search: more and more while they close
/// the gap faster than the search does, less and less while they do not. The marginal gain of both
/// is what they took off the gap lately, per step. Counts only, no clocks.
class MarginalGain {
 public:
  /// `settings` outlive it.
  explicit MarginalGain(const Settings& settings) : settings_(settings) {}

  /// The search did `effort` steps and took `gain` off the gap.
  void count_search(std::int64_t effort, Cost gain) {
    add(search_, settings_.plans_step_of_search * effort, gain);
  }
  /// As well for plans; decides on the share from now on. `gap_percent`: what is left.
  void count_plans(std::int64_t effort, Cost gain, double gap_percent);

  /// Steps for plans that are due for `search_effort` steps of the search.
  [[nodiscard]] std::int64_t due(std::int64_t search_effort) const {
    return search_effort * settings_.plans_step_of_search * share_ / kUnit;
  }
  /// As much as it can be: for what shows its gain in the end only.
  [[nodiscard]] std::int64_t most_due(std::int64_t search_effort) const {
    return search_effort * settings_.plans_step_of_search * kLargest / kUnit;
  }

 private:
  /// Sums that forget.
  struct Lately {
    std::int64_t effort = 0;
    Cost gain = 0;
  };
  void add(Lately& side, std::int64_t effort, Cost gain) const;

  static constexpr std::int64_t kUnit = 256, kLeast = 1, kFirst = 8, kLargest = 1792;

  const Settings& settings_;
  Lately search_, plans_;
  std::int64_t share_ = kFirst;  // of kUnit
};

}  // namespace quadrille::discrete
