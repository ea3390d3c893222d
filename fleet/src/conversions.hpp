// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
  if (!x || !y) return std::nullopt;
  return continuous::Point{*x, *y};
}

/// Up to a whole length unit. A number that differs from one by a billionth is meant to be that:
/// 0.35 m in millimetres are 350, whatever the last bit of 0.35 says.
[[nodiscard]] inline std::optional<continuous::Length> radius_to_units(
    Metres radius, const continuous::Resolution& resolution) {
  const double value = radius.value();
  const auto nearest = continuous::quantise_coordinate(value, resolution);
  if (!nearest || !(value > 0)) return std::nullopt;
  const double exact = continuous::in_input_units(*nearest, resolution);
  return exact >= value || value - exact <= 1e-9 * value ? *nearest : *nearest + 1;
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

/// How much of a move lies behind a robot: down to a whole tick, with the same billionth, and less
/// than all. `fraction`: 0 .. 1.
[[nodiscard]] inline continuous::Ticks ticks_behind(double fraction, continuous::Ticks whole) {
  const double ticks = fraction * static_cast<double>(whole.count());
  const double nearest = std::round(ticks);
  const bool is_meant = std::abs(ticks - nearest) <= 1e-9 * nearest;
  const auto behind = static_cast<std::int64_t>(is_meant ? nearest : std::floor(ticks));
  return continuous::Ticks(std::clamp<std::int64_t>(behind, 0, whole.count() - 1));
}

/// Where it is then, to the nearest length unit in each coordinate.
[[nodiscard]] inline continuous::Point place_between(const continuous::Point& from,
                                                     const continuous::Point& to,
                                                     continuous::Ticks behind,
                                                     continuous::Ticks whole) {
  const long double share =
      static_cast<long double>(behind.count()) / static_cast<long double>(whole.count());
  const auto between = [&](continuous::Length a, continuous::Length b) {
    return a + continuous::Length(static_cast<std::int64_t>(
                   std::round(static_cast<long double>((b - a).count()) * share)));
  };
  return {between(from.x, to.x), between(from.y, to.y)};
}

[[nodiscard]] inline Point in_metres(const continuous::Point& point,
                                     const continuous::Resolution& resolution) {
  return {Metres(continuous::in_input_units(point.x, resolution)),
          Metres(continuous::in_input_units(point.y, resolution))};
}

[[nodiscard]] inline Seconds in_seconds(continuous::Ticks ticks,
                                        const continuous::Resolution& resolution) {
  return Seconds(continuous::in_input_units(ticks, resolution));
}

[[nodiscard]] inline Seconds in_seconds(Cost cost, const continuous::Resolution& resolution) {
  return Seconds(continuous::in_input_units(cost, resolution));
}

}  // namespace quadrille::fleet
