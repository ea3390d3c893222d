// SPDX-License-Identifier: MIT
#include "quadrille/continuous/quantise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/areas.hpp"
#include "quadrille/core/decimal.hpp"

namespace quadrille::continuous {
namespace {

/// Resolutions are reciprocals of integers as a rule, and products with integers round better: 0.3
/// * 10^6 is 300000, 0.3 / 10^-6 is less. nullopt for others.
std::optional<double> units_per_one(double resolution) {
  const double per_unit = 1 / resolution, nearest = std::round(per_unit);
  if (nearest >= 1 && std::abs(per_unit - nearest) <= 1e-12 * nearest) return nearest;
  return std::nullopt;
}

/// In units of the size `unit`; not rounded.
double divided(double value, double unit) {
  const auto factor = units_per_one(unit);
  return factor ? value * *factor : value / unit;
}

double multiplied(double units, double unit) {
  const auto factor = units_per_one(unit);
  return factor ? units / *factor : units * unit;
}

std::optional<double> in_units(double value, double unit, std::int64_t limit) {
  if (!std::isfinite(value) || !std::isfinite(unit) || unit <= 0) return std::nullopt;
  const double units = divided(value, unit), max = static_cast<double>(limit);
  if (!(std::abs(units) <= max)) return std::nullopt;
  return units;
}

/// Up to half of `unit`, and what is lost where numbers are written in decimals.
bool agree(double value, double exact, double unit) {
  return std::abs(value - exact) <= unit / 2 + 1e-12 * std::abs(exact);
}

}  // namespace

std::optional<Length> quantise_coordinate(double value, const Resolution& resolution) {
  const auto units = in_units(value, resolution.length, geometry::kMaxLength.value());
  if (!units) return std::nullopt;
  return Length(static_cast<std::int64_t>(std::round(*units)));
}

std::string why_no_coordinate(double value, const Resolution& resolution) {
  const std::string number = "the coordinate " + decimal(value);
  if (!std::isfinite(value)) return number + " is no finite number";
  const auto most = static_cast<double>(geometry::kMaxLength.value());
  int digits = 12;
  while (std::abs(value) * std::pow(10.0, digits) > most) --digits;
  const std::string enough =
      digits > 0 ? "0." + std::string(static_cast<std::size_t>(digits) - 1, '0') + "1"
                 : "1" + std::string(static_cast<std::size_t>(-digits), '0');
  return number + " is too large: at a resolution of " + decimal(resolution.length) +
         " there is room up to " + decimal(std::floor(multiplied(most, resolution.length))) +
         "; with --resolution " + enough + " there is enough";
}

std::optional<Length> quantise_radius(double value, const Resolution& resolution) {
  const auto units = in_units(value, resolution.length, geometry::kMaxLength.value());
  if (!units || *units < 1) return std::nullopt;
  return Length(static_cast<std::int64_t>(std::floor(*units)));
}

std::optional<Length> quantise_radius_up(double value, const Resolution& resolution) {
  const auto nearest = quantise_coordinate(value, resolution);
  if (!nearest || !(value > 0)) return std::nullopt;
  const double exact = in_input_units(*nearest, resolution);
  const bool is_enough = exact >= value || value - exact <= 1e-9 * value;
  if (!is_enough && *nearest >= geometry::kMaxLength) return std::nullopt;
  return is_enough ? *nearest : *nearest + 1;
}

std::optional<Length> quantise_corner(double value, const Resolution& resolution) {
  const auto units = in_units(value, resolution.length, geometry::kMaxLength.value());
  if (!units) return std::nullopt;
  return Length(static_cast<std::int64_t>(std::trunc(*units)));
}

std::optional<Ticks> quantise_duration(double value, const Resolution& resolution) {
  const auto units = in_units(value, resolution.time, geometry::kMaxDuration.value());
  if (!units || std::round(*units) < 1) return std::nullopt;
  return Ticks(static_cast<std::int64_t>(std::round(*units)));
}

std::optional<Ticks> quantise_time(double value, const Resolution& resolution) {
  const auto units = in_units(value, resolution.time, geometry::kMaxDuration.value());
  if (!units || *units < 0) return std::nullopt;
  return Ticks(static_cast<std::int64_t>(std::round(*units)));
}

std::optional<Cost> quantise_bound(double value, const Resolution& resolution) {
  const auto units = in_units(value, resolution.time, std::int64_t{1} << 62);
  if (!units || *units < 0) return std::nullopt;
  const double nearest = std::round(*units);
  const bool is_meant = std::abs(*units - nearest) <= 1e-9 * nearest;
  return static_cast<Cost>(is_meant ? nearest : std::floor(*units));
}

std::optional<Speed> quantise_speed(double value, const Resolution& resolution) {
  if (!resolution.is_valid()) return std::nullopt;
  // Length units per tick.
  const double units = resolution.is_uniform()
                           ? value
                           : multiplied(divided(value, resolution.length), resolution.time);
  const double speed = std::round(units * static_cast<double>(kUnitSpeed.value()));
  if (!(speed >= 1 && speed <= static_cast<double>(kMaxSpeed.value()))) return std::nullopt;
  return Speed(static_cast<std::int64_t>(speed));
}

std::optional<Ticks> travel_time(const Point& from, const Point& to, Speed speed) {
  const auto length = std::sqrt(static_cast<long double>(squared_distance(from, to)));
  const long double ticks = std::round(length * static_cast<long double>(kUnitSpeed.value()) /
                                       static_cast<long double>(speed.value()));
  if (!(ticks >= 1 && ticks <= static_cast<long double>(geometry::kMaxDuration.value())))
    return std::nullopt;
  return Ticks(static_cast<std::int64_t>(ticks));
}

double in_input_units(Cost cost, const Resolution& resolution) {
  return multiplied(static_cast<double>(cost), resolution.time);
}

double in_input_units(Ticks ticks, const Resolution& resolution) {
  return multiplied(static_cast<double>(ticks.value()), resolution.time);
}

double in_input_units(Length length, const Resolution& resolution) {
  return multiplied(static_cast<double>(length.value()), resolution.length);
}

double radius_in_input_units(Length radius, const Resolution& resolution) {
  double value = in_input_units(radius, resolution);
  // Radii are rounded down: the nearest number may be just too small.
  for (int step = 0; step < 8 && quantise_radius(value, resolution) != radius; ++step)
    value = std::nextafter(value, std::numeric_limits<double>::infinity());
  return value;
}

double corner_in_input_units(Length coordinate, const Resolution& resolution) {
  if (coordinate == 0) return 0;
  const Length size = coordinate < 0 ? -coordinate : coordinate;
  const double value = radius_in_input_units(size, resolution);
  return coordinate < 0 ? -value : value;
}

std::optional<Ticks> travel_time(const Roadmap& roadmap, const Edge& edge, Speed speed) {
  if (edge.duration) return edge.duration;
  return travel_time(roadmap.position(edge.from), roadmap.position(edge.to),
                     std::min(speed, edge.speed_limit.value_or(speed)));
}

double speed_in_input_units(Speed speed, const Resolution& resolution) {
  const double units = static_cast<double>(speed.value()) / static_cast<double>(kUnitSpeed.value());
  if (resolution.is_uniform()) return units;
  return divided(multiplied(units, resolution.length), resolution.time);
}

bool is_about(double value, Cost ticks, const Resolution& resolution) {
  return agree(value, in_input_units(ticks, resolution), resolution.time);
}

bool is_about(double value, Ticks ticks, const Resolution& resolution) {
  return agree(value, in_input_units(ticks, resolution), resolution.time);
}

bool is_about(double value, Length length, const Resolution& resolution) {
  return agree(value, in_input_units(length, resolution), resolution.length);
}

}  // namespace quadrille::continuous
