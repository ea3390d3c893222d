// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/instance.hpp"

// From the numbers of an input, in its own units of length and time, to whole length units and
// ticks. `resolution` is the size of both in the input's units. nullopt where the number is not
// finite, the resolution is not positive, or the result would be out of range.

namespace quadrille::continuous {

/// A coordinate, to the nearest length unit.
[[nodiscard]] std::optional<Length> quantise_coordinate(double value, double resolution);
/// A radius, rounded down: less than one length unit is lost. nullopt if nothing is left.
[[nodiscard]] std::optional<Length> quantise_radius(double value, double resolution);
/// A duration, to the nearest tick. nullopt if that is none.
[[nodiscard]] std::optional<Ticks> quantise_duration(double value, double resolution);
/// A speed, to the nearest Speed; the resolution cancels out. nullopt if that is 0.
[[nodiscard]] std::optional<Speed> quantise_speed(double value);

}  // namespace quadrille::continuous
