// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"

// From the numbers of an input, in its own units of length and time, to whole length units and
// ticks. `resolution` is the size of both in the input's units. nullopt where the number is not
// finite, the resolution is not positive, or the result would be out of range.

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// A coordinate, to the nearest length unit.
[[nodiscard]] std::optional<Length> quantise_coordinate(double value, double resolution);
/// A radius, rounded down: less than one length unit is lost. nullopt if nothing is left.
[[nodiscard]] std::optional<Length> quantise_radius(double value, double resolution);
/// A coordinate of a corner of a body, towards zero: less than one length unit is lost.
[[nodiscard]] std::optional<Length> quantise_corner(double value, double resolution);
/// A duration, to the nearest tick. nullopt if that is none.
[[nodiscard]] std::optional<Ticks> quantise_duration(double value, double resolution);
/// A speed, to the nearest Speed; the resolution cancels out. nullopt if that is 0.
[[nodiscard]] std::optional<Speed> quantise_speed(double value);

/// How long a straight move from one point to the other takes: the distance divided by the speed,
/// to the nearest tick. nullopt if that is none, or more than geometry::kMaxDuration. Requires
/// points in range and a speed in [1, kMaxSpeed].
[[nodiscard]] std::optional<Ticks> travel_time(const Point& from, const Point& to, Speed speed);

// And back, for output: decimal numbers as short as the resolution allows, where that is the
// reciprocal of an integer. Quantised with the same resolution they give the same integers again.

/// A cost, in ticks.
[[nodiscard]] double in_input_units(Cost cost, double resolution);
/// A duration or a time.
[[nodiscard]] double in_input_units(Ticks ticks, double resolution);
/// A coordinate.
[[nodiscard]] double in_input_units(Length length, double resolution);
[[nodiscard]] double radius_in_input_units(Length radius, double resolution);
[[nodiscard]] double corner_in_input_units(Length coordinate, double resolution);
[[nodiscard]] double speed_in_input_units(Speed speed);
/// Whether `value`, in the input's units, is `units` up to half a unit.
[[nodiscard]] bool is_about(double value, std::int64_t units, double resolution);

}  // namespace quadrille::continuous

QUADRILLE_API_END
