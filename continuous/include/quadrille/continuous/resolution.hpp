// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

inline constexpr double kDefaultResolution = 1e-6;

/// How numbers of the input become integers: the size of a length unit and that of a tick, in the
/// input's units of length and time.
struct Resolution {
  double length = kDefaultResolution;
  double time = kDefaultResolution;

  constexpr Resolution() = default;
  /// The same number for both.
  constexpr Resolution(double both) : length(both), time(both) {}  // NOLINT: a number will do
  constexpr Resolution(double of_length, double of_time) : length(of_length), time(of_time) {}

  [[nodiscard]] constexpr bool is_uniform() const noexcept { return length == time; }
  /// Positive and finite.
  [[nodiscard]] bool is_valid() const noexcept {
    return std::isfinite(length) && length > 0 && std::isfinite(time) && time > 0;
  }
  friend constexpr bool operator==(const Resolution&, const Resolution&) = default;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
