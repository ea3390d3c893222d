// SPDX-License-Identifier: MIT
#include "quadrille/fleet/units.hpp"

#include <cmath>

#include "numbers.hpp"

namespace quadrille::units {

using fleet::shortest;

namespace {

std::string rounded_degrees(double radians) {
  return shortest(std::round(in_degrees(Radians(radians)) * 1e6) / 1e6);
}

}  // namespace

std::string to_string(Metres length) { return shortest(length.value()) + " m"; }
std::string to_string(Seconds time) { return shortest(time.value()) + " s"; }
std::string to_string(MetresPerSecond speed) { return shortest(speed.value()) + " m/s"; }
std::string to_string(Hertz rate) { return shortest(rate.value()) + " Hz"; }
std::string to_string(Radians angle) { return rounded_degrees(angle.value()) + " deg"; }
std::string to_string(RadiansPerSecond rate) { return rounded_degrees(rate.value()) + " deg/s"; }

}  // namespace quadrille::units
