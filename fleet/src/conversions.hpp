// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/fleet/roadmap.hpp"

// All that becomes whole units, and all that is made of them again. nullopt: not finite, or out of
// range.

namespace quadrille::fleet {

/// To the nearest length unit.
[[nodiscard]] inline std::optional<continuous::Point> to_units(
    const Point& place, const continuous::Resolution& resolution) {
  const auto x = continuous::quantise_coordinate(place.x.value(), resolution);
  const auto y = continuous::quantise_coordinate(place.y.value(), resolution);
  const auto z = continuous::quantise_coordinate(place.z.value(), resolution);
  if (!x || !y || !z) return std::nullopt;
  return continuous::Point{*x, *y, *z};
}

/// Up or down to a whole tick; a number that differs from one by a billionth is meant to be that.
[[nodiscard]] inline std::optional<continuous::Ticks> time_to_units(
    Seconds time, bool is_up, const continuous::Resolution& resolution) {
  const double value = time.value();
  const auto nearest = continuous::quantise_time(value, resolution);
  if (!nearest) return std::nullopt;
  const double exact = continuous::in_input_units(*nearest, resolution);
  if (std::abs(value - exact) <= 1e-9 * value) return *nearest;
  if (is_up) return exact >= value ? *nearest : *nearest + 1;
  return exact <= value ? *nearest : *nearest - 1;
}

[[nodiscard]] inline Point in_metres(const continuous::Point& point,
                                     const continuous::Resolution& resolution) {
  return {Metres(continuous::in_input_units(point.x, resolution)),
          Metres(continuous::in_input_units(point.y, resolution)),
          Metres(continuous::in_input_units(point.z, resolution))};
}

[[nodiscard]] inline Seconds in_seconds(continuous::Ticks ticks,
                                        const continuous::Resolution& resolution) {
  return Seconds(continuous::in_input_units(ticks, resolution));
}

[[nodiscard]] inline Seconds in_seconds(Cost cost, const continuous::Resolution& resolution) {
  return Seconds(continuous::in_input_units(cost, resolution));
}

}  // namespace quadrille::fleet
