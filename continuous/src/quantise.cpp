// SPDX-License-Identifier: MIT
#include "quadrille/continuous/quantise.hpp"

#include <cmath>

namespace quadrille::continuous {
namespace {

std::optional<double> in_units(double value, double resolution, double max) {
  if (!std::isfinite(value) || !std::isfinite(resolution) || resolution <= 0) return std::nullopt;
  // Resolutions are reciprocals of integers as a rule, and products with integers round better:
  // 0.3 * 10^6 is 300000, 0.3 / 10^-6 is less.
  const double per_unit = 1 / resolution, nearest = std::round(per_unit);
  const bool is_reciprocal = nearest >= 1 && std::abs(per_unit - nearest) <= 1e-12 * nearest;
  const double units = is_reciprocal ? value * nearest : value / resolution;
  if (!(std::abs(units) <= max)) return std::nullopt;
  return units;
}

}  // namespace

std::optional<Length> quantise_coordinate(double value, double resolution) {
  const auto units = in_units(value, resolution, static_cast<double>(geometry::kMaxLength));
  if (!units) return std::nullopt;
  return static_cast<Length>(std::round(*units));
}

std::optional<Length> quantise_radius(double value, double resolution) {
  const auto units = in_units(value, resolution, static_cast<double>(geometry::kMaxLength));
  if (!units || *units < 1) return std::nullopt;
  return static_cast<Length>(std::floor(*units));
}

std::optional<Ticks> quantise_duration(double value, double resolution) {
  const auto units = in_units(value, resolution, static_cast<double>(geometry::kMaxDuration));
  if (!units || std::round(*units) < 1) return std::nullopt;
  return static_cast<Ticks>(std::round(*units));
}

std::optional<Speed> quantise_speed(double value) {
  const double speed = std::round(value * static_cast<double>(kUnitSpeed));
  if (!(speed >= 1 && speed <= static_cast<double>(kMaxSpeed))) return std::nullopt;
  return static_cast<Speed>(speed);
}

}  // namespace quadrille::continuous
