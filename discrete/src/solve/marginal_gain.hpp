// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/settings.hpp"

namespace quadrille::discrete {

/// How much effort the strategies for plans get beside the search: more and more while they close
/// the gap faster than the search does, less and less while they do not. The marginal gain of both
/// is what they took off the gap lately, per effort. Counts only, no clocks.
class MarginalGain {
 public:
  /// `settings` outlive it.
  explicit MarginalGain(const Settings& settings) : settings_(settings) {}

  /// The search took `gain` off the gap with `effort`.
  void count_search(Effort effort, Cost gain) { add(search_, effort, gain); }
  /// As well for plans; decides on the share from now on. `gap_percent`: what is left.
  void count_plans(Effort effort, Cost gain, double gap_percent);

  /// What plans get for `effort` of the search.
  [[nodiscard]] Effort due(Effort effort) const { return share_ * effort / kUnit; }
  /// As much as it can be: for what shows its gain in the end only.
  [[nodiscard]] static Effort most_due(Effort effort) { return kLargest * effort / kUnit; }

 private:
  /// Sums that forget.
  struct Lately {
    Effort effort = {};
    Cost gain = 0;
  };
  void add(Lately& side, Effort effort, Cost gain) const;

  static constexpr std::int64_t kUnit = 256, kLeast = 1, kFirst = 8, kLargest = 1792;

  const Settings& settings_;
  Lately search_, plans_;
  std::int64_t share_ = kFirst;  // of kUnit
};

}  // namespace quadrille::discrete
