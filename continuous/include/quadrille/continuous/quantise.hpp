// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"

// From the numbers of an input, in its own units of length and time, to whole length units and
// ticks, whose sizes are the resolution. nullopt where the number is not finite, the resolution is
// not positive, or the result would be out of range.

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// A coordinate, to the nearest length unit.
[[nodiscard]] std::optional<Length> quantise_coordinate(double value, const Resolution& resolution);
/// Why a number is no coordinate, and which resolution has room for it if any has: for messages.
/// Requires that quantise_coordinate has no value for it.
[[nodiscard]] std::string why_no_coordinate(double value, const Resolution& resolution);
/// A radius, rounded down: less than one length unit is lost. nullopt if nothing is left.
[[nodiscard]] std::optional<Length> quantise_radius(double value, const Resolution& resolution);
/// A radius, rounded up, for bodies that must not be smaller than they are given: less than one
/// length unit is added. A number that differs from a whole one by a billionth is meant to be that:
/// 0.35 in thousandths are 350, whatever the last bit of 0.35 says. nullopt if it is not positive.
[[nodiscard]] std::optional<Length> quantise_radius_up(double value, const Resolution& resolution);
/// A coordinate of a corner of a body, towards zero: less than one length unit is lost.
[[nodiscard]] std::optional<Length> quantise_corner(double value, const Resolution& resolution);
/// A duration, to the nearest tick. nullopt if that is none.
[[nodiscard]] std::optional<Ticks> quantise_duration(double value, const Resolution& resolution);
/// A moment from tick 0 on, to the nearest tick. nullopt after geometry::kMaxDuration.
[[nodiscard]] std::optional<Ticks> quantise_time(double value, const Resolution& resolution);
/// A lower bound on a cost, down to a whole tick; a number that differs from one by a billionth is
/// meant to be that. nullopt if it is negative, or 2^62 ticks or more.
[[nodiscard]] std::optional<Cost> quantise_bound(double value, const Resolution& resolution);
/// A speed, to the nearest Speed. nullopt if that is 0. A uniform resolution cancels out.
[[nodiscard]] std::optional<Speed> quantise_speed(double value, const Resolution& resolution);

/// How long a straight move from one point to the other takes: the distance divided by the speed,
/// to the nearest tick. nullopt if that is none, or more than geometry::kMaxDuration. Requires
/// points in range and a speed in [1, kMaxSpeed].
[[nodiscard]] std::optional<Ticks> travel_time(const Point& from, const Point& to, Speed speed);

/// How long a move along the edge takes an agent of this speed: what the edge says, or its length
/// at the speed or at the edge's limit. nullopt and requirements as those of travel_time.
[[nodiscard]] std::optional<Ticks> travel_time(const Roadmap& roadmap, const Edge& edge,
                                               Speed speed);

// And back, for output: decimal numbers as short as the resolution allows, where that is the
// reciprocal of an integer. Quantised with the same resolution they give the same integers again.

/// A cost, in ticks.
[[nodiscard]] double in_input_units(Cost cost, const Resolution& resolution);
/// A duration or a time.
[[nodiscard]] double in_input_units(Ticks ticks, const Resolution& resolution);
/// A coordinate.
[[nodiscard]] double in_input_units(Length length, const Resolution& resolution);
[[nodiscard]] double radius_in_input_units(Length radius, const Resolution& resolution);
[[nodiscard]] double corner_in_input_units(Length coordinate, const Resolution& resolution);
[[nodiscard]] double speed_in_input_units(Speed speed, const Resolution& resolution);
/// Whether `value`, in the input's units of time or length, is that cost, time or coordinate up to
/// half a unit of the resolution.
[[nodiscard]] bool is_about(double value, Cost ticks, const Resolution& resolution);
[[nodiscard]] bool is_about(double value, Ticks ticks, const Resolution& resolution);
[[nodiscard]] bool is_about(double value, Length length, const Resolution& resolution);

}  // namespace quadrille::continuous

QUADRILLE_API_END
